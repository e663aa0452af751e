// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of light from surface to surface: what a ray has met, and what goes on from there.
///
/// All code that follows light by rays shares it: for lines, back to where light comes from; for
/// samples, on to where it goes; for the sun, from mirror to mirror. Each of them decides what it
/// leaves at the surfaces on the way.
#pragma once

#include <cstdint>
#include <optional>

#include "geo/base/check.h"
#include "solver/base/random_blocks.h"
#include "solver/light/fate.h"
#include "solver/mesh/hierarchy.h"
#include "solver/surface/onward.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// Where light went, and the rays cast to follow it.
struct Followed {
  Fate<double> fate;
  std::uint64_t rays = 0;
  Followed& operator+=(const Followed& other) {
    fate += other.fate;
    rays += other.rays;
    return *this;
  }
};

/// What a line met first, and the target of its link; for lines that are cast together both are
/// found together.
struct FirstMeeting {
  Hit hit;
  std::int32_t patch = -1;   ///< -1: it left the scene or met a back
  std::uint32_t target = 0;  ///< of its link: the element about the patch (`linked_element`), or
                             ///< the cell of the sky for which it left the scene
};

/// The steps themselves, const and shared by all threads; the caller keeps weight and direction.
class SurfaceWalk {
 public:
  /// Everything must outlive it. What was sent on `mirror_depth` times is cut.
  SurfaceWalk(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
              int mirror_depth)
      : scene_(scene), hierarchy_(hierarchy), caster_(caster), mirror_depth_(mirror_depth) {
    SUNLOAD_EXPECT(mirror_depth < static_cast<int>(blocks_of_chain),
                   "chains have random numbers for so many");
  }

  /// The patch that a ray has met, and what it is made of.
  struct Meeting {
    std::size_t patch;
    const Material& material;
  };
  /// Patch that was met; -1 where the light has left the scene or met a back.
  std::int32_t patch_of(const Hit& hit) const {
    return hit.left_scene() ? -1 : hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
  }
  /// What a ray that carries `weight` has met. A surface of transmittance T stops 1 - T of the
  /// rays: `weight` is divided by that, and becomes that of all light that arrives. Nothing where
  /// the light has left the scene or met a back; `fate` books it then.
  template <class T>
  std::optional<Meeting> meet(const Hit& hit, double& weight, Fate<T>& fate) const {
    return meet(hit, patch_of(hit), weight, fate);
  }
  /// The same where the patch is known already.
  template <class T>
  std::optional<Meeting> meet(const Hit& hit, std::int32_t patch, double& weight,
                              Fate<T>& fate) const {
    if (hit.left_scene()) {
      fate.escaped += static_cast<T>(weight);
      return {};
    }
    if (patch < 0) {
      fate.backs += static_cast<T>(weight);
      return {};
    }
    const Material& material = scene_.material_of(hit.triangle);
    weight /= 1 - material.transmittance;
    return Meeting{static_cast<std::size_t>(patch), material};
  }

  /// Books what a surface keeps of `weight`, and sets `weight` to what the surface sends on. False
  /// where none of this is followed. `reflections`: before this one.
  template <class T>
  bool goes_on(const Onward& on, int reflections, double& weight, Fate<T>& fate) const {
    fate.transmitted += static_cast<T>(weight * on.transmitted);
    fate.absorbed += static_cast<T>(weight * on.absorbed);
    weight *= on.weight;
    if (weight <= 0) return false;
    if (reflections < mirror_depth_) return true;
    fate.cut += static_cast<T>(weight);
    return false;
  }

  /// Unit normal of the side that was met.
  Vec3 normal(const Hit& hit) const { return met_normal(scene_.mesh, hit); }
  /// Start of the next ray, which leaves the side of that normal.
  Vec3 point(const Hit& hit, Vec3 normal) const {
    return lifted_point(scene_.mesh, hit, normal, caster_.offset_m());
  }
  Hit first_hit(Vec3 origin, Vec3 w) const { return caster_.first_hit(origin, w); }
  const Material& material_of_patch(std::size_t patch) const {
    return scene_.material_of(hierarchy_.patches()[patch].triangle);
  }
  int mirror_depth() const { return mirror_depth_; }

 private:
  const Scene& scene_;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  int mirror_depth_;
};

}  // namespace sunload
