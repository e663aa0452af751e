// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Zeroth light iteration, the sun's part: by the share of each receiver that sees the sun,
///
///     E_0[i][k] = dni[k] * cosθ * lit area / area
///
/// where geometry tells it (solver/sight/lit_shares.h), the same in all realizations; else by
/// stratified shadow rays,
///
///     E_0[i][k] = dni[k] * cosθ * (visible samples / samples)
///
/// of which every realization has its own randomised points, addressed by patch and sun.
///
/// A sun with a disk (`IntervalLight::disk_half_angle`) is seen by each sample at a point of its
/// own, uniform on the disk (no limb darkening): shadows have penumbrae. cosθ stays that of the
/// centre, which also decides whether the sun is up and in front of a patch.
///
/// Of a sun behind clouds (dni = 0) only the share of a receiver that would see it is wanted, for
/// sun hours: a sum without realizations. Where an edge of shade passes, n points of a scrambled
/// net have a variance of the order n^-3/2 (He & Wang 2015, On the convergence rate of randomized
/// quasi-Monte Carlo for discontinuous functions), and R realizations of n points each that of
/// n^-3/2 / R. So one net of n R^(2/3) points errs as they do: half as many for R = 8.
///
/// A ray brings the share of light that passes the crowns and screens that it crosses: behind one
/// that covers all of a receiver there is no noise. Surfaces send on that share of what a ray
/// brings (`lit_samples`).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/base/units.h"
#include "solver/base/rng.h"
#include "solver/first_light/ray_light.h"
#include "solver/light/sun_block.h"
#include "solver/mesh/hierarchy.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// How many rays ask for the sun, and by which random numbers. Samples of a receiver and sun are
/// shared equally by the realizations.
struct DirectRules {
  int samples = 16;  ///< per patch and sun, over all realizations together
  int realizations = 8;
  std::uint64_t seed = 1;
};

/// Two coordinates of the samples of a packet as binary fractions x / 2^32.
struct ScrambledPoints {
  alignas(64) std::uint32_t u[packet_size];
  alignas(64) std::uint32_t v[packet_size];
};

/// Sample points of receivers (patches, or sensors, whose samples lie within the
/// caster's offset about their point) for the sun, addressable one by one.
class SunSampler {
 public:
  SunSampler(const Hierarchy& hierarchy, const RayCaster& caster, const DirectRules& rules);
  /// `sensors` must outlive it.
  SunSampler(const std::vector<Sensor>& sensors, const RayCaster& caster, const DirectRules& rules);

  /// The same receivers with so many times the samples.
  SunSampler with_samples(std::size_t factor) const;

  std::size_t receivers() const;
  bool are_points() const { return sensors_ != nullptr; }
  /// Corners of a patch; three times the point of a sensor.
  std::array<Vec3, 3> corners(std::size_t receiver) const;
  Vec3 normal(std::size_t receiver) const;

  double offset_m() const { return offset_m_; }  ///< of the ray caster
  std::size_t samples() const { return realization_.size(); }
  std::uint64_t study_seed() const { return rules_.seed; }
  std::size_t packets() const { return (samples() + packet_size - 1) / packet_size; }
  std::size_t realization(std::size_t sample) const { return realization_[sample]; }

  /// What the samples of one receiver have in common.
  struct Geometry {
    float a[3], ab[3], ac[3];  ///< corner (lifted off the surface) and edges
    Vec3 normal;
  };
  Geometry geometry(std::size_t receiver) const;

  /// Scrambling seeds of one (receiver, sun) for all realizations.
  struct Seeds {
    std::vector<std::uint32_t> u, v;
    std::vector<std::uint32_t> disk_u, disk_v;  ///< of points on the sun's disk, or in the sky
  };
  void seed(std::size_t receiver, std::uint32_t sun, Seeds& seeds,
            Purpose purpose = Purpose::direct_sun) const;
  /// Origins of samples [16·packet, …) of that receiver.
  Packet origins(const Geometry& geometry, const Seeds& seeds, std::size_t packet) const;
  /// Points of the same samples, to choose their directions by.
  ScrambledPoints points(const Seeds& seeds, std::size_t packet) const;
  /// Directions of the same samples to points on the sun's disk, or to the sun that is a point.
  PacketDirections directions(const IntervalLight& sun, const Seeds& seeds,
                              std::size_t packet) const;
  /// The same by the coordinates that choose origins: for sensors, whose origins are all but one
  /// point, where `points` are needed for something else.
  PacketDirections directions_by_origins(const IntervalLight& sun, const Seeds& seeds,
                                         std::size_t packet) const;
  /// Bits of the samples that packet really holds.
  std::uint32_t active(std::size_t packet) const;

