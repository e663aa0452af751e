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

void LineCollector::move_glimpses(std::size_t receiver, std::size_t realization,
                                  std::vector<Glimpse>& to) {
  for (Glimpse& glimpse : glimpses) {
    glimpse.receiver = static_cast<std::uint32_t>(receiver);
    glimpse.realization = static_cast<std::uint32_t>(realization);
    to.push_back(glimpse);
  }
  glimpses.clear();
}

LineCollector& LineCollector::operator+=(const LineCollector& other) {
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(patches, other.patches);
  append(sky, other.sky);
  append(sky_by_mirror, other.sky_by_mirror);
  ends.sky += other.ends.sky;
  ends.ground += other.ends.ground;
  ends.ground_by_mirror += other.ends.ground_by_mirror;
  ends.fate += other.ends.fate;
  lamps += other.lamps;
  return *this;
}

void LineCollector::store(LineSet& set, std::size_t row, std::size_t count) {
  const float scale = 1.0f / static_cast<float>(count);
  const std::size_t block = row / LinkTable::rows_per_block;
  set.patches.blocks[block].append_row(patches, scale);
  set.sky.blocks[block].append_row(sky, scale);
  set.sky_by_mirror.blocks[block].append_row(sky_by_mirror, scale);
  set.ends[row] = {.sky = ends.sky * scale,
                   .ground = ends.ground * scale,
                   .ground_by_mirror = ends.ground_by_mirror * scale,
                   .fate = scaled(ends.fate, scale)};
  if (!set.lamps.empty()) set.lamps[row] = lamps / static_cast<double>(count);
}

LineFollower::LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                           const SkyGrid& grid, int mirror_depth)
    : walk_(scene, hierarchy, caster, mirror_depth), hierarchy_(hierarchy), grid_(grid) {}

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

/// Links a line that left the scene along `w` with what it sees there.
void LineFollower::link_outside(Vec3 w, double weight, int reflections, LineCollector& into) const {
  const auto share = static_cast<float>(weight);
  if (w.z > 0) {
    if (reflections == 0) into.ends.sky += share;
    (reflections == 0 ? into.sky : into.sky_by_mirror).push_back({sky_cell(w), share});
  } else {
    (reflections == 0 ? into.ends.ground : into.ends.ground_by_mirror) += share;
  }
}

std::uint64_t LineFollower::follow(Vec3 origin, Vec3 w, const Hit& hit, const RandomKey& line,
                                   LineCollector& into, double share_of_first) const {
  FirstMeeting first{hit, walk_.patch_of(hit)};
  if (first.patch >= 0)
    first.element = linked_element(hierarchy_, static_cast<std::size_t>(first.patch),
                                   origin + w * hit.distance_m, hit.distance_m, into.largest_link);
  return follow(origin, w, first, line, into, share_of_first);
}

std::uint64_t LineFollower::follow(Vec3 origin, Vec3 w, const FirstMeeting& first,
                                   const RandomKey& line, LineCollector& into,
                                   double share_of_first) const {
  double weight = 1, path_m = 0;
  Hit hit = first.hit;
  std::int32_t patch_of_hit = first.patch;
  RandomKey key = line;
  for (int reflections = 0;; ++reflections) {  // as many rays, too
    const auto met = walk_.meet(hit, patch_of_hit, weight, into.ends.fate);
    if (hit.left_scene()) link_outside(w, weight, reflections, into);
    if (!met) return static_cast<std::uint64_t>(reflections);
    const auto& [patch, material] = *met;
    path_m += hit.distance_m;
    const double counted = reflections == 0 ? weight * share_of_first : weight;
    if (material.diffuse > 0 || material.emission_w_m2 > 0 || into.links_all) {
      const auto element = reflections == 0
                               ? first.element
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
