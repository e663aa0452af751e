// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// First hits and shadows on the triangles of a mesh: the only file that knows
/// Embree, and the only one that traces in single precision.
///
/// Coordinates are converted to float here. A float carries 24 bits: at a
/// distance of D metres from the local origin a point is known to D·2^-24, and
/// a ray must start `offset_m()` above its surface to be sure not to meet it.
///
/// A surface of transmittance T stops a ray with probability 1 - T. What decides is a hash of
/// the ray's own coordinates and the triangle's key: the same ray meets the same
/// triangles in packets, alone, and on any thread; different rays and triangles decide
/// independently, so that T^k of the rays pass k layers. Where only that is asked which reaches the
/// origin of a ray, `passed_each` gives T^k itself, without chance.
/// Reference: Wald et al. (2014), Embree: a kernel framework for efficient CPU
/// ray tracing.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "solver/surface/material.h"

namespace sunload {

/// First hit of a ray. `u`, `v` are the barycentric weights of corners 1 and 2.
struct Hit {
  std::int32_t triangle = -1;  ///< -1: the ray left the scene
  double u = 0, v = 0;
  double distance_m = 0;
  bool front = true;  ///< the front side was met
  bool left_scene() const { return triangle < 0; }
};
/// Unit normal of the side that was met.
inline Vec3 met_normal(const Mesh& mesh, const Hit& hit) {
  return mesh.normal(static_cast<std::size_t>(hit.triangle), hit.front);
}
/// Where a ray has met a surface, lifted off it by `offset_m` along `normal`: rays go on from
/// there.
inline Vec3 lifted_point(const Mesh& mesh, const Hit& hit, Vec3 normal, double offset_m) {
  return mesh.point(static_cast<std::size_t>(hit.triangle), hit.u, hit.v) + normal * offset_m;
}

inline constexpr std::size_t packet_size = 16;
inline constexpr std::uint32_t all_rays = (1u << packet_size) - 1u;  ///< of a packet

/// Up to 16 ray origins, already offset from their surfaces.
struct Packet {
  alignas(64) float x[packet_size];
  alignas(64) float y[packet_size];
  alignas(64) float z[packet_size];
};
inline void put(Packet& packet, std::size_t ray, Vec3 v) {
  packet.x[ray] = static_cast<float>(v.x);
  packet.y[ray] = static_cast<float>(v.y);
  packet.z[ray] = static_cast<float>(v.z);
}
inline Vec3 at(const Packet& packet, std::size_t ray) {
  return {static_cast<double>(packet.x[ray]), static_cast<double>(packet.y[ray]),
          static_cast<double>(packet.z[ray])};
}
/// Up to 16 ray directions (need not be of unit length).
using PacketDirections = Packet;
/// Parallel rays.
PacketDirections same_for_all(Vec3 direction);

/// First hits of a packet, side by side; those of rays that were not active mean nothing.
struct PacketHits {
  std::int32_t triangle[packet_size];  ///< -1: left the scene
  float u[packet_size], v[packet_size];
  float distance[packet_size];  ///< in lengths of the direction
  bool front[packet_size];

  Hit operator[](std::size_t r) const {
    return {triangle[r], static_cast<double>(u[r]), static_cast<double>(v[r]),
            static_cast<double>(distance[r]), front[r]};
  }
};

/// The instruction set that `wanted` (auto | sse4.2 | avx2 | avx512) means on
/// this processor. Throws InputError where the processor lacks it.
std::string usable_isa(const std::string& wanted);

/// Distance along the normal that ray origins in a scene keep from their surfaces [m]: above the
/// rounding to single precision of its largest coordinate. What is closer to a surface than that,
/// or to the foot of a wall, is not seen right.
double ray_offset_m(const Mesh& mesh);
/// The same where a ray ends that comes from a point, which may lie far beyond the scene (a sensor)
/// and is rounded as well.
double ray_offset_m(Vec3 from);

/// The triangles of one mesh in a tree of boxes. May be asked from any thread.
class RayCaster {
 public:
  using Shares = std::array<float, packet_size>;

  /// isa: auto | sse4.2 | avx2 | avx512. Throws InputError where the processor
  /// lacks it, MachineError where memory is short. Builds once, then const.
  /// Without `screens` every triangle stops every ray.
  explicit RayCaster(const Mesh& mesh, const std::string& isa = "auto", Screens screens = {});
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// The instruction set in use, as `solver.isa` would name it.
  const std::string& isa() const { return isa_; }
  /// `ray_offset_m` of its mesh.
  double offset_m() const { return offset_m_; }

  /// First hit of one ray.
  Hit first_hit(Vec3 origin, Vec3 direction) const;
  /// First hits of the rays in `active` (bit r: ray r); those that are parallel, or
  /// nearly so, go faster together.
  enum class Coherence { none, parallel };
  PacketHits first_hits(const Packet& origins, const PacketDirections& directions,
                        std::uint32_t active, Coherence coherence = Coherence::none) const;
  PacketHits first_hits(const Packet& origins, Vec3 direction, std::uint32_t active) const {
    return first_hits(origins, same_for_all(direction), active, Coherence::parallel);
  }
  /// Which of the `active` origins see parallel light from `direction`?
  std::uint32_t unoccluded(const Packet& origins, Vec3 direction, std::uint32_t active) const;
  /// The same with a direction for each of them.
  std::uint32_t unoccluded_each(const Packet& origins, const PacketDirections& directions,
                                std::uint32_t active) const;
  /// Which of them have nothing on the way from origin to origin + direction?
  std::uint32_t unoccluded_up_to(const Packet& origins, const PacketDirections& ways,
                                 std::uint32_t active) const;

  /// Share of light from along each direction that reaches its origin, for the `active` ones: the
  /// product of the transmittances of all that is on the way, 0 where something stops all of it.
  /// What `unoccluded_each` is on the mean of many rays; chance has a hand in less than 1/2000.
  Shares passed_each(const Packet& origins, const PacketDirections& directions,
                     std::uint32_t active) const;
  /// The same of what is between origin and origin + direction.
  Shares passed_up_to(const Packet& origins, const PacketDirections& ways,
                      std::uint32_t active) const;

  /// What a ray of light from along `direction` meets on its way to `origin`, nearest the origin
  /// first, and the share of that light which each takes of what others nearer would let through:
  /// without chance, what `first_hit` is on the mean of many rays.
  struct Taker {
    Hit hit;
    double share;
    std::size_t ray = 0;  ///< of a packet
  };
  std::vector<Taker> takers(Vec3 origin, Vec3 direction) const;
  /// The same for the `active` rays of a packet, one ray after the other.
  std::vector<Taker> takers_each(const Packet& origins, const PacketDirections& directions,
                                 std::uint32_t active) const;

 private:
  Shares passed(const Packet& origins, const PacketDirections& directions, float end,
                std::uint32_t active, Coherence coherence) const;
  std::uint32_t unoccluded(const Packet& origins, const PacketDirections& directions, float end,
                           std::uint32_t active, Coherence coherence) const;

  struct Embree;
  std::unique_ptr<Embree> embree_;
  std::string isa_;
  double offset_m_ = 0;
};

/// The rays of which some light arrives (bit r: ray r).
inline std::uint32_t any_passed(const RayCaster::Shares& shares) {
  std::uint32_t rays = 0;
  for (std::size_t r = 0; r < packet_size; ++r)
    if (shares[r] > 0) rays |= 1u << r;
  return rays;
}

}  // namespace sunload
