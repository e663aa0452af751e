// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The ways of one sun by mirrors: sequences of mirror orientations and their
/// image directions.
///
/// Mirrors of normal n send light from direction s on so that receivers see it
/// in the image direction w = s - 2 (s·n) n. Light that was sent on by mirrors of
/// orientation g1, then g2, … gm is seen in the direction that reflecting s in
/// g1, then g2, … gives. A receiver whose ray along w_m first meets a mirror of
/// gm, its mirrored ray one of g(m-1), … and the last one no more, gets
/// dni · Π rho_s · cosθ. The sequence belongs to the way: none is counted twice.
///
/// The sequences make a tree; one is followed only if what its mirrors send on can
/// meet a mirror of the next orientation (what stands between is not asked), as
/// long as its reflectances multiply to more than a faint share, and level by
/// level (one reflection, two, …) as long as there are not too many.
/// Heckbert & Hanrahan (1984), Beam tracing polygonal objects.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/first_light/beam_raster.h"
#include "solver/light/sun_block.h"
#include "solver/surface/mirror_groups.h"

namespace sunload {

/// Where the tree of sequences ends.
struct BeamRules {
  int mirror_depth = 8;    ///< reflections, at most
  double faint_glint = 0;  ///< share of the sun below which further reflections are no beams
  int most_beams = 0;      ///< of one sun; a level that would exceed it is left out
  double margin_m = 0;     ///< by which points of mirrors are known
};

/// One sun by way of mirrors of a sequence of orientations.
struct SunBeam {
  std::size_t group;    ///< of the last mirror: the one that receivers see
  std::int32_t before;  ///< beam that the last mirror reflects; -1: the sun
  int reflections;
  Rotation image_of;                   ///< from directions on the sun to where receivers see them
  Vec3 image;                          ///< of the sun's centre
  double strongest;                    ///< largest product of reflectances
  std::vector<ConvexPolygon> section;  ///< parts of mirrors
  /// Of the first reflection: mirrors that may see the sun.
  std::vector<std::int32_t> triangles;
  std::vector<std::pair<std::size_t, std::int32_t>> next;  ///< group, beam
};

/// The beams of one sun, level by level: those that are reflected once come first. `groups` must
/// outlive it.
class SunBeams {
 public:
  /// None.
  explicit SunBeams(const MirrorGroups& groups) : groups_(&groups) {}
  /// `dark`: 1 for each triangle of which nothing sees the sun; empty: this is known of none.
  SunBeams(const MirrorGroups& groups, const IntervalLight& sun, const BeamRules& rules,
           std::span<const std::uint8_t> dark = {});
  /// Follows on to reflections of `faint_glint` of the sun where no more than `most_beams` are.
  void follow_on(double faint_glint, int most_beams);
  std::size_t size() const { return beams_.size(); }
  const SunBeam& operator[](std::size_t beam) const { return beams_[beam]; }
  double spread() const { return spread_; }
  /// Whether no way is left out that carries more than `negligible` of the sun.
  bool are_all(double negligible) const {
    return !has_too_many_ && (!has_fainter_ || rules_.faint_glint <= negligible);
  }
  /// Beam that mirrors of `group` make of a beam (-1: of the sun); -1: none.
  std::int32_t next(std::int32_t beam, std::size_t group) const;

 private:
  std::vector<SunBeam> first_level(const IntervalLight& sun, std::span<const std::uint8_t> dark);
  std::vector<SunBeam> next_level(std::size_t begin);
  void follow(std::vector<SunBeam> first_level);
  void append(std::vector<SunBeam> level);

  const MirrorGroups* groups_;
  BeamRules rules_;
  double spread_ = 0;  ///< tangent of the half angle of the sun's disk
  bool has_fainter_ = false, has_too_many_ = false;  ///< reflections, which are left out
  std::vector<SunBeam> beams_;
  std::vector<std::pair<std::size_t, std::int32_t>> first_;
};

/// Image direction of w in mirrors of normal n.
constexpr Vec3 image(Vec3 w, Vec3 n) { return w - 2 * dot(w, n) * n; }

}  // namespace sunload
