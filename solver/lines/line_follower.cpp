// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/line_follower.h"

#include "geo/base/check.h"
#include "solver/base/sampling.h"
#include "solver/mesh/linked_element.h"
#include "solver/surface/lobe.h"

namespace sunload {

namespace {

/// Unit normal of the side of a triangle that was met.
Vec3 met_normal(const Mesh& mesh, const Hit& hit) {
  const Vec3 n = normalized(mesh.area_vector2(static_cast<std::size_t>(hit.triangle)));
  return hit.front ? n : -n;
}

}  // namespace

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
  ends.escaped += other.ends.escaped;
  ends.backs += other.ends.backs;
  ends.cut += other.ends.cut;
  ends.transmitted += other.ends.transmitted;
  ends.absorbed += other.ends.absorbed;
  lamps += other.lamps;
  return *this;
}

void LineCollector::store(LineSet& set, std::size_t row, std::size_t count) {
  const float scale = 1.0f / static_cast<float>(count);
  const std::size_t block = row / LinkTable::rows_per_block;
  LinkTable::append_row(set.patches.blocks[block], patches, scale);
  LinkTable::append_row(set.sky.blocks[block], sky, scale);
  LinkTable::append_row(set.sky_by_mirror.blocks[block], sky_by_mirror, scale);
  set.ends[row] = {ends.sky * scale,         ends.ground * scale,  ends.ground_by_mirror * scale,
                   ends.escaped * scale,     ends.backs * scale,   ends.cut * scale,
                   ends.transmitted * scale, ends.absorbed * scale};
  if (!set.lamps.empty()) set.lamps[row] = lamps / static_cast<double>(count);
}

LineFollower::LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                           const SkyGrid& grid, int mirror_depth)
    : scene_(scene),
      hierarchy_(hierarchy),
      caster_(caster),
      grid_(grid),
      mirror_depth_(mirror_depth) {}

const Material& LineFollower::material_of(std::int32_t triangle) const {
  return scene_.materials[scene_.material[static_cast<std::size_t>(triangle)].index()];
}

LineFollower::Onward LineFollower::onward(const Material& m, Vec3 n, Vec3 w, const RandomKey& key) {
  const double cos_theta = dot(w, n);
  Onward on{mirrored(w, n)};
  if (is_pane_or_metal(m)) {
    const SmoothShares shares = smooth_shares(m, cos_theta);
    on.weight = shares.mirror;
    on.transmitted = shares.transmitted;
    on.absorbed = 1 - m.diffuse - shares.mirror - shares.transmitted;
  } else if (m.glossy <= 0) {
    on.weight = m.mirror;
  } else {
    on.weight = m.mirror + m.glossy;
    const RandomWords random = random_words(key);
    if (uniform(random[2]) * on.weight >= m.mirror) {  // the lobe, in proportion to its share
      const Tangents axes = tangents(on.direction);
      const Vec3 local =
          sample_power_cosine(static_cast<double>(uniform(random[0])),
                              static_cast<double>(uniform(random[1])), m.glossy_exponent);
      on.direction = axes.tangent * local.x + axes.bitangent * local.y + on.direction * local.z;
      on.weight *= lobe_sample_weight(dot(on.direction, n), m.glossy_exponent);
    }
    // What the lobe returns at this angle is known by this sample alone.
    on.absorbed = 1 - m.diffuse - m.transmittance - on.weight;
  }
  return on;
}

Vec3 LineFollower::offset_point(std::int32_t triangle, const Hit& hit, Vec3 side_normal) const {
  const auto t = static_cast<std::size_t>(triangle);
  const Mesh& mesh = scene_.mesh;
  const Vec3 point = mesh.corner(t, 0) * (1 - hit.u - hit.v) + mesh.corner(t, 1) * hit.u +
                     mesh.corner(t, 2) * hit.v;
  return point + side_normal * caster_.offset_m();
}

