// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One line along its chain of mirrors, panes, metals and glossy surfaces.
///
/// What depends on the angle is known where a line meets it: the shares that panes transmit
/// and that panes, metals and glossy surfaces absorb are booked here, at each meeting, for the
/// ledger. What surfaces of constant shares absorb follows from their irradiance.
#pragma once

#include <vector>

#include "geo/sky/sky.h"
#include "solver/base/rng.h"
#include "solver/lines/bright_view.h"
#include "solver/lines/lines.h"
#include "solver/lines/surface_walk.h"

namespace sunload {

/// Links and ends of the lines of one patch or sensor.
struct LineCollector {
  std::vector<LinkTable::Link> patches, sky, sky_by_mirror;
  std::vector<Glimpse> glimpses;  ///< receiver and realization not yet known
  LineEnds ends;
  bool links_all = false;   ///< to surfaces, too, that send nothing
  double largest_link = 0;  ///< form factor that no element exceeds to which a link leads
  double lamps = 0;         ///< exitance of emitters that was seen, summed over lines [W m-2]
  /// Forgets the lines.
  void clear();
  /// Appends the glimpses as those of a receiver in one realization; none are left here.
  void move_glimpses(std::size_t receiver, std::size_t realization, std::vector<Glimpse>& to);
  /// Puts the lines of another realization to these.
  LineCollector& operator+=(const LineCollector& other);
  /// Writes the next row of its block in `set`: what `count` lines brought.
  void store(LineSet& set, std::size_t row, std::size_t count);
};

/// Follows lines from their first hit on, by the law of reflection, until they
/// end; const and shared by all threads.
class LineFollower {
 public:
  LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
               const SkyGrid& grid, int mirror_depth);

  /// A line that left its patch from `origin` along the unit vector `w` and met `first`; adds
  /// its links, its end, and the emitters that it sees. Of what it meets straight it counts
  /// `share_of_first`; the rest is seen by points (solver/lines/bright_view.h). `line` addresses
  /// the random numbers of glossy surfaces (its `block` is set here). Returns the rays cast.
  std::uint64_t follow(Vec3 origin, Vec3 w, const FirstMeeting& first, const RandomKey& line,
                       LineCollector& into, double share_of_first = 1) const;
  /// The same of a line that met `hit`.
  std::uint64_t follow(Vec3 origin, Vec3 w, const Hit& hit, const RandomKey& line,
                       LineCollector& into, double share_of_first = 1) const;
  /// Adds the link to a point of a bright surface, and the emitter that it is.
  void link(const BrightView::SeenPoint& point, LineCollector& into) const;

  /// Where light ends that arrives along -`w` at a patch that sends on, from that patch on;
  /// `absorbed` is what surfaces absorb that `depends_on_angle`. `met`, if not null, receives the
  /// patches that it arrives at on its way, and its weight there.
  Followed mirrored_on(Vec3 origin, Vec3 w, std::size_t patch, const RandomKey& line,
                       std::vector<LinkTable::Link>* met = nullptr) const;
  /// The same from the first hit of the ray on that carries `weight` along `w`.
  Followed sent_on(Vec3 w, double weight, const Hit& first, RandomKey key,
                   std::vector<LinkTable::Link>* met = nullptr) const;

  /// Cell of a direction that left the scene upward.
  std::uint32_t sky_cell(Vec3 w) const { return static_cast<std::uint32_t>(grid_.cell(w)); }
  const Material& material_of_patch(std::size_t patch) const {
    return walk_.material_of_patch(patch);
  }

 private:
  /// Of a line that arrived along -`w`.
  Glimpse glimpse(const Hit& hit, Vec3 n, Vec3 w, double weight) const;
  void link_outside(Vec3 w, double weight, int reflections, LineCollector& into) const;

  SurfaceWalk walk_;
  const Hierarchy& hierarchy_;
  const SkyGrid& grid_;
};

}  // namespace sunload
