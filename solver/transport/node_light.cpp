// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/node_light.h"

#include <algorithm>
#include <utility>

#include "geo/base/units.h"
#include "geo/base/vector_code.h"
#include "solver/base/stopwatch.h"
#include "solver/gather/sensor_light.h"
#include "solver/transport/gathered_sums.h"

namespace sunload {

namespace {

/// Of a sun that is a node [W m-2]: any will do.
constexpr double node_dni = 1000;

/// Ranked at the most; a year of a real site needs about half as many.
constexpr std::size_t most_skies = 320, most_suns = 640;

/// Parts of a row of a block as the compiler's vectors: those of 512 bits took six times as long
/// where the processor has 256 (GCC 12, geo/base/vector_code.h).
using Four = float __attribute__((vector_size(16)));
using Eight = float __attribute__((vector_size(32)));
using Sixteen = float __attribute__((vector_size(64)));

/// Sources of a block of nodes that have a part in a block of intervals.
struct UsedNodes {
  std::size_t count = 0;
  std::array<std::size_t, block_width> source{};
  /// Of codes of the source, in its column of each interval.
  alignas(64) std::array<std::array<float, block_width>, block_width> weights{};

  UsedNodes(const PackedColumns& nodes, const NodeWeights& all) {
    for (std::size_t j = 0; j < block_width; ++j) {
      const float* const of = all.of.data() + j * block_width;
      if (std::all_of(of, of + block_width, [](float w) { return w == 0; })) continue;
      for (std::size_t k = 0; k < block_width; ++k) weights[count][k] = of[k] * nodes.of_column(j);
      source[count++] = j;
    }
  }
};

/// Σ_j nodes[j] weights[j][k] is added to rows [begin, end), which begin at `out`, aligned. Memory
/// is asked meanwhile for the same rows of `next`, or null: each is read once, a chunk at a time,
/// too short for the processor to see what comes.
template <class Part>
[[gnu::always_inline]] inline void add_rows_by(const PackedColumns& nodes, const UsedNodes& used,
                                               std::size_t begin, std::size_t end,
                                               const PackedColumns* next, float* out) {
  constexpr std::size_t together = 4;  // rows, whose sums need not wait for each other
  constexpr std::size_t parts = block_width * sizeof(float) / sizeof(Part);
  alignas(64) float codes[together][block_width];
  for (std::size_t i = begin; i < end; i += together) {
    // Of the last few rows some are made twice, and added once.
    const std::size_t last = end - 1;
    for (std::size_t r = 0; r < together; ++r) {
      const std::size_t row = std::min(i + r, last);
      const std::uint16_t* const __restrict of_row = nodes.codes(row);
#pragma GCC unroll 1  // else the compiler makes it scalar
      for (std::size_t k = 0; k < block_width; ++k)
        codes[r][k] = static_cast<float>(static_cast<std::int32_t>(of_row[k]));
      if (next) __builtin_prefetch(next->codes(row));
    }
    Part sums[together][parts]{};
    for (std::size_t n = 0; n < used.count; ++n) {
      const auto* const weights = reinterpret_cast<const Part*>(used.weights[n].data());
      const std::size_t j = used.source[n];
#pragma GCC unroll 4
      for (std::size_t r = 0; r < together; ++r)
#pragma GCC unroll 4
        for (std::size_t p = 0; p < parts; ++p) sums[r][p] += codes[r][j] * weights[p];
    }
    for (std::size_t r = 0; r < std::min(together, end - i); ++r) {
      auto* const to = reinterpret_cast<Part*>(out + (i - begin + r) * block_width);
      for (std::size_t p = 0; p < parts; ++p) to[p] += sums[r][p] * nodes.of_row(i + r);
    }
  }
}

using AddRows = void(const PackedColumns&, const UsedNodes&, std::size_t, std::size_t,
                     const PackedColumns*, float*);

__attribute__((target("avx512f"))) void add_rows_by_512_bits(const PackedColumns& nodes,
                                                             const UsedNodes& used,
                                                             std::size_t begin, std::size_t end,
                                                             const PackedColumns* next,
                                                             float* out) {
  add_rows_by<Sixteen>(nodes, used, begin, end, next, out);
}

__attribute__((target("avx2"))) void add_rows_by_256_bits(const PackedColumns& nodes,
                                                          const UsedNodes& used, std::size_t begin,
                                                          std::size_t end,
                                                          const PackedColumns* next, float* out) {
  add_rows_by<Eight>(nodes, used, begin, end, next, out);
}

/// The widest that this processor has, as SUNLOAD_VECTOR_CODE would take it; of one text for all
/// widths it would make the slow ones.
AddRows* add_rows_of_this_machine() {
  if (__builtin_cpu_supports("avx512f")) return add_rows_by_512_bits;
  if (__builtin_cpu_supports("avx2")) return add_rows_by_256_bits;
  return add_rows_by<Four>;
}

/// What the sources of a block of nodes bring while each shines for some time.
struct TimedNodes {
  const PackedColumns* nodes;
  std::array<double, block_width> seconds;  ///< of codes of the source

