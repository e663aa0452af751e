// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// `sunload export --to form-factors`: of the scene of a result, or of a study.
#include <fmt/format.h>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/output_target.h"
#include "io/base/standard_streams.h"
#include "io/command/commands.h"
#include "io/explain/result_scene.h"
#include "io/factors/factors.h"
#include "io/plan/mesh_family.h"
#include "io/plan/variant_mesh.h"
#include "io/run/options.h"
#include "io/study/named_files.h"

namespace sunload {
namespace {

/// Of the patches that a run of the study's variant would have.
FactorTable of_study(const FormFactorOptions& options, FactorsBetween between, Watch& watch) {
  const StudyFile file = read_study(options.input);
  expect_not_read(options.output, named_files(file));
  RunOptions chosen;
  if (!options.variant.empty()) chosen.variants = {options.variant};
  const Study study = chosen_variants(file, chosen).front();
  tell_warnings(file.warnings);
  Planner planner;
  const MeshFamilies families(file, planner);
  VariantPlan plan = planner.plan(study);
  expect_not_read(options.output, plan.built.files);
  families.join(plan);
  tell_warnings(plan.built.warnings, study.variant);
  return form_factor_table(plan, *make_mesh(plan, watch).mesh, between, watch);
}

FactorTable of_result(const FormFactorOptions& options, FactorsBetween between, Watch& watch) {
  if (!options.variant.empty())
    throw InputError({}, "--variant without a study", "a result is of one variant",
                     "name the result of the variant, or the study");
  const auto result = opened({options.input, {}, {}});
  const auto scene = ResultScenes(options.study_folder).of(*result);
  expect_not_read(options.output, scene->files());
  return form_factor_table(scene->plan(), *scene->traced().mesh, between, watch);
}

}  // namespace

int export_form_factors(const FormFactorOptions& options) {
  const FactorsBetween between = factors_between(options.of);
  expect_factor_file(options.output);
  Watch watch;
  const FactorTable table = is_study(options.input) ? of_study(options, between, watch)
                                                    : of_result(options, between, watch);
  if (between == FactorsBetween::facades && table.area_of_none_m2 > 0)
    tell(fmt::format("note: {:.6g} m² are of no facade and count as elsewhere",
                     table.area_of_none_m2));
  write_form_factors(table, options.output);
  return exit_code::done;
}

}  // namespace sunload
