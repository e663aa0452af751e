// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Error against samples for points of several kinds, as CSV:
//   samplers_bench STUDY.yaml > errors.csv
// What the lines of the study's first variant estimate on its own mesh: the sky view factor of each
// patch, what patches gather of the light that others reflect, and what they get of it when others
// shoot. Sobol points scrambled as the program's, Halton's and plain random ones; all give each
// single point the unit cube's density, so that the estimates have no bias. Columns: sampler, what,
// samples of a patch, error: root mean square over patches (by area) and seeds, as share of the
// mean; the reference is 16 times as many Sobol points as the most that are tried, of other seeds.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "geo/base/keys.h"
#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/lines/patch_lines.h"
#include "solver/solver.h"

using namespace sunload;

namespace {

enum class Points { sobol, halton, random };
constexpr std::array kinds{Points::sobol, Points::halton, Points::random};
constexpr std::array<const char*, 3> kind_names{"sobol", "halton", "random"};
constexpr std::array<const char*, 3> what_names{"sky view", "gathered", "shot"};
constexpr std::size_t fewest = 16, most = 2048, seed_count = 4, reference_factor = 16;

/// The digits of `index` after the point, in the reverse order. Halton (1960), On the efficiency of
/// certain quasi-random sequences of points in evaluating multi-dimensional integrals.
double radical_inverse(std::uint64_t index, std::uint64_t base) {
  double value = 0;
  for (double digit = 1.0 / static_cast<double>(base); index > 0; index /= base) {
    value += static_cast<double>(index % base) * digit;
    digit /= static_cast<double>(base);
  }
  return value;
}

/// Shifted on the unit circle, so that each point is uniform over seeds. Cranley & Patterson
/// (1976), Randomization of number theoretic methods for multiple integration.
double shifted_halton(std::uint32_t index, std::uint32_t dimension, const RandomWords& seeds) {
  constexpr std::array<std::uint64_t, sobol_dimensions> bases{2, 3, 5, 7};
  const double x = radical_inverse(index, bases.at(dimension)) + seeds.at(dimension) * 0x1p-32;
  return x - std::floor(x);
}

double independent(std::uint32_t index, std::uint32_t dimension, const RandomWords& seeds) {
  constexpr int dropped_bits = 11;
  const std::uint64_t word =
      mixed((std::uint64_t{seeds[0]} << 32U) + seeds[1], (std::uint64_t{index} << 2U) + dimension);
  return static_cast<double>(word >> dropped_bits) * 0x1p-53;
}

double coordinate(Points kind, std::uint32_t index, std::uint32_t d, const RandomWords& seeds) {
  if (kind == Points::halton) return shifted_halton(index, d, seeds);
  if (kind == Points::random) return independent(index, d, seeds);
  return scrambled_sobol(index, static_cast<int>(d), seeds);
}

/// Of all patches: [what][patch].
using Estimates = std::array<std::vector<double>, what_names.size()>;

class Bench {
 public:
  explicit Bench(const std::string& path)
      : plan_(make_plan(read_study(path).variants.front())),
        made_(make_mesh(plan_, watch_)),
        traced_(trace_scene(plan_.built.scene, made_.mesh, solver_rules(plan_), watch_)) {
    const IntervalLights lights(plan_.study, plan_.built.site, traced_->grid);
    const auto tally =
        solve(*transport_of(*traced_), lights.of(plan_.light, 0, plan_.intervals()), watch_);
    const auto& load = tally.bands.front().exposure[static_cast<std::size_t>(Part::total)];
    for (std::size_t i = 0; i < load.size(); ++i)
      radiosity_.push_back(static_cast<double>(traced_->optics.diffuse[i]) * load[i]);
  }

  std::size_t patch_count() const { return radiosity_.size(); }