  TimedNodes(const PackedColumns& of_nodes, const NodeSeconds& of_sources) : nodes(&of_nodes) {
    for (std::size_t j = 0; j < block_width; ++j)
      seconds[j] = of_sources[j] * static_cast<double>(of_nodes.of_column(j));
  }
};

/// Adds what all of them bring to receivers [begin, end).
SUNLOAD_VECTOR_CODE void add_exposure(const std::vector<TimedNodes>& all, std::size_t begin,
                                      std::size_t end, double* exposure) {
  constexpr std::size_t rows_ahead = 16;  // asked of memory
  for (std::size_t i = begin; i < end; ++i) {
    alignas(64) double of_lanes[block_width]{};  // sums that need not wait for each other
    for (const TimedNodes& block : all) {
      __builtin_prefetch(block.nodes->codes(std::min(i + rows_ahead, end - 1)));
      const std::uint16_t* const __restrict codes = block.nodes->codes(i);
      const double* const __restrict seconds = block.seconds.data();
      const auto of_row = static_cast<double>(block.nodes->of_row(i));
#pragma GCC unroll 1  // as above
      for (std::size_t j = 0; j < block_width; ++j)
        of_lanes[j] +=
            static_cast<double>(static_cast<std::int32_t>(codes[j])) * seconds[j] * of_row;
    }
    double sum = exposure[i];
    for (std::size_t j = 0; j < block_width; ++j) sum += of_lanes[j];
    exposure[i] = sum;
  }
}

/// Adds what all blocks bring, one kind of light, of each block or null; what falls below 0 is 0.
void combine(const std::vector<const PackedColumns*>& nodes,
             const std::vector<NodeWeights>& weights, Columns& out) {
  std::vector<std::pair<const PackedColumns*, UsedNodes>> parts;
  parts.reserve(nodes.size());
  AddRows* const add_rows = add_rows_of_this_machine();
  for (std::size_t b = 0; b < nodes.size(); ++b)
    if (nodes[b] && !nodes[b]->empty() && weights[b].any)
      parts.emplace_back(nodes[b], UsedNodes(*nodes[b], weights[b]));
  parallel_chunks(out.size() / block_width, receivers_per_chunk,
                  [&](std::size_t begin, std::size_t end) {
                    float* const rows = out.data() + begin * block_width;
                    for (std::size_t p = 0; p < parts.size(); ++p)
                      add_rows(*parts[p].first, parts[p].second, begin, end,
                               p + 1 < parts.size() ? parts[p + 1].first : nullptr, rows);
                    for (float* value = rows; value != rows + (end - begin) * block_width; ++value)
                      *value = std::max(*value, 0.0f);
                  });
}

/// Power that the rays of every sun of a block bring to patches [W]: terms of the ledger.
struct FirstPower {
  std::array<double, block_width> sun{}, absorbed{}, unshot{};
};
/// What becomes of light that a patch meets.
struct SharesOfPatch {
  double stopped, absorbed, diffuse;
};

/// Adds one patch, whose light is not followed (ledger_of_patch).
SUNLOAD_VECTOR_CODE void add_power(const float* __restrict direct, const float* __restrict mirror,
                                   double area, SharesOfPatch shares, FirstPower& power) {
  for (std::size_t k = 0; k < block_width; ++k) {
    const auto straight = static_cast<double>(direct[k]);
    const double all = straight + static_cast<double>(mirror[k]);
    power.sun[k] += area * straight * shares.stopped;
    power.absorbed[k] += area * shares.absorbed * all;
    power.unshot[k] += area * shares.diffuse * all;
  }
}

/// An interval with that sky and nothing else.
IntervalLight sky_alone(IntervalLight light) {
  light.dni = light.ground_exitance = light.sunlit_s = 0;
  light.sun_samples.clear();
  light.direct_suns.clear();
  return light;
}

/// An interval with a sun in the middle of its sunlit part, and nothing else.
IntervalLight sun_alone(IntervalLight light) {
  light.dni = node_dni;
  light.dhi = light.ground_exitance = 0;
  light.sky.clear();
  if (!light.has_direct_suns()) light.sun_samples.clear();
  return light;
}

/// The nodes about the suns of an interval, each sun with its share.
std::vector<SunNodes::Weight> nodes_about(const SunNodes& nodes, const IntervalLight& light) {
  if (!light.has_sun() || light.dni <= 0 || nodes.count() == 0) return {};
  const std::vector<SunSample> one{{light.direction, 1, 1}};
  std::vector<SunNodes::Weight> about;
  const bool is_one = light.sun_samples.empty() || light.has_direct_suns();
  for (const SunSample& sun : is_one ? one : light.sun_samples)
    for (const auto& [node, weight] : nodes.weights(sun.direction))
      about.push_back({node, weight * sun.dni_share});
  return about;
}

}  // namespace

void NodeWeights::add(std::size_t source, std::size_t interval, double weight) {
  of[source * block_width + interval] += static_cast<float>(weight);
  any = true;
}

std::vector<Ledger> ledger_of_rays(const TracedScene& traced, const PatchOptics& optics,
                                   const Columns& direct, const Columns& mirror, std::size_t suns) {
  const std::vector<double>& area = traced.hierarchy().area();
  std::vector<FirstPower> parts(chunk_count(area.size(), receivers_per_chunk));
  parallel_chunks(area.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    FirstPower& part = parts[begin / receivers_per_chunk];
    for (std::size_t i = begin; i < end; ++i)
      add_power(&direct[i * block_width], &mirror[i * block_width], area[i],
                {1 - static_cast<double>(optics.passed[i]), optics.absorbed(i),
                 static_cast<double>(optics.diffuse[i])},
                part);
  });
  std::vector<Ledger> ledger(suns);
  for (std::size_t k = 0; k < suns; ++k)
    for (const FirstPower& part : parts) {
      ledger[k][Term::sun] += part.sun[k];
      ledger[k][Term::absorbed] += part.absorbed[k];
      ledger[k][Term::unshot] += part.unshot[k];
    }
  return ledger;
}

