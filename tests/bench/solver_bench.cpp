// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the solver is on a study: lines, shadow rays, sky and Jacobi, shots, per second.
//   solver_bench STUDY.yaml [BATCHES]
// The study's first variant on its own mesh, BATCHES of its batches (default 1), spread evenly
// over the period. Beside each
// stage stands what the ray caster alone does on the same scene in the same run: packets of 16 rays
// from points of a patch to each shining sun that it faces, and packets of 16 lines to what they
// first meet. Shares of those compare machines; a speed alone is told with version, commit and
// instruction set.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "geo/base/check.h"
#include "io/base/version.h"
#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "solver/base/chunks.h"
#include "solver/base/sampling.h"
#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/solver.h"

using namespace sunload;

namespace {

constexpr double million = 1e6;

void tell(const char* what, double count, double seconds, const char* unit) {
  if (count > 0 && seconds > 0)
    fmt::print("{:<24} {:10.3g} {:<14} {:8.3f} s  {:10.3g} million/s\n", what, count, unit, seconds,
               count / seconds / million);
}

void tell_seconds(const char* what, double seconds) {
  if (seconds > 0) fmt::print("{:<24} {:36.3f} s\n", what, seconds);
}

/// How many pairs of a sun and a patch that face each other are told without rays.
void tell_shares(const TracedScene& traced, std::span<const IntervalLight> suns) {
  std::array<std::uint64_t, 4> pairs{};  // by rays, dark, lit, in part
  double seconds = 0;
  for (std::size_t first = 0; first < suns.size(); first += block_width) {
    const auto block = suns.subspan(first, std::min(block_width, suns.size() - first));
    const Columns shares = [&] {
      const Stopwatch time(seconds);
      return traced.lit_shares.of(block);
    }();
    for (std::size_t i = 0; i < traced.patches.count(); ++i)
      for (std::size_t k = 0; k < block.size(); ++k)
        if (block[k].has_sun() && dot(traced.hierarchy().normal(i), block[k].direction) > 0) {
          const float share = shares[i * block_width + k];
          ++pairs[share < 0 ? 0 : share == 0 ? 1 : share == 1 ? 2 : 3];
        }
  }
  const auto all = static_cast<double>(pairs[0] + pairs[1] + pairs[2] + pairs[3]);
  const auto percent = [&](std::size_t kind) {
    return 100 * static_cast<double>(pairs[kind]) / all;
  };
  if (all > 0)
    fmt::print(
        "{:<24} {:10.3g} {:<14} {:8.3f} s  {:10.3g} million/s: {:.1f} % lit, {:.1f} dark, {:.1f} "
        "in part, {:.2f} by rays\n",
        "sunlit shares", all, "pairs", seconds, all / seconds / million, percent(2), percent(1),
        percent(3), percent(0));
}

double seconds_of(const WorkDone& work) {
  double sum = 0;
  for (const Work stage : {Work::lines_s, Work::direct_s, Work::mirror_s, Work::solve_s,
                           Work::realizations_s, Work::shoot_s, Work::sensors_s})
    sum += work[stage];
  return sum;
}

struct Bare {
  double rays = 0, seconds = 0;
  double rate() const { return seconds > 0 ? rays / seconds : 0; }
};

void tell_share(const char* what, double count, double seconds, const Bare& bare) {
  if (count > 0 && seconds > 0 && bare.rate() > 0)
    fmt::print("{:<24} {:10.2f} of the bare rate\n", what, count / seconds / bare.rate());
}

/// Rays and seconds of `rays_of(normal, origins)` on all patches and threads, and nothing else.
template <class RaysOf>
Bare bare_rays(const TracedScene& traced, const RaysOf& rays_of) {
  Bare bare;
  {
    const Stopwatch time(bare.seconds);
    const SunSampler& sampler = traced.patches.sampler;
    bare.rays = ordered_sum(
        traced.patches.count(), receivers_per_chunk, 0.0, [&](std::size_t begin, std::size_t end) {
          double rays = 0;
          SunSampler::Seeds seeds;
          for (std::size_t i = begin; i < end; ++i) {
            const auto geometry = sampler.geometry(i);
            sampler.seed(i, 0, seeds);
            rays += rays_of(geometry.normal, sampler.origins(geometry, seeds, 0));
          }
          return rays;
        });
  }
  return bare;
}

/// 16 rays for each pair of a patch and a shining sun that face each other.
Bare bare_shadow_rays(const TracedScene& traced, std::span<const IntervalLight> suns) {
  return bare_rays(traced, [&](Vec3 normal, const Packet& origins) {
    double rays = 0;
    std::uint32_t seen = 0;
    for (const auto& sun : suns) {
      if (!sun.has_sun() || sun.dni <= 0 || dot(normal, sun.direction) <= 0) continue;
      seen ^= traced.caster.unoccluded(origins, sun.direction, 0xffffu);
      rays += packet_size;
    }
    return seen == 0x10000u ? 0 : rays;  // keeps the rays
  });
}

/// As many lines as the study has, from points of the patch in directions spread by the cosine.
Bare bare_lines(const TracedScene& traced) {
  const std::size_t packets =
      (static_cast<std::size_t>(traced.rules.lines_per_patch) + packet_size - 1) / packet_size;
  std::vector<Vec3> local;
  for (std::size_t l = 0; l < packets * packet_size; ++l)
    local.push_back(
        sample_cosine(static_cast<double>(uniform(sobol(static_cast<std::uint32_t>(l), 0))),
                      static_cast<double>(uniform(sobol(static_cast<std::uint32_t>(l), 1)))));
  return bare_rays(traced, [&](Vec3 normal, const Packet& origins) {
    std::int64_t met = 0;
    const Tangents axes = tangents(normal);
    for (std::size_t p = 0; p < packets; ++p) {
      PacketDirections directions;
      for (std::size_t r = 0; r < packet_size; ++r) {
        const Vec3 w = local[p * packet_size + r];
        put(directions, r, axes.tangent * w.x + axes.bitangent * w.y + normal * w.z);
      }
      met += traced.caster.first_hits(origins, directions, 0xffffu).triangle[0];
    }
    return met == -1 ? 0 : static_cast<double>(packets * packet_size);  // keeps the hits
  });
}

void bench(const std::string& path, std::size_t batches) {
  const VariantPlan plan = make_plan(read_study(path).variants.front());
  Watch watch;
  const auto made = make_mesh(plan, watch);
  auto traced = trace_scene(plan.built.scene, made.mesh, solver_rules(plan), watch);
  const IntervalLights lights(plan.study, plan.built.site, traced->grid);
  const SeriesLight period(lights, plan.light);
  WorkDone work = traced->work;
  const auto transport = transport_of(*traced, period, watch);
  tell_seconds("nodes of the period", seconds_of(transport->work()));
  work += transport->work();
  const double before_batches = seconds_of(work);
  std::vector<IntervalLight> lit;
  const std::size_t there_are = (plan.intervals() + plan.batch_suns() - 1) / plan.batch_suns();
  const std::size_t some = std::min(batches, there_are);
  for (std::size_t b = 0; b < some; ++b) {
    const std::size_t first = (2 * b + 1) * there_are / (2 * some) * plan.batch_suns();
    const auto light =
        lights.of(plan.light, first, std::min(plan.intervals() - first, plan.batch_suns()));
    const std::size_t before = lit.size();
    for (const auto& sun : light)
      if (!sun.is_dark()) lit.push_back(sun);
    // As they stand side by side in blocks of the batch.
    std::ranges::stable_sort(std::span(lit).subspan(before), {}, [](const IntervalLight& sun) {
      return place_in_batch(sun.direction);
    });
    work += solve(*transport, light, watch).work;
  }
  const auto patches = static_cast<double>(traced->patches.count());
  const auto all = static_cast<double>(there_are), computed = static_cast<double>(some);
  const Bare shadow_rays = bare_shadow_rays(*traced, lit), lines = bare_lines(*traced);
  fmt::print("sunload {} ({}), {}, {} threads; {} patches, {} lit suns, {} bounces\n", version,
             commit, plan.isa, thread_count(), traced->patches.count(), lit.size(),
             traced->bounces);
  tell_shares(*traced, lit);
  tell("lines", work[Work::line_rays], work[Work::lines_s], "rays");
  tell("direct and circumsolar", work[Work::direct_rays], work[Work::direct_s], "rays");
  tell("mirrored sun", work[Work::mirror_rays], work[Work::mirror_s], "rays");
  tell("sky and Jacobi", patches * static_cast<double>(lit.size()), work[Work::solve_s],
       "patches·suns");
  tell("realizations", patches * plan.study.solver.realizations, work[Work::realizations_s],
       "patches");
  tell("bare rays to suns", shadow_rays.rays, shadow_rays.seconds, "rays");
  tell("bare lines", lines.rays, lines.seconds, "rays");
  // Rays that were not needed count as cast: what matters is the time for all that are asked for.
  tell_share("direct sun", shadow_rays.rays, work[Work::direct_s], shadow_rays);
  if (const double bare = shadow_rays.seconds * all / computed; bare > 0)
    fmt::print("{:<24} {:10.2f} of the bare rays of the period ({:.1f} s)\n", "all of the period",
               (before_batches + (seconds_of(work) - before_batches) * all / computed) / bare,
               bare);
  tell_share("lines", work[Work::line_rays], work[Work::lines_s], lines);
  tell("shots", work[Work::samples], work[Work::shoot_s], "samples");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: solver_bench STUDY.yaml [BATCHES]\n");
    return 2;
  }
  try {
    bench(argv[1], argc > 2 ? std::stoul(argv[2]) : 1);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 2;
  }
}
