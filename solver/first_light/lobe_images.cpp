// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/lobe_images.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "geo/base/units.h"
#include "solver/base/threads.h"
#include "solver/surface/lobe.h"

namespace sunload {

namespace {

// A lobe of exponent e is 1/√e wide. Surfaces share their images where these differ by a quarter of
// that: a density so near adds little noise.
constexpr double shared_width = 0.125;

// Below this exponent a lobe may reach where the density about an image that is shared does not.
constexpr double broadest = 10;

// Where the lobe is fainter than this, relative to its middle, it is not looked for (as in
// solver/first_light/glossy_sun.cpp).
constexpr double least_lobe = 1e-8;

// Each costs every receiver and sun; of patches there are more.
constexpr std::size_t most_orientations_of_sensors = 4096, most_orientations_of_patches = 512;

}  // namespace

LobeImages::LobeImages(const Scene& scene, const RayCaster& caster, const SunSampler& receivers,
                       const LineRules& rules)
    : scene_(scene),
      caster_(caster),
      receivers_(receivers),
      least_exponent_(std::max(
          broadest, 2.0 * rules.lines_per_patch / static_cast<double>(receivers.samples()) - 1)),
      samples_each_(static_cast<double>(receivers.samples()) / rules.realizations) {
  if (receivers.receivers() == 0 || rules.mirror_depth < 1) return;
  const std::size_t most =
      receivers.are_points() ? most_orientations_of_sensors : most_orientations_of_patches;
  of_side_.assign(2 * scene.mesh.triangle_count(), -1);
  std::map<std::size_t, OrientationIndex> of_material;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    if (!is_narrow(scene_.material_of(t))) continue;
    add_side(t, true, of_material);
    if (scene.mesh.triangle_sides[t] == Sides::two) add_side(t, false, of_material);
    if (orientations_.size() <= most) continue;
    orientations_.clear();  // lines do it, with their noise
    least_exponent_ = std::numeric_limits<double>::infinity();
    return;
  }
}

void LobeImages::add_side(std::size_t triangle, bool front,
                          std::map<std::size_t, OrientationIndex>& of_material) {
  const Vec3 n = scene_.mesh.normal(triangle, front);
  const MaterialId material = scene_.material[triangle];
  const double exponent = scene_.material_of(triangle).glossy_exponent;
  OrientationIndex& known =
      of_material.try_emplace(material.index(), shared_width / std::sqrt(exponent)).first->second;
  std::int32_t number = known.find(n);
  if (number < 0) {
    number = static_cast<std::int32_t>(orientations_.size());
    const Vec3 corner = scene_.mesh.corner(triangle, 0);
    const double reach = std::acos(std::pow(least_lobe, 1 / exponent));
    const double apart = std::sin(shared_width / std::sqrt(exponent));
    orientations_.push_back({n, material, exponent, reach, apart, corner, corner});
    known.add(n, number);
  }
  of_side_[2 * triangle + (front ? 0u : 1u)] = number;
  Orientation& found = orientations_[static_cast<std::size_t>(number)];
  for (int c = 0; c < 3; ++c) {
    const Vec3 p = scene_.mesh.corner(triangle, c);
    found.low = {std::min(found.low.x, p.x), std::min(found.low.y, p.y),
                 std::min(found.low.z, p.z)};
    found.high = {std::max(found.high.x, p.x), std::max(found.high.y, p.y),
                  std::max(found.high.z, p.z)};
  }
}

bool LobeImages::stand_for(const Glimpse& glimpse) const {
  return glimpse.reflections == 0 && is_narrow(scene_.material_of(glimpse.triangle));
}

/// What one receiver gets of one sun.
class LobeImages::Receiver {
 public:
  Receiver(const LobeImages& images, std::size_t receiver, const IntervalLight& sun)
      : i_(images),
        receiver_(receiver),
        sun_(sun),
        geometry_(images.receivers_.geometry(receiver)),
        middle_{geometry_.a[0], geometry_.a[1], geometry_.a[2]} {
    if (i_.receivers_.are_points()) return;
    const auto& [a, b, c] = i_.receivers_.corners(receiver);
    middle_ = (a + b + c) / 3;
    extent_ = std::max({norm(a - middle_), norm(b - middle_), norm(c - middle_)});
  }

  /// False only if nothing of the orientation can be seen along directions that would be drawn.
  bool may_see(const Orientation& o) const {
    const Vec3 to = (o.low + o.high) * 0.5 - middle_;
    const double radius = norm(o.high - o.low) / 2 + extent_, distance = norm(to);
    if (dot(to, geometry_.normal) < -radius || dot(to, o.normal) > radius + o.apart * distance)
      return false;
    if (distance <= radius) return true;
    const double off_axis =
        std::acos(std::clamp(dot(to, image(sun_.direction, o.normal)) / distance, -1.0, 1.0));
    return off_axis <= o.reach + std::asin(radius / distance) + sun_.disk_half_angle;
  }