NodeLight::NodeLight(const TracedScene& traced, std::size_t band, const LitPeriod& period,
                     const std::vector<std::size_t>& left_out, WorkDone& work)
    : traced_(traced),
      band_(band),
      period_(period),
      skies_(traced.grid, period, most_skies, left_out),
      suns_(period, most_suns, left_out) {
  IntervalLight far_ground;
  far_ground.ground_exitance = 1;
  if (optics().any_emission)
    solved_.lamps = solve(std::vector{IntervalLight{}}, Keep::reflected, work);
  solved_.ground = solve(std::vector{far_ground}, Keep::reflected, work);
}

NodeLight::NodeLight(const TracedScene& traced, std::size_t band, const LitPeriod& period,
                     const std::vector<std::size_t>& left_out, SolvedNodes ready)
    : traced_(traced),
      band_(band),
      period_(period),
      skies_(traced.grid, period, most_skies, left_out),
      suns_(period, most_suns, left_out),
      solved_(std::move(ready)) {
  skies_.take(solved_.reduction.skies);
  suns_.take(solved_.reduction.suns);
}

void NodeLight::take(std::size_t skies, std::size_t suns, WorkDone& work,
                     const std::function<void(double)>& advance) {
  const std::size_t sky_count =
      std::max(skies_.count(), std::min(skies_.ranked().size(), in_whole_blocks(skies)));
  const std::size_t sun_count =
      std::max(suns_.count(), std::min(suns_.ranked().size(), in_whole_blocks(suns)));
  const std::size_t solved = skies_.count() + suns_.count();
  const auto grow = [&](std::vector<NodeBlock>& blocks, std::size_t count, auto&& solve_nodes) {
    for (std::size_t first = blocks.size() * block_width; first < count; first += block_width) {
      blocks.push_back(solve_nodes(first, std::min(block_width, count - first)));
      const std::size_t done = block_width * (solved_.skies.size() + solved_.suns.size()) - solved;
      const std::size_t wanted = sky_count + sun_count - solved;
      advance(std::min(1.0, static_cast<double>(done) / static_cast<double>(wanted)));
    }
  };
  grow(solved_.skies, sky_count,
       [&](std::size_t first, std::size_t n) { return solve_skies(first, n, work); });
  grow(solved_.suns, sun_count,
       [&](std::size_t first, std::size_t n) { return solve_suns(first, n, work); });
  skies_.take(sky_count);
  suns_.take(sun_count);
}

