// A block of suns by shooting: every realization for itself, series and totals from their mean.
#include "solver/block_tally.h"
#include "solver/instant_spread.h"
#include "solver/parallel.h"
#include "solver/shooting.h"
#include "solver/solver.h"
#include "solver/stopwatch.h"

namespace sunload {

namespace {

constexpr std::size_t patches_per_task = 1024;

/// Mean over realizations.
class MeanLight {
 public:
  MeanLight(std::size_t patches, std::size_t realizations)
      : of_one_(1.0 / static_cast<double>(realizations)) {
    for (auto& part : parts_) part = double_columns(patches);
  }
  void add(const ShotLight& light) {
    const std::array from{&light.direct, &light.sky, &light.mirror, &light.reflected};
    parallel_for(from[0]->size() / block_width, [&](std::size_t i) {
      for (std::size_t p = 0; p < from.size(); ++p)
        for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
          parts_[p][k] += of_one_ * (*from[p])[k];
    }, patches_per_task);
  }
  BlockLight in_float(std::vector<float> lamps) const {
    const auto to_float = [](const DoubleColumns& part) { return Columns(part.begin(), part.end()); };
    BlockLight light;
    light.direct = to_float(parts_[0]);
    light.sky = to_float(parts_[1]);
    light.mirror = to_float(parts_[2]);
    light.reflected = to_float(parts_[3]);
    light.lamps = std::move(lamps);
    return light;
  }

 private:
  double of_one_;
  std::array<DoubleColumns, 4> parts_;  ///< direct, sky, mirror, reflected
};

}  // namespace

void LightSolver::shoot_block(std::span<const SunLight> block, std::size_t first_row,
                              BatchTally& tally) {
  const std::size_t patches = hierarchy_.patch_count();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  const BlockSources sources(block, static_cast<std::size_t>(grid_.cell_count()));
  std::vector<Columns> direct_of(realizations, columns(patches));
  // Totals come from the series of each realization, which the direct sun is part of.
  std::vector<std::vector<double>> unused(realizations, std::vector<double>(patches, 0));
  DirectSun direct;
  {
    const Stopwatch time(work_.direct_s);
    direct = direct_sun(caster_, sampler_, block, unused, &direct_of);
    work_.direct_rays += direct.rays;
  }
  FirstMirrored::SentSuns sent;
  {
    const Stopwatch time(work_.mirror_s);
    sent = shooter_->send_sun(block);
    work_.mirror_rays += sent.rays;
  }

  const Stopwatch time(work_.shoot_s);
  MeanLight mean(patches, realizations);
  InstantSpread spread(patches, block.size());
  for (std::size_t r = 0; r < realizations; ++r) {
    const ShotLight light = shooter_->light(r, sources, direct_of[r], sent);
    work_.samples += light.samples;
    work_.shot_rays += light.rays;
    mean.add(light);
    if (rules_.errors == Errors::instants) spread.add(light);
    add_realization(r, light, block, first_row, tally);
  }
  store_patches(optics_, mean.in_float(shooter_->lamps()), block, first_row, direct.sunlit, tally);
  if (rules_.errors == Errors::instants) spread.store(first_row, tally);
}

void LightSolver::add_realization(std::size_t r, const ShotLight& light,
                                  std::span<const SunLight> block, std::size_t first_row,
                                  BatchTally& tally) const {
  auto& exposure = tally.exposure_realization[r];
  parallel_for(exposure.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < block.size(); ++k)
      exposure[i] += light.total(i, k) * block[k].length_s;
  }, patches_per_task);
  for (std::size_t k = 0; k < block.size(); ++k) {
    const Ledger& ledger = light.ledger[k];
    tally.ledger[first_row + k] +=
        scaled(ledger, 1.0 / static_cast<double>(tally.exposure_realization.size()));
    tally.ledger_realization[r] += scaled(ledger, block[k].length_s);
    if (rules_.errors == Errors::instants) tally.ledger_instants[r][first_row + k] = ledger;
  }
}

}  // namespace sunload
