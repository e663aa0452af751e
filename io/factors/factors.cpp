// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/factors/factors.h"

#include <fmt/format.h>

#include <array>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "io/base/statistics.h"
#include "io/plan/rules_of_study.h"
#include "solver/matrix/group_factors.h"
#include "solver/surface/ray_caster.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

namespace {

constexpr std::array words{"patch", "facade", "object", "surface"};
constexpr std::array many{"patches", "facades", "objects", "kinds of surface"};

/// The patches' groups, before it is known which are there, with their names.
struct Division {
  std::vector<std::int32_t> of_patch;  ///< -1: none
  std::vector<std::string> names;
};

Division division_of(const Mesh& mesh, const Hierarchy& hierarchy, FactorsBetween between) {
  Division division;
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    switch (between) {
      case FactorsBetween::patches:
        division.of_patch.push_back(static_cast<std::int32_t>(i));
        division.names.push_back(std::to_string(i));
        break;
      case FactorsBetween::facades:
        division.of_patch.push_back(patch.side == 0 ? mesh.triangle_facade[t].value : -1);
        break;
      case FactorsBetween::objects:
        division.of_patch.push_back(mesh.triangle_object[t].value);
        break;
      case FactorsBetween::surfaces:
        division.of_patch.push_back(static_cast<std::int32_t>(mesh.triangle_surface[t]));
        break;
    }
  }
  if (between == FactorsBetween::facades)
    for (const Facade& facade : mesh.facades) division.names.push_back(facade.name);
  if (between == FactorsBetween::objects) division.names = mesh.object_names;
  if (between == FactorsBetween::surfaces)
    division.names.assign(surface_names.begin(), surface_names.end());
  return division;
}

/// Without groups of no patches.
Division without_empty(const Division& all) {
  std::vector<std::int32_t> number(all.names.size(), -1);
  for (const auto group : all.of_patch)
    if (group >= 0) number[static_cast<std::size_t>(group)] = 0;
  Division left;
  for (std::size_t g = 0; g < number.size(); ++g) {
    if (number[g] < 0) continue;
    number[g] = static_cast<std::int32_t>(left.names.size());
    left.names.push_back(all.names[g]);
  }
  for (const auto group : all.of_patch)
    left.of_patch.push_back(group < 0 ? -1 : number[static_cast<std::size_t>(group)]);
  return left;
}

void expect_few(const VariantPlan& plan, FactorsBetween between, std::size_t rows) {
  if (rows == 0)
    throw InputError(plan.study.scene.where, "the scene has no facades",
                     "form factors between them have no rows", "write --of object or surface");
  if (rows <= most_factor_groups) return;
  const auto kind = static_cast<std::size_t>(between);
  const bool is_of_patches = between == FactorsBetween::patches;
  throw InputError(plan.study.scene.where,
                   fmt::format("the scene has {} {}, and form factors are made between {} at most",
                               rows, many[kind], most_factor_groups),
                   fmt::format("each has one with every other: {:.2g} numbers",
                               static_cast<double>(rows) * static_cast<double>(rows)),
                   is_of_patches
                       ? "write --of facade, object or surface, or give the study a larger "
                         "mesh.max_edge_m (and mesh.oracle: none)"
                       : "write --of surface, or take a part of the scene");
}

std::vector<FactorTable::PatchFacts> patch_facts(const Mesh& mesh, const Hierarchy& hierarchy) {
  std::vector<FactorTable::PatchFacts> facts;
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    const FacadeId facade = mesh.triangle_facade[t];
    facts.push_back(
        {.object = mesh.object_names[mesh.triangle_object[t].index()],
         .facade = patch.side == 0 && facade.value >= 0 ? mesh.facades[facade.index()].name : "",
         .surface = surface_names.at(static_cast<std::size_t>(mesh.triangle_surface[t])),
         .side = patch.side,
         .centroid = hierarchy.centroid(i),
         .normal = hierarchy.normal(i)});
  }
  return facts;
}

/// Means over the realizations, with errors, and what of each row is missing.
void put_means(const GroupFactors& factors, FactorTable& table) {
  const std::size_t G = factors.groups, R = factors.realizations.size();
  table.factor.resize(G * G);
  table.factor_se.resize(G * G);
  std::vector<double> of_realizations(R);
  const auto mean_of = [&](const auto& value) {
    for (std::size_t r = 0; r < R; ++r) of_realizations[r] = value(r);
    return sample_mean(of_realizations);
  };
  for (std::size_t g = 0; g < G; ++g) {
    double sum = 0;
    for (std::size_t at = g * G; at < (g + 1) * G; ++at) {
      const SampleMean mean = mean_of([&](std::size_t r) { return factors.realizations[r][at]; });
      table.factor[at] = mean.mean;
      table.factor_se[at] = mean.se;
      sum += mean.mean;
    }
    table.elsewhere.push_back(1 - sum);
    table.elsewhere_se.push_back(mean_of([&](std::size_t r) {
                                   double of_row = 0;
                                   for (std::size_t h = 0; h < G; ++h)
                                     of_row += factors.realizations[r][g * G + h];
                                   return 1 - of_row;
                                 }).se);
  }
}

}  // namespace

FactorsBetween factors_between(const std::string& word) {
  if (word.empty()) return FactorsBetween::patches;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (word == words[k]) return static_cast<FactorsBetween>(k);
  throw InputError({}, "--of " + word, "form factors are not made between these",
                   "write patch, facade, object or surface");
}

std::string factor_word(FactorsBetween between) { return words[static_cast<std::size_t>(between)]; }

FactorTable form_factor_table(const VariantPlan& plan, const Hierarchy& mesh,
                              FactorsBetween between, Watch& watch) {
  const Scene& scene = plan.built.scene;
  const Division division = without_empty(division_of(scene.mesh, mesh, between));
  expect_few(plan, between, division.names.size());
  const SolverRules solver = solver_rules(plan);
  const RayCaster caster(scene.mesh, solver.isa);  // all that stands there, as solid
  const GroupFactors factors =
      group_factors(scene.mesh, mesh, caster, {division.of_patch, division.names.size()},
                    form_factor_rules(solver), watch);

  FactorTable table;
  table.between = between;
  table.study = plan.study.name;
  table.variant = plan.study.variant;
  table.content_hash = plan.content_hash;
  table.origin = scene.mesh.origin;
  table.name = division.names;
  table.area_m2 = factors.area;
  if (between == FactorsBetween::patches) table.patch = patch_facts(scene.mesh, mesh);
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    if (division.of_patch[i] < 0) table.area_of_none_m2 += mesh.area()[i];
  table.patches = mesh.patch_count();
  table.realizations = factors.realizations.size();
  table.rays = factors.rays;
  table.has_formulas = factors.has_formulas;
  put_means(factors, table);
  return table;
}

}  // namespace sunload