std::vector<const NodeBlock*> NodeLight::blocks() const {
  std::vector<const NodeBlock*> all{&solved_.lamps, &solved_.ground};
  for (const auto* blocks : {&solved_.skies, &solved_.suns})
    for (const NodeBlock& block : *blocks) all.push_back(&block);
  return all;
}

std::vector<NodeWeights> NodeLight::weights(std::span<const IntervalLight> suns,
                                            const std::vector<Ledger>& by_rays) const {
  std::vector<NodeWeights> weights(first_sun() + solved_.suns.size());
  std::vector<std::vector<double>> of_skies(suns.size());
  parallel_for(suns.size(), [&](std::size_t k) { of_skies[k] = skies_.weights(suns[k].sky); });
  for (std::size_t k = 0; k < suns.size(); ++k) {
    weights[0].add(0, k, 1);
    weights[1].add(0, k, suns[k].ground_exitance);
    for (std::size_t m = 0; m < of_skies[k].size(); ++m)
      weights[first_sky() + m / block_width].add(m % block_width, k, of_skies[k][m]);
    const auto about = nodes_about(suns_, suns[k]);
    double reflected_first = 0;
    for (const auto& [node, weight] : about)
      reflected_first +=
          weight * solved_.suns[node / block_width].reflected_first[node % block_width];
    if (reflected_first <= 0) continue;
    const double scale = by_rays[k][Term::unshot] / reflected_first;
    for (const auto& [node, weight] : about)
      weights[first_sun() + node / block_width].add(node % block_width, k, scale * weight);
  }
  return weights;
}

BlockLight NodeLight::light(const Receivers& receivers,
                            NodeBlock::Received NodeBlock::*of_receivers,
                            const std::vector<NodeWeights>& weights, RayLight& rays) const {
  BlockLight light =
      light_by_rays(receivers.lines.pooled, std::move(rays.pooled), receivers.lamps.pooled);
  const auto all = blocks();
  const auto add = [&](PackedColumns NodeBlock::Received::*kind, Columns& out) {
    std::vector<const PackedColumns*> nodes;
    nodes.reserve(all.size());
    for (const NodeBlock* block : all) nodes.push_back(&(block->*of_receivers.*kind));
    combine(nodes, weights, out);
  };
  light.sky = columns(light.direct.size() / block_width);
  light.reflected = columns(light.direct.size() / block_width);
  add(&NodeBlock::Received::sky, light.sky);
  if (optics().any_mirror) add(&NodeBlock::Received::mirror, light.mirror);
  add(&NodeBlock::Received::reflected, light.reflected);
  return light;
}

void NodeLight::add_circumsolar(const std::vector<NodeWeights>& weights, std::size_t r,
                                Columns& light) const {
  std::vector<const PackedColumns*> nodes;
  for (const NodeBlock* block : blocks())
    nodes.push_back(block->circumsolar.empty() ? nullptr : &block->circumsolar[r]);
  combine(nodes, weights, light);
}

void NodeLight::split_circumsolar(const std::vector<NodeSeconds>& seconds, TimeSums& sums) const {
  const auto all = blocks();
  sums.sky_of_lines = sums.sky;
  for (std::size_t b = 0; b < seconds.size(); ++b)
    for (std::size_t j = 0; j < all[b]->circumsolar_sky.size(); ++j)
      for (std::size_t c = 0; c < all[b]->circumsolar_sky[j].size(); ++c)
        sums.sky_of_lines[c] -= seconds[b][j] * all[b]->circumsolar_sky[j][c];
  std::vector<std::size_t> shining;  // blocks with circumsolar light in this time
  for (std::size_t b = 0; b < seconds.size(); ++b)
    if (!all[b]->circumsolar.empty() &&
        std::any_of(seconds[b].begin(), seconds[b].end(), [](double s) { return s != 0; }))
      shining.push_back(b);
  if (shining.empty()) return;
  for (std::size_t r = 0; r < sums.on_patches.circumsolar.size(); ++r) {
    std::vector<TimedNodes> timed;
    timed.reserve(shining.size());
    for (const auto b : shining) timed.emplace_back(all[b]->circumsolar[r], seconds[b]);
    std::vector<double>& exposure = sums.on_patches.circumsolar[r];
    parallel_chunks(exposure.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
      add_exposure(timed, begin, end, exposure.data());
    });
  }
}