Glimpse LineFollower::glimpse(const Hit& hit, Vec3 n, Vec3 w, double weight) const {
  const Vec3 at = offset_point(hit.triangle, hit, n), axis = mirrored(w, n);
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

std::uint64_t LineFollower::follow(Vec3 origin, Vec3 w, const Hit& first, const RandomKey& line,
                                   LineCollector& into, double share_of_first) const {
  std::uint64_t rays = 0;
  double weight = 1, path_m = 0;
  Hit hit = first;
  RandomKey key = line;
  for (int reflections = 0;; ++reflections) {
    const auto share = static_cast<float>(weight);
    if (hit.left_scene()) {
      into.ends.escaped += share;
      if (w.z > 0) {
        if (reflections == 0) into.ends.sky += share;
        (reflections == 0 ? into.sky : into.sky_by_mirror).push_back({sky_cell(w), share});
      } else {
        (reflections == 0 ? into.ends.ground : into.ends.ground_by_mirror) += share;
      }
      return rays;
    }
    const auto patch = hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
    if (patch < 0) {
      into.ends.backs += share;
      return rays;
    }
    path_m += hit.distance_m;
    const Material& material = material_of(hit.triangle);
    weight /= 1 - material.transmittance;  // rays are stopped by that share
    const double counted = reflections == 0 ? weight * share_of_first : weight;
    if (material.diffuse > 0 || material.emission_w_m2 > 0)
      into.patches.push_back(
          {linked_element(hierarchy_, static_cast<std::size_t>(patch), origin + w * hit.distance_m,
                          path_m, into.largest_link),
           static_cast<float>(counted)});
    into.lamps += counted * material.emission_w_m2;
    if (!sends_on(material)) return rays;
    const Vec3 n = met_normal(scene_.mesh, hit);
    if (material.glossy > 0 && reflections < mirror_depth_) {
      into.glimpses.push_back(glimpse(hit, n, -w, weight * material.glossy));
      into.glimpses.back().reflections = reflections;
    }
    key.block = static_cast<std::uint32_t>(reflections);
    const Onward on = onward(material, n, -w, key);
    into.ends.transmitted += static_cast<float>(weight * on.transmitted);
    into.ends.absorbed += static_cast<float>(weight * on.absorbed);
    weight *= on.weight;
    if (weight <= 0) return rays;
    if (reflections == mirror_depth_) {
      into.ends.cut += static_cast<float>(weight);
      return rays;
    }
    if (material.glossy > 0) path_m = 0;  // what a lobe sees is not seen from the line's beginning
    origin = offset_point(hit.triangle, hit, n);
    w = on.direction;
    hit = caster_.first_hit(origin, w);
    ++rays;
  }
}

void LineFollower::link(const BrightView::SeenPoint& point, LineCollector& into) const {
  into.patches.push_back(
      {linked_element(hierarchy_, point.patch, point.position, point.distance_m, into.largest_link),
       static_cast<float>(point.share)});
  into.lamps += point.share * point.exitance;
}

LineFollower::Fate LineFollower::mirrored_on(Vec3 origin, Vec3 w, std::size_t patch,
                                             const RandomKey& line,
                                             std::vector<LinkTable::Link>* met) const {
  // The line itself has used the blocks from 0 on.
  constexpr std::uint32_t blocks_of_first_light = 1u << 16;
  RandomKey key = line;
  key.block = blocks_of_first_light;
  const Onward on = onward(material_of_patch(patch), hierarchy_.normal(patch), w, key);
  Fate fate;
  if (on.weight > 0) {
    fate = sent_on(on.direction, on.weight, caster_.first_hit(origin, on.direction), &key, met);
    ++fate.rays;
  }
  fate.transmitted += on.transmitted;
  fate.absorbed += on.absorbed;
  return fate;
}

LineFollower::Fate LineFollower::sent_on(Vec3 w, double weight, const Hit& first,
                                         const RandomKey* line,
                                         std::vector<LinkTable::Link>* met) const {
  Fate fate;
  if (mirror_depth_ < 1) {  // not even the first reflection is followed
    fate.cut = weight;
    return fate;
  }
  Hit hit = first;
  RandomKey key = line ? *line : RandomKey{};
  for (int reflections = 1;; ++reflections) {
    if (hit.left_scene()) {
      fate.escaped = weight;
      return fate;
    }
    const auto patch = hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
    if (patch < 0) {
      fate.backs = weight;
      return fate;
    }
    const Material& material = material_of(hit.triangle);
    // Patches count what arrives, which is more than what stops rays.
    weight /= 1 - material.transmittance;
    if (met) met->push_back({static_cast<std::uint32_t>(patch), static_cast<float>(weight)});
    if (!sends_on(material)) return fate;
    const Vec3 n = met_normal(scene_.mesh, hit);
    Onward on;
    if (!line && material.glossy > 0) {
      on = {mirrored(-w, n), material.mirror, 0,
            1 - material.diffuse - material.mirror - material.glossy - material.transmittance};
      fate.cut += weight * material.glossy;
    } else {
      ++key.block;
      on = onward(material, n, -w, key);
    }
    fate.transmitted += weight * on.transmitted;
    fate.absorbed += weight * on.absorbed;
    weight *= on.weight;
    if (weight <= 0) return fate;
    if (reflections == mirror_depth_) {
      fate.cut += weight;
      return fate;
    }
    w = on.direction;
    hit = caster_.first_hit(offset_point(hit.triangle, hit, n), w);
    ++fate.rays;
  }
}

}  // namespace sunload
