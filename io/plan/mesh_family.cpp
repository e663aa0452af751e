// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/mesh_family.h"

#include <algorithm>
#include <utility>

#include "geo/base/check.h"
#include "io/base/hash.h"
#include "io/plan/content_hash.h"

namespace sunload {

namespace {

bool is_refined(const Study& study) { return study.mesh.oracle != Oracle::none; }

/// All that decides a mesh but materials and light.
std::string family_key(const VariantPlan& plan) {
  Study rules;
  rules.mesh = plan.study.mesh;
  Digest digest;
  digest.add(geometry_digest(plan.built.scene.mesh));
  digest.add(canonical_text(rules));
  digest.add(plan.isa);
  return digest.hex();
}

std::shared_ptr<const MeshFamily> family_of(std::map<std::string, MeshPilotInput> pilots) {
  auto family = std::make_shared<MeshFamily>();
  Digest digest;
  const std::size_t count = std::min(pilots.size(), most_mesh_pilots);
  for (std::size_t p = 0; p < count; ++p) {
    const auto chosen =
        std::next(pilots.begin(), static_cast<std::ptrdiff_t>(p * pilots.size() / count));
    digest.add(chosen->first);
    family->pilots.push_back(std::move(chosen->second));
  }
  if (count > 1) family->digest = digest.hex();
  return family;
}

}  // namespace

MeshFamilies::MeshFamilies(const StudyFile& file, Planner& planner) {
  const auto changes = [](const Study& study) { return !study.seasons.empty(); };
  if (std::count_if(file.variants.begin(), file.variants.end(), is_refined) < 2 &&
      std::none_of(file.variants.begin(), file.variants.end(), changes))
    return;
  Problems problems;
  for (const Study& study : file.variants) {
    try {
      if (is_refined(study)) add(planner.unhashed_plan(study));
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  for (auto& [key, members] : members_)
    if (members.variants > 1 || members.pilots.size() > 1)
      families_[key] = family_of(std::move(members.pilots));
  members_.clear();
}

void MeshFamilies::add(const VariantPlan& plan) {
  const std::string& key = key_of_[plan.study.variant] = family_key(plan);
  Members& members = members_[key];
  ++members.variants;
  const auto add_pilot = [&](const Scene& scene, const std::shared_ptr<const PeriodLight>& light) {
    const std::string digest = pilot_digest(scene, *light);
    members.pilots.try_emplace(
        digest, MeshPilotInput{scene.materials, scene.material, scene.luminaires, light});
  };
  if (plan.seasons.all.empty()) return add_pilot(plan.built.scene, light_of(plan));
  for (std::size_t s = 0; s < plan.seasons.all.size(); ++s)
    add_pilot(scene_in(plan.built.scene, plan.seasons.all[s]),
              std::make_shared<const PeriodLight>(period_light(plan, s)));
}

std::shared_ptr<const PeriodLight> MeshFamilies::light_of(const VariantPlan& plan) {
  const std::string key = Planner::key_of_light(plan.study, plan.built.site);
  if (const auto* known = lights_.of(key)) return *known;
  return lights_.keep(key, std::make_shared<const PeriodLight>(period_light(plan)), 1);
}

void MeshFamilies::join(VariantPlan& plan) const {
  if (families_.empty() || !is_refined(plan.study)) return;
  const auto key = key_of_.find(plan.study.variant);
  SUNLOAD_EXPECT(key != key_of_.end(), "a plan of another study asks for its mesh");
  const auto family = families_.find(key->second);
  if (family == families_.end()) return;
  plan.family = family->second;
  plan.content_hash = hash_with_isa(plan, plan.isa);
}

}  // namespace sunload