Ledger NodeLight::ledger(const std::vector<NodeWeights>& weights, std::size_t interval) const {
  Ledger ledger;
  const auto all = blocks();
  for (std::size_t b = 0; b < all.size(); ++b)
    for (std::size_t j = 0; j < block_width; ++j)
      if (const float w = weights[b].of[j * block_width + interval]; w != 0)
        ledger += scaled(all[b]->ledger[j], static_cast<double>(w));
  return ledger;
}

/// Gathers the light of these sources; what their suns bring by rays is reflected, and left out,
/// and so are lamps, which shine in every solution, once they are known.
NodeBlock NodeLight::solve(std::span<const IntervalLight> suns, Keep keep, WorkDone& work) const {
  BlockSources sources(suns, static_cast<std::size_t>(traced_.grid.cell_count()));
  sources.split_sky(traced_.grid);
  BlockRays rays = light_iteration(traced_, sources, {.columns = true}, {}, work);
  const Stopwatch time(work[Work::solve_s]);
  const Columns by_mirrors = rays.on_patches.pooled.mirror;
  NodeBlock block;
  if (any_circumsolar(sources.circumsolar))
    for (Columns& samples : rays.on_patches.of_realizations.circumsolar) {
      if (keep == Keep::all) block.circumsolar.emplace_back(samples);
      samples = {};
    }
  for (const auto& sky : sources.circumsolar) {
    std::vector<double> cells;
    for (std::size_t c = 0; sky.any() && c < sources.sky.size() / block_width; ++c)
      cells.push_back(pi * sky.radiance(c));
    block.circumsolar_sky.push_back(std::move(cells));
  }
  const LineSet& lines = traced_.patches.lines.pooled;
  BlockLight light =
      block_light(traced_.hierarchy(), lines, optics(), sources, std::move(rays.on_patches.pooled),
                  traced_.patches.lamps.pooled, traced_.bounce_rules(band_));
  const auto whole = block_ledger(lines, optics(), traced_.hierarchy().area(), sources, light);
  const auto first = ledger_of_rays(traced_, optics(), light.direct, by_mirrors, suns.size());
  for (std::size_t j = 0; j < suns.size(); ++j) {
    (block.ledger[j] = whole[j]) += scaled(first[j], -1);
    block.ledger[j] += scaled(solved_.lamps.ledger[0], -1);
    block.reflected_first[j] = first[j][Term::unshot];
  }
  if (traced_.sensors.count() > 0) {
    const Columns dark = columns(traced_.sensors.count());
    block.sensors = packed(sensor_light(traced_.sensors.lines.pooled, optics(), sources,
                                        {dark, dark, {}}, traced_.sensors.lamps.pooled,
                                        seen_radiosity(traced_.hierarchy(), optics(), light)),
                           solved_.lamps.sensors.reflected, suns.size(), keep);
  }
  for (std::size_t at = 0; at < by_mirrors.size(); ++at) light.mirror[at] -= by_mirrors[at];
  block.patches = packed(std::move(light), solved_.lamps.patches.reflected, suns.size(), keep);
  return block;
}

/// `of_lamps`: what is left out of the reflected light of so many sources; none: nothing.
NodeBlock::Received NodeLight::packed(BlockLight light, const PackedColumns& of_lamps,
                                      std::size_t sources, Keep keep) const {
  for (std::size_t i = 0; i < of_lamps.rows(); ++i) {
    const float lamps = of_lamps.at(i, 0);
    for (std::size_t j = 0; j < sources; ++j) light.reflected[i * block_width + j] -= lamps;
  }
  NodeBlock::Received received;
  received.reflected = PackedColumns(light.reflected);
  if (keep == Keep::reflected) return received;
  received.sky = PackedColumns(light.sky);
  if (optics().any_mirror) received.mirror = PackedColumns(light.mirror);
  return received;
}

NodeBlock NodeLight::solve_skies(std::size_t first, std::size_t count, WorkDone& work) const {
  std::vector<IntervalLight> sources(count);
  parallel_for(count, [&](std::size_t j) {
    sources[j] = sky_alone(period_.of(skies_.ranked()[first + j]));
  });
  return solve(sources, Keep::all, work);
}

NodeBlock NodeLight::solve_suns(std::size_t first, std::size_t count, WorkDone& work) const {
  std::vector<IntervalLight> sources(count);
  parallel_for(
      count, [&](std::size_t j) { sources[j] = sun_alone(period_.of(suns_.ranked()[first + j])); });
  return solve(sources, Keep::reflected, work);
}

}  // namespace sunload