  /// Adds the orientation's light to that of each realization.
  void look_for(std::size_t orientation, std::vector<double>& of_realization) {
    const Orientation& o = i_.orientations_[orientation];
    if (seeds_.u.empty()) seed();
    for (std::size_t p = 0; p < i_.receivers_.packets(); ++p) {
      const ScrambledPoints points = i_.receivers_.points(seeds_, p);
      // By the coordinates of origins, not of the lobe: with these they fill four dimensions. On a
      // sensor, all but one point, that is no matter; on patches seeds of their own make it none.
      to_sun_ = i_.receivers_.directions_by_origins(
          sun_, i_.receivers_.are_points() ? seeds_ : disk_seeds_, p);
      PacketDirections directions{};
      std::uint32_t ahead = 0;
      for (auto bits = i_.receivers_.active(p); bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(bits));
        const Vec3 local =
            sample_power_cosine(uniform(points.u[l]), uniform(points.v[l]), o.exponent);
        s_[l] = sun_.disk_half_angle > 0 ? normalized(at(to_sun_, l)) : sun_.direction;
        const Vec3 middle = image(s_[l], o.normal);
        const Tangents axes = tangents(middle);
        w_[l] = axes.tangent * local.x + axes.bitangent * local.y + middle * local.z;
        if (dot(w_[l], geometry_.normal) > 0) ahead |= 1u << l;
        put(directions, l, w_[l]);
      }
      if (ahead == 0) continue;
      const Packet origins = i_.receivers_.origins(geometry_, seeds_, p);
      rays += static_cast<std::uint64_t>(std::popcount(ahead));
      const auto hits = i_.caster_.first_hits(origins, directions, ahead);
      for (auto lit = lit_of(hits, ahead, orientation); lit != 0; lit &= lit - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(lit));
        of_realization[i_.receivers_.realization(p * packet_size + l)] += brings_[l];
      }
    }
  }

  std::uint64_t rays = 0;

 private:
  void seed() {
    i_.receivers_.seed(receiver_, sun_.number, seeds_, Purpose::glossy_sun);
    if (!i_.receivers_.are_points())
      i_.receivers_.seed(receiver_, sun_.number, disk_seeds_, Purpose::glossy_disk);
  }

  /// Which of the hits lie on the orientation and in the sun; sets what these bring.
  std::uint32_t lit_of(const PacketHits& hits, std::uint32_t ahead, std::size_t orientation) {
    Packet points{};
    std::uint32_t on_it = 0;
    for (auto bits = ahead; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      const Hit hit = hits[l];
      if (hit.left_scene()) continue;
      const auto t = static_cast<std::size_t>(hit.triangle);
      if (i_.of_side_[2 * t + (hit.front ? 0u : 1u)] != static_cast<std::int32_t>(orientation))
        continue;
      const Mesh& mesh = i_.scene_.mesh;
      const Vec3 n = met_normal(mesh, hit);
      brings_[l] = brought(i_.orientations_[orientation], n, w_[l], s_[l]);
      if (brings_[l] <= 0) continue;
      on_it |= 1u << l;
      put(points, l, lifted_point(mesh, hit, n, i_.caster_.offset_m()));
    }
    if (on_it == 0) return 0;
    rays += static_cast<std::uint64_t>(std::popcount(on_it));
    const auto shares = i_.caster_.passed_each(points, to_sun_, on_it);
    for (auto bits = on_it; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      brings_[l] *= static_cast<double>(shares[l]);
    }
    return any_passed(shares);
  }

  /// `w`: the way to the surface; `s`: from there to the point of the sun.
  double brought(const Orientation& o, Vec3 n, Vec3 w, Vec3 s) const {
    const Material& m = i_.scene_.materials[o.material.index()];
    const double cos_s = dot(n, sun_.direction), cos_theta = dot(w, geometry_.normal);
    if (cos_s <= 0) return 0;
    // Rays are stopped by 1 - T of what they meet.
    const double f = m.glossy / (1 - m.transmittance) * lobe_value(dot(image(w, n), s), o.exponent);
    const double p = power_cosine_pdf(dot(w, image(s, o.normal)), o.exponent);
    return p > 0 ? f * cos_s * cos_theta * sun_.dni / (p * i_.samples_each_) : 0;
  }

  const LobeImages& i_;
  std::size_t receiver_;
  const IntervalLight& sun_;
  SunSampler::Geometry geometry_;
  Vec3 middle_;        ///< of the receiver
  double extent_ = 0;  ///< of a patch, from there
  SunSampler::Seeds seeds_, disk_seeds_;
  PacketDirections to_sun_;
  Vec3 s_[packet_size], w_[packet_size];
  double brings_[packet_size];
};

std::uint64_t LobeImages::add_light(std::span<const IntervalLight> block,
                                    const RaySink& into) const {
  constexpr std::size_t receivers_per_task = 16;
  if (orientations_.empty()) return 0;
  return ordered_sum(
      receivers_.receivers(), receivers_per_task, std::uint64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        std::vector<double> of_realization(into.realizations());
        for (std::size_t i = begin; i < end; ++i)
          for (std::size_t k = 0; k < block.size(); ++k) {
            if (!block[k].has_sun() || block[k].dni <= 0) continue;
            std::fill(of_realization.begin(), of_realization.end(), 0);
            Receiver receiver(*this, i, block[k]);
            for (std::size_t o = 0; o < orientations_.size(); ++o)
              if (dot(block[k].direction, orientations_[o].normal) > -orientations_[o].apart &&
                  receiver.may_see(orientations_[o]))
                receiver.look_for(o, of_realization);
            rays += receiver.rays;
            if (receiver.rays == 0) continue;
            into.add_all(i, k, [&](std::size_t r) { return of_realization[r]; });
          }
        return rays;
      });
}

}  // namespace sunload
