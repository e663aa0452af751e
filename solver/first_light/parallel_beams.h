// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of finite parallel emitters: each triangle of them sends light along its normal.
///
///     E_i = Σ_sources M / A_i ∫ cosθ V dA,    V: the ray from x against the light passes
///                                             through the source and meets nothing before it
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/first_light/lamp_rays.h"

namespace sunload {

class ParallelBeams {
 public:
  explicit ParallelBeams(const ParallelSources& sources);
  void shine_on(std::size_t receiver, LampRays& rays) const;

 private:
  /// Sources of one direction.
  class Beam {
   public:
    Beam(const ParallelSources& sources, Vec3 along, const std::vector<std::int32_t>& triangles);
    Vec3 to_source() const { return to_source_; }
    double exitance(std::size_t source) const { return sources_[source].exitance; }
    /// Sources that a triangle of the scene may have before it.
    std::vector<std::size_t> before(Vec3 a, Vec3 b, Vec3 c) const;
    /// Way from x to a source along the beam, or 0 where x is not in its light.
    double way(std::size_t source, Vec3 x) const;

   private:
    /// A place of the plane across the beam.
    struct Flat {
      double x, y;
    };
    struct Source {
      std::array<Flat, 3> corner;  ///< counter-clockwise against the light
      double depth;                ///< along to_source
      double exitance;
    };
    Flat flat(Vec3 p) const { return {dot(p, axes_.tangent), dot(p, axes_.bitangent)}; }
    static double twice_area(Flat a, Flat b, Flat c);
    static bool is_left(Flat a, Flat b, Flat p);
    static bool may_overlap(const std::array<Flat, 3>& p, const std::array<Flat, 3>& q);

    Vec3 to_source_;
    Tangents axes_;
    std::vector<Source> sources_;
  };

  std::vector<Beam> beams_;
};

}  // namespace sunload
