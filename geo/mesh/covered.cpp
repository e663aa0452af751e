// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/covered.h"

#include <numeric>
#include <utility>

#include "geo/mesh/covered_parts.h"
#include "geo/mesh/covers.h"
#include "geo/mesh/divided_mesh.h"
#include "geo/mesh/slope.h"

namespace sunload {

CoveredCut cut_covered(Mesh& mesh, Bodies& bodies, const std::vector<std::uint8_t>& is_opaque,
                       const std::vector<std::uint8_t>& seals,
                       const std::vector<std::uint8_t>& emits, Cavities cavities) {
  const Covers covers(mesh, bodies, is_opaque, seals, emits, cavities);
  std::vector<std::pair<std::size_t, CoveredParts>> found;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.bears_patches(t) || !slope_of(mesh, t)) continue;
    auto result = covered_parts(mesh, covers, t);
    if (result.state != CoverState::open || !result.parts.empty())
      found.emplace_back(t, std::move(result));
  }
  CoveredCut nothing;
  nothing.source.resize(mesh.triangle_count());
  std::iota(nothing.source.begin(), nothing.source.end(), std::size_t{0});
  if (found.empty()) return nothing;
  DividedMesh divided(mesh, bodies, covers.contact() / roundings_per_contact);
  auto next = found.begin();
  for (std::size_t t = 0; t < nothing.source.size(); ++t) {
    if (next == found.end() || next->first != t) {
      divided.keep(t, mesh.is_covered(t) ? CoverState::covered : CoverState::open);
      continue;
    }
    if (next->second.taken_by) divided.note_taker(t, *next->second.taken_by);
    if (next->second.parts.empty())
      divided.keep(t, next->second.state);
    else
      divided.divide(t, next->second.parts);
    ++next;
  }
  return divided.finish();
}

}  // namespace sunload