  /// Points of the one net for suns behind clouds.
  std::size_t net_points() const { return net_.size(); }
  /// Rays from points of a receiver to the sun, each to a point of its disk if it has one.
  struct NetRays {
    Packet origins;
    PacketDirections to_sun;
  };
  /// Rays of a receiver's net from point `first` on, 16 or what is left of them.
  NetRays net_rays(std::size_t receiver, const Geometry& geometry, const IntervalLight& sun,
                   std::size_t first) const;

 private:
  ScrambledPoints origin_points(const Seeds& seeds, std::size_t packet) const;
  std::uint64_t key(std::size_t receiver) const;
  SunSampler(const Hierarchy* hierarchy, const std::vector<Sensor>* sensors, double offset_m,
             const DirectRules& rules);

  const Hierarchy* hierarchy_;  // one of the two
  const std::vector<Sensor>* sensors_;
  double offset_m_;
  DirectRules rules_;
  std::vector<std::uint32_t> realization_, point_u_, point_v_, disk_u_, disk_v_;
  std::vector<std::array<std::uint32_t, 4>> net_;
};

/// Samples of one packet of a receiver, and which of them see the sun.
struct LitSamples {
  Packet origins;
  PacketDirections to_sun;  ///< each to its own point on the disk
  std::uint32_t active,
      lit;                  ///< bits: that the packet really holds, and of these what sees the sun
  RayCaster::Shares share;  ///< of the sun's light that reaches each
};
/// The only place that asks rays for the direct sun of a receiver, so that what surfaces receive
/// and what they send on can rest on the same rays. `seeds`: of this receiver and sun.
LitSamples lit_samples(const SunSampler& sampler, const RayCaster& caster, const IntervalLight& sun,
                       const SunSampler::Geometry& geometry, const SunSampler::Seeds& seeds,
                       std::size_t packet);
/// Which of these see the sun.
LitSamples lit_samples(const RayCaster& caster, const Packet& origins,
                       const PacketDirections& to_sun, std::uint32_t active);

/// Unit direction to the point on the sun's disk that lies along `to_sun`, of any length, as a
/// surface of that normal sees it: to the centre where the disk has half set behind the surface,
/// or is a point.
inline Vec3 sun_before(Vec3 normal, const IntervalLight& sun, Vec3 to_sun) {
  if (sun.disk_half_angle <= 0) return sun.direction;
  const Vec3 w = normalized(to_sun);
  return dot(w, normal) > 0 ? w : sun.direction;
}

/// Points of the sun's disk, uniform on it.
class SunPoints {
 public:
  explicit SunPoints(const IntervalLight& sun)
      : centre_(sun.direction), axes_(tangents(sun.direction)), radius_(sun.disk_spread()) {}
  /// Direction to that of (u, v) in the unit square, of length 1 along the centre.
  Vec3 at(double u, double v) const {
    const double radius = radius_ * std::sqrt(u), angle = 2 * pi * v;
    return centre_ + axes_.tangent * (radius * std::cos(angle)) +
           axes_.bitangent * (radius * std::sin(angle));
  }

 private:
  Vec3 centre_;
  Tangents axes_;
  double radius_;  ///< at distance 1
};

/// Adds the direct sun of a block to `into`, and to `sunlit` ([N][block]) the share of each
/// receiver that sees the sun, times `sun_share`, for every sun above the horizon; both to the suns
/// that these are parts of (RaySink::of_parts_of). `shares`: what
/// is known of the same receivers (LitShares::of); empty: rays tell all. Returns the rays cast.
std::uint64_t direct_sun(const RayCaster& caster, const SunSampler& sampler,
                         std::span<const IntervalLight> block, const RaySink& into, Columns& sunlit,
                         const Columns& shares = {});

}  // namespace sunload
