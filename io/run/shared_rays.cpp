// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/shared_rays.h"

#include "io/base/machine.h"
#include "io/plan/content_hash.h"
#include "io/plan/mesh_family.h"

namespace sunload {

std::string rays_key(const VariantPlan& plan) {
  if (!plan.seasons.all.empty()) return {};
  const SolverStudy& solver = plan.study.solver;
  if (solver.transport != Transport::gather || solver.accuracy || has_lamps(plan)) return {};
  return rays_digest(plan.study, plan.built, plan.light, plan.isa,
                     plan.family ? plan.family->digest : std::string());
}

void SharedRays::expect(const std::string& key) {
  if (!key.empty()) ++shared_[key].variants;
}

void SharedRays::release(const std::string& key) {
  const auto found = shared_.find(key);
  if (found != shared_.end() && --found->second.variants == 0) shared_.erase(found);
}

TracedRays* SharedRays::of(const std::string& key) {
  const auto found = shared_.find(key);
  if (found == shared_.end()) return nullptr;
  Shared& shared = found->second;
  shared.rays.is_wanted_later = shared.variants > 1;
  const bool has_another = shared.rays.is_wanted_later || !shared.rays.traced_by.empty();
  return has_another ? &shared.rays : nullptr;
}

double SharedRays::room_bytes() {
  constexpr double share_of_free = 0.25;
  return share_of_free * available_memory_bytes();
}

}  // namespace sunload
