// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/light_chain.h"

#include "solver/lines/line_follower.h"
#include "solver/mesh/linked_element.h"

namespace sunload {

namespace {

/// Share of the light on a surface that it absorbs, where `on` says what it sends on.
double absorbed_share(const Material& m, const LineFollower::Onward& on) {
  return depends_on_angle(m) ? on.absorbed : 1 - m.diffuse - m.mirror - m.transmittance;
}

}  // namespace

Fate& Fate::operator+=(const Fate& other) {
  absorbed += other.absorbed;
  backs += other.backs;
  escaped += other.escaped;
  cut += other.cut;
  transmitted += other.transmitted;
  rays += other.rays;
  return *this;
}

void Fates::add(const Fate& fate, const double* power) {
  for (std::size_t k = 0; k < block_width; ++k) {
    absorbed[k] += power[k] * fate.absorbed;
    backs[k] += power[k] * fate.backs;
    escaped[k] += power[k] * fate.escaped;
    cut[k] += power[k] * fate.cut;
    transmitted[k] += power[k] * fate.transmitted;
  }
}

Fates& Fates::operator+=(const Fates& other) {
  for (std::size_t k = 0; k < block_width; ++k) {
    absorbed[k] += other.absorbed[k];
    backs[k] += other.backs[k];
    escaped[k] += other.escaped[k];
    cut[k] += other.cut[k];
    transmitted[k] += other.transmitted[k];
  }
  return *this;
}

LightChain::LightChain(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                       int mirror_depth, double largest_link)
    : scene_(scene),
      hierarchy_(hierarchy),
      caster_(caster),
      mirror_depth_(mirror_depth),
      largest_link_(largest_link) {}

const Material& LightChain::material_of(std::int32_t triangle) const {
  return scene_.materials[scene_.material[static_cast<std::size_t>(triangle)].index()];
}

Vec3 LightChain::lifted_point(const Hit& hit, Vec3 normal) const {
  const auto t = static_cast<std::size_t>(hit.triangle);
  const Mesh& mesh = scene_.mesh;
  return mesh.corner(t, 0) * (1 - hit.u - hit.v) + mesh.corner(t, 1) * hit.u +
         mesh.corner(t, 2) * hit.v + normal * caster_.offset_m();
}

Fate LightChain::follow(Vec3 w, const Hit& hit, std::uint32_t source, double weight, RandomKey key,
                        std::vector<Deposit>& deposits) const {
  return go_on(w, hit, source, weight, 0, key, largest_link_, deposits);
}

Fate LightChain::mirror_on(Vec3 point, Vec3 towards, std::size_t mirror_patch, std::uint32_t source,
                           double weight, RandomKey key, std::vector<Deposit>& deposits) const {
  const Material& material = material_of(hierarchy_.patches()[mirror_patch].triangle);
  const auto on = LineFollower::onward(material, hierarchy_.normal(mirror_patch), towards, key);
  Fate fate;
  fate.absorbed = weight * absorbed_share(material, on);
  fate.transmitted = weight * on.transmitted;
  weight *= on.weight;
  if (weight <= 0) return fate;
  if (mirror_depth_ < 1) {  // not even the first reflection is followed
    fate.cut = weight;
    return fate;
  }
  ++key.block;
  fate += go_on(on.direction, caster_.first_hit(point, on.direction), source, weight, 1, key, 0,
                deposits);
  ++fate.rays;
  return fate;
}

Fate LightChain::go_on(Vec3 w, Hit hit, std::uint32_t source, double weight, int reflections,
                       RandomKey key, double largest_link, std::vector<Deposit>& deposits) const {
  Fate fate;
  double path_m = 0;
  for (;; ++reflections, ++key.block) {
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
    weight /= 1 - material.transmittance;  // rays are stopped by that share
    path_m += hit.distance_m;
    const Vec3 n = hierarchy_.normal(static_cast<std::size_t>(patch));
    const Vec3 point = lifted_point(hit, n);
    deposits.push_back(
        {linked_element(hierarchy_, static_cast<std::size_t>(patch), point, path_m, largest_link),
         source, weight});
    const auto on =
        sends_on(material) ? LineFollower::onward(material, n, -w, key) : LineFollower::Onward{};
    fate.absorbed += weight * absorbed_share(material, on);
    fate.transmitted += weight * on.transmitted;
    weight *= on.weight;
    if (weight <= 0) return fate;
    if (reflections == mirror_depth_) {
      fate.cut = weight;
      return fate;
    }
    if (material.glossy > 0) path_m = 0;  // what a lobe sees is not seen from the beginning
    w = on.direction;
    hit = caster_.first_hit(point, w);
    ++fate.rays;
  }
}

}  // namespace sunload