  void tell() const {
    const Estimates truth = estimates(Points::sobol, most * reference_factor, seed_count + 1);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
      for (std::size_t samples = fewest; samples <= most; samples *= 2) {
        std::array<double, what_names.size()> squares{};
        for (std::uint64_t seed = 1; seed <= seed_count; ++seed) {
          const Estimates some = estimates(kinds[kind], samples, seed);
          for (std::size_t what = 0; what < some.size(); ++what)
            squares[what] += square_of(some[what], truth[what]) / seed_count;
        }
        for (std::size_t what = 0; what < squares.size(); ++what)
          fmt::print("{},{},{},{:.5g}\n", kind_names[kind], what_names[what], samples,
                     std::sqrt(squares[what]));
      }
  }

 private:
  /// Mean square by area of the difference, by the squared mean of the truth.
  double square_of(const std::vector<double>& some, const std::vector<double>& truth) const {
    double squares = 0, sum = 0, area = 0;
    for (std::size_t i = 0; i < patch_count(); ++i) {
      const double A = made_.mesh->area()[i], off = some[i] - truth[i];
      squares += A * off * off;
      sum += A * truth[i];
      area += A;
    }
    return squares * area / (sum * sum);
  }

  /// Shots are added chunk by chunk, in one order.
  Estimates estimates(Points kind, std::size_t samples, std::uint64_t seed) const {
    Estimates of;
    for (auto& values : of) values.assign(patch_count(), 0);
    const std::size_t chunks = chunk_count(patch_count(), receivers_per_chunk);
    std::vector<std::vector<double>> shots(chunks, std::vector<double>(patch_count()));
    parallel_chunks(patch_count(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
      auto& of_chunk = shots[begin / receivers_per_chunk];
      for (std::size_t i = begin; i < end; ++i) add(i, kind, samples, seed, of, of_chunk);
    });
    for (const auto& of_chunk : shots)
      for (std::size_t j = 0; j < patch_count(); ++j)
        of[2][j] += of_chunk[j] / made_.mesh->area()[j];
    return of;
  }

  /// The lines of a patch: its own view and gathered light, and its shots at others.
  void add(std::size_t i, Points kind, std::size_t samples, std::uint64_t seed, Estimates& of,
           std::vector<double>& shots) const {
    const auto seeds = line_seeds(*made_.mesh, i, 0, seed);
    const PatchLines lines(*made_.mesh, i, traced_->caster.offset_m(), seeds);
    const double share = 1.0 / static_cast<double>(samples);
    const double shot = made_.mesh->area()[i] * radiosity_[i] * share;
    for (std::size_t first = 0; first < samples; first += packet_size) {
      Packet origins{};
      PacketDirections directions{};
      for (std::size_t l = 0; l < packet_size; ++l) {
        const auto index = static_cast<std::uint32_t>(first + l);
        const auto u = [&](std::uint32_t d) { return coordinate(kind, index, d, seeds); };
        const auto line = lines.at(u(0), u(1), u(2), u(3));
        put(origins, l, line.origin);
        put(directions, l, line.w);
      }
      const auto hits = traced_->caster.first_hits(origins, directions, 0xffffu);
      for (std::size_t l = 0; l < packet_size; ++l) {
        const Hit hit = hits[l];
        if (hit.left_scene()) {
          of[0][i] += share;
          continue;
        }
        const auto j = made_.mesh->patch_at(hit.triangle, hit.u, hit.v, hit.front);
        if (j < 0) continue;
        of[1][i] += share * radiosity_[static_cast<std::size_t>(j)];
        shots[static_cast<std::size_t>(j)] += shot;
      }
    }
  }

  Watch watch_;
  VariantPlan plan_;
  VariantMesh made_;
  std::unique_ptr<TracedScene> traced_;
  std::vector<double> radiosity_;  ///< over the period [J m-2]
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: samplers_bench STUDY.yaml\n");
    return 2;
  }
  try {
    const Bench bench(argv[1]);
    fmt::print(stderr, "{} patches\n", bench.patch_count());
    fmt::print("sampler,what,samples,error\n");
    bench.tell();
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 2;
  }
}
