// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/sun_images.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "solver/base/rng.h"
#include "solver/base/sampling.h"

namespace sunload {

namespace {

/// In which a sun is looked for in mirrors; of more orientations so many are chosen, by the power
/// that they send on.
constexpr std::size_t most_images = 4;
/// Words of the pilot that its points, directions and emitters leave over begin here.
constexpr std::uint32_t first_words = 6;
/// By so many offsets of rays a box is wider than its mirrors: floats place both to a part of one.
constexpr double box_offsets = 8;

Vec3 along(const SunImage& image, Vec3 p) {
  return {dot(p, image.axes.tangent), dot(p, image.axes.bitangent), dot(p, image.direction)};
}

}  // namespace

SunImages::SunImages(const Scene& scene, const RayCaster& caster, const PeriodLight& light,
                     std::uint64_t seed)
    : scene_(scene),
      caster_(caster),
      seed_(seed),
      has_screens_(!screens(scene).transmittance.empty()),
      mirrors_(scene) {
  for (std::size_t g = 0; g < mirrors_.size(); ++g) {
    mirror_area_m2_.push_back(0);
    for (const auto t : mirrors_[g].triangles)
      mirror_area_m2_[g] += scene.mesh.area_m2(static_cast<std::size_t>(t));
  }
  for (std::size_t h = 0; h < of_half_.size(); ++h) {
    add_images(light, light.suns, h);
    add_images(light, light.samples[h], h);
  }
}

SunImage SunImages::image(const PeriodSun& sun, std::size_t group, double probability) const {
  SunImage made{.direction = -mirrored(sun.direction, mirrors_[group].normal),
                .sun = sun.direction,
                .group = static_cast<std::int32_t>(group),
                .exposure = sun.exposure / probability,
                .axes = {},
                .mirrors = {}};
  made.axes = tangents(made.direction);
  for (const auto t : mirrors_[group].triangles)
    for (int k = 0; k < 3; ++k)
      include(made.mirrors, along(made, scene_.mesh.corner(static_cast<std::size_t>(t), k)));
  made.mirrors = widened(made.mirrors, box_offsets * caster_.offset_m());
  return made;
}

void SunImages::add_images(const PeriodLight& light, const std::vector<PeriodSun>& suns,
                           std::size_t half) {
  const bool is_of_both = !light.suns.empty();
  for (std::size_t s = 0; s < suns.size(); ++s) {
    std::vector<std::size_t> groups;
    std::vector<double> powers;  // of them and all before
    double power = 0;
    for (std::size_t g = 0; g < mirrors_.size(); ++g) {
      const double cos_theta = dot(mirrors_[g].normal, suns[s].direction);
      if (cos_theta <= 0) continue;
      const double own = mirrors_.strongest(g, cos_theta) * mirror_area_m2_[g] * cos_theta;
      if (own <= 0) continue;
      groups.push_back(g);
      powers.push_back(power += own);
    }
    if (groups.size() <= most_images) {
      if (is_of_both && half > 0) continue;
      auto& images = is_of_both ? of_both_ : of_half_[half];
      for (const auto group : groups) images.push_back(image(suns[s], group, 1));
      continue;
    }
    const RandomWords words =
        random_words({.seed = seed_,
                      .purpose = Purpose::mesh_pilot,
                      .realization = first_words + static_cast<std::uint32_t>(half),
                      .element = s});
    const double start = static_cast<double>(uniform(words[0]));
    for (std::size_t i = 0; i < most_images; ++i) {
      const double at = (static_cast<double>(i) + start) / most_images * powers.back();
      const auto chosen = static_cast<std::size_t>(
          std::lower_bound(powers.begin(), powers.end() - 1, at) - powers.begin());
      const double own = powers[chosen] - (chosen > 0 ? powers[chosen - 1] : 0);
      of_half_[half].push_back(image(suns[s], groups[chosen], most_images * own / powers.back()));
    }
  }
}

bool SunImages::can_be_seen(const SunImage& image, const RayCorners& corners) const {
  Box box;
  for (const Vec3 corner : corners) include(box, along(image, corner));
  const Box& mirrors = image.mirrors;
  return box.low.x <= mirrors.high.x && box.high.x >= mirrors.low.x &&
         box.low.y <= mirrors.high.y && box.high.y >= mirrors.low.y && box.low.z <= mirrors.high.z;
}

/// Only mirrors of the image's orientation count. Chance at screens would be the same for both
/// halves of the light and pass for light that varies: there single rays tell shares.
SunImages::OnMirrors SunImages::mirrors_met(const SunImage& image, const Packet& from) const {
  OnMirrors met{};
  const auto take = [&](std::size_t r, const Hit& hit, double share) {
    const bool is_known = (met.rays >> r & 1u) != 0;  // the nearest counts
    if (is_known || mirrors_.of_side(hit.triangle, hit.front) != image.group) return;
    const Vec3 n = met_normal(scene_.mesh, hit);
    put(met.points, r, lifted_point(scene_.mesh, hit, n, caster_.offset_m()));
    met.triangle[r] = hit.triangle;
    met.share[r] = static_cast<float>(share);
    met.rays |= 1u << r;
  };
  if (has_screens_) {
    for (std::size_t r = 0; r < packet_size; ++r)
      for (const auto& taker : caster_.takers(at(from, r), image.direction))
        take(r, taker.hit, taker.share);
    return met;
  }
  const PacketHits hits = caster_.first_hits(from, image.direction, all_rays);
  for (std::size_t r = 0; r < packet_size; ++r)
    if (const Hit hit = hits[r]; !hit.left_scene()) take(r, hit, 1);
  return met;
}

/// What a ray towards the image of a sun meets is a mirror of that orientation, and sees the sun
/// itself.
void SunImages::add(const std::vector<SunImage>& images, const RayCorners& corners,
                    const Packet& points, Vec3 normal, double* sum) const {
  for (const SunImage& image : images) {
    const double cos_theta = dot(normal, image.direction);
    if (cos_theta <= 0 || !can_be_seen(image, corners)) continue;
    const OnMirrors met = mirrors_met(image, points);
    if (met.rays == 0) continue;
    const auto lit = caster_.passed_each(met.points, same_for_all(image.sun), met.rays);
    const double cos_at_mirror =
        dot(mirrors_[static_cast<std::size_t>(image.group)].normal, image.sun);
    for (auto rays = met.rays; rays != 0; rays &= rays - 1) {
      const auto r = static_cast<std::size_t>(std::countr_zero(rays));
      sum[r] += image.exposure * cos_theta *
                mirrors_.weight_of_hit(met.triangle[r], cos_at_mirror) *
                static_cast<double>(met.share[r]) * static_cast<double>(lit[r]);
    }
  }
}

}  // namespace sunload
