// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the solver is on a study: lines, shadow rays, sky and Jacobi, shots, per second.
//   solver_bench STUDY.yaml [BATCHES]
// The study's first variant on its own mesh, its first BATCHES batches (default 1). A speed is told
// with version, commit and instruction set; compare two of them on one quiet machine, in turn.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "geo/base/check.h"
#include "io/base/version.h"
#include "io/plan/interval_lights.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
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

void bench(const std::string& path, std::size_t batches) {
  const VariantPlan plan = make_plan(read_study(path).variants.front());
  Watch watch;
  const auto made = make_mesh(plan, watch);
  const auto traced = trace_scene(plan.built.scene, made.mesh, solver_rules(plan), watch);
  const auto transport = transport_of(*traced);
  WorkDone work = traced->work;
  work += transport->work();
  std::size_t suns = 0;
  const IntervalLights lights(plan.study, plan.built.site, traced->grid);
  for (std::size_t first = 0; first < std::min(plan.intervals(), batches * plan.batch_suns());
       first += plan.batch_suns()) {
    const auto light =
        lights.of(plan.light, first, std::min(plan.intervals() - first, plan.batch_suns()));
    for (const auto& sun : light) suns += !sun.is_dark();
    work += solve(*transport, light, watch).work;
  }
  const auto patches = static_cast<double>(traced->patches.count());
  const auto lit = static_cast<double>(suns);
  fmt::print("sunload {} ({}), {}, {} threads; {} patches, {} lit suns, {} bounces\n", version,
             commit, plan.isa, thread_count(), traced->patches.count(), suns, traced->bounces);
  tell("lines", work[Work::line_rays], work[Work::lines_s], "rays");
  tell("direct and circumsolar", work[Work::direct_rays], work[Work::direct_s], "rays");
  tell("mirrored sun", work[Work::mirror_rays], work[Work::mirror_s], "rays");
  tell("sky and Jacobi", patches * lit, work[Work::solve_s], "patches·suns");
  tell("realizations", patches * plan.study.solver.realizations, work[Work::realizations_s],
       "patches");
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
