// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/line_follower.h"

#include "solver/base/random_blocks.h"
#include "solver/mesh/linked_element.h"

namespace sunload {

void LineCollector::clear() {
  patches.clear();
  sky.clear();
  sky_by_mirror.clear();
  glimpses.clear();
  ends = {};
  lamps = 0;
}

LineFollower::LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                           const SkyGrid& grid, int mirror_depth)
    : walk_(scene, hierarchy, caster, mirror_depth),
      hierarchy_(hierarchy),
      grid_(grid),
      at_surface_(at_surfaces(scene)) {}

std::vector<LineFollower::AtSurface> LineFollower::at_surfaces(const Scene& scene) {
  std::vector<AtSurface> of_material, all(scene.mesh.triangle_count());
  for (const Material& m : scene.materials) {
    const bool is_plain = !sends_on(m) && m.emission_w_m2 <= 0 && m.transmittance <= 0;
    of_material.push_back(!is_plain       ? AtSurface::followed
                          : m.diffuse > 0 ? AtSurface::linked
                                          : AtSurface::ended);
  }
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = of_material[scene.material[t].index()];
  return all;
}

Glimpse LineFollower::glimpse(const Hit& hit, Vec3 n, Vec3 w, double weight) const {
  const Vec3 at = walk_.point(hit, n), axis = mirrored(w, n);
  Glimpse glimpse;
  glimpse.triangle = hit.triangle;
  glimpse.front = hit.front ? 1 : 0;
  for (const auto& [to, from] : {std::pair{glimpse.at, at}, {glimpse.axis, axis}}) {
    to[0] = static_cast<float>(from.x);
    to[1] = static_cast<float>(from.y);
    to[2] = static_cast<float>(from.z);
  }
  glimpse.weight = static_cast<float>(weight);
  return glimpse;
}

void LineFollower::link_outside(Vec3 w, double weight, LineCollector& into) const {
  const auto share = static_cast<float>(weight);
  if (w.z > 0)
    into.sky_by_mirror.push_back({sky_cell(w), share});
  else
    into.ends.ground_by_mirror += share;
}

std::uint64_t LineFollower::follow(Vec3 origin, Vec3 w, const Hit& hit, const RandomKey& line,
                                   LineCollector& into, double share_of_first) const {
  FirstMeeting first{hit, walk_.patch_of(hit)};
  if (first.patch >= 0)
    first.target = linked_element(hierarchy_, static_cast<std::size_t>(first.patch),
                                  origin + w * hit.distance_m, hit.distance_m, into.largest_link);
  else if (hit.left_scene() && w.z > 0)
    first.target = sky_cell(w);
  return follow(origin, w, first, line, into, share_of_first);
}

std::uint64_t LineFollower::follow_on(Vec3 origin, Vec3 w, const FirstMeeting& first,
                                      const RandomKey& line, LineCollector& into,
                                      double share_of_first) const {
  double weight = 1, path_m = 0;
  Hit hit = first.hit;
  std::int32_t patch_of_hit = first.patch;
  RandomKey key = line;
  for (int reflections = 0;; ++reflections) {  // as many rays, too
    const auto met = walk_.meet(hit, patch_of_hit, weight, into.ends.fate);
    if (hit.left_scene()) link_outside(w, weight, into);
    if (!met) return static_cast<std::uint64_t>(reflections);
    const auto& [patch, material] = *met;
    path_m += hit.distance_m;
    const double counted = reflections == 0 ? weight * share_of_first : weight;
    if (material.diffuse > 0 || material.emission_w_m2 > 0 || into.links_all) {
      const auto element = reflections == 0
                               ? first.target
                               : linked_element(hierarchy_, patch, origin + w * hit.distance_m,
                                                path_m, into.largest_link);
      into.patches.push_back({element, static_cast<float>(counted)});
    }
    into.lamps += counted * material.emission_w_m2;
    if (!sends_on(material)) return static_cast<std::uint64_t>(reflections);
    const Vec3 n = walk_.normal(hit);
    if (material.glossy > 0 && reflections < walk_.mirror_depth()) {
      into.glimpses.push_back(glimpse(hit, n, -w, weight * material.glossy));
      into.glimpses.back().reflections = reflections;
    }
    key.block = line_blocks::of_line.first + static_cast<std::uint32_t>(reflections);
    const Onward on = onward(material, n, -w, key);
    if (!walk_.goes_on(on, reflections, weight, into.ends.fate))
      return static_cast<std::uint64_t>(reflections);
    if (material.glossy > 0) path_m = 0;  // what a lobe sees is not seen from the line's beginning
    origin = walk_.point(hit, n);
    w = on.direction;
    hit = walk_.first_hit(origin, w);
    patch_of_hit = walk_.patch_of(hit);
  }
}

void LineFollower::link(const BrightView::SeenPoint& point, LineCollector& into) const {
  into.patches.push_back(
      {linked_element(hierarchy_, point.patch, point.position, point.distance_m, into.largest_link),
       static_cast<float>(point.share)});
  into.lamps += point.share * point.exitance;
}

Followed LineFollower::mirrored_on(Vec3 origin, Vec3 w, std::size_t patch, const RandomKey& line,
                                   std::vector<LinkTable::Link>* met) const {
  RandomKey key = line;
  key.block = line_blocks::of_mirrored_light.first;
  const Onward on = onward(material_of_patch(patch), hierarchy_.normal(patch), w, key);
  Followed sent;
  if (on.weight > 0) {
    sent = sent_on(on.direction, on.weight, walk_.first_hit(origin, on.direction), key, met);
    ++sent.rays;
  }
  sent.fate.transmitted += on.transmitted;
  sent.fate.absorbed += on.absorbed;
  return sent;
}

Followed LineFollower::sent_on(Vec3 w, double weight, const Hit& first, RandomKey key,
                               std::vector<LinkTable::Link>* links) const {
  Followed sent;
  if (walk_.mirror_depth() < 1) {  // not even the first reflection is followed
    sent.fate.cut = weight;
    return sent;
  }
  Hit hit = first;
  for (int reflections = 1;; ++reflections) {
    const auto met = walk_.meet(hit, weight, sent.fate);
    if (!met) return sent;
    const auto& [patch, material] = *met;
    if (links) links->push_back({static_cast<std::uint32_t>(patch), static_cast<float>(weight)});
    if (!sends_on(material)) return sent;
    const Vec3 n = walk_.normal(hit);
    ++key.block;
    const Onward on = onward(material, n, -w, key);
    if (!walk_.goes_on(on, reflections, weight, sent.fate)) return sent;
    w = on.direction;
    hit = walk_.first_hit(walk_.point(hit, n), w);
    ++sent.rays;
  }
}

}  // namespace sunload
