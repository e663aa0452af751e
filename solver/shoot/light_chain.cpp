// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shoot/light_chain.h"

#include "solver/mesh/linked_element.h"

namespace sunload {

LightChain::LightChain(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                       int mirror_depth, double largest_link)
    : walk_(scene, hierarchy, caster, mirror_depth),
      hierarchy_(hierarchy),
      largest_link_(largest_link) {}

Followed LightChain::follow(Vec3 w, const Hit& hit, std::uint32_t source, double weight,
                            RandomKey key, std::vector<Deposit>& deposits) const {
  return go_on(w, hit, source, weight, 0, key, largest_link_, deposits);
}

Followed LightChain::mirror_on(Vec3 point, Vec3 towards, std::size_t mirror_patch,
                               std::uint32_t source, double weight, RandomKey key,
                               std::vector<Deposit>& deposits) const {
  const Material& material = walk_.material_of_patch(mirror_patch);
  Onward on = onward(material, hierarchy_.normal(mirror_patch), towards, key);
  on.absorbed = absorbed_share(material, on);
  Followed sent;
  if (!walk_.goes_on(on, 0, weight, sent.fate)) return sent;
  ++key.block;
  sent += go_on(on.direction, walk_.first_hit(point, on.direction), source, weight, 1, key, 0,
                deposits);
  ++sent.rays;
  return sent;
}

Followed LightChain::go_on(Vec3 w, Hit hit, std::uint32_t source, double weight, int reflections,
                           RandomKey key, double largest_link,
                           std::vector<Deposit>& deposits) const {
  Followed sent;
  double path_m = 0;
  for (;; ++reflections, ++key.block) {
    const auto met = walk_.meet(hit, weight, sent.fate);
    if (!met) return sent;
    const auto& [patch, material] = *met;
    path_m += hit.distance_m;
    const Vec3 n = hierarchy_.normal(patch);
    const Vec3 point = walk_.point(hit, n);
    deposits.push_back(
        {linked_element(hierarchy_, patch, point, path_m, largest_link), source, weight});
    Onward on = sends_on(material) ? onward(material, n, -w, key) : Onward{};
    on.absorbed = absorbed_share(material, on);
    if (!walk_.goes_on(on, reflections, weight, sent.fate)) return sent;
    if (material.glossy > 0) path_m = 0;  // what a lobe sees is not seen from the beginning
    w = on.direction;
    hit = walk_.first_hit(point, w);
    ++sent.rays;
  }
}

}  // namespace sunload
