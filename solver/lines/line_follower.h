// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One line along its chain of mirrors, panes, metals and glossy surfaces.
///
/// Shares that depend on the angle are known only where a line meets a surface. So what panes
/// transmit, and what panes, metals and glossy surfaces absorb, is booked here, at each meeting,
/// for the ledger. What surfaces of constant shares absorb follows from their irradiance.
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
  bool links_all = false;   ///< also to surfaces that send nothing
  double largest_link = 0;  ///< largest form factor of elements that links lead to
  double lamps = 0;         ///< exitance of emitters that was seen, summed over lines [W m-2]
  /// Forgets the lines.
  void clear();
};

/// Follows lines from their first hit on, by the law of reflection, until they
/// end; const and shared by all threads.
class LineFollower {
 public:
  LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
               const SkyGrid& grid, int mirror_depth);

  /// Follows a line that left its patch from `origin` along the unit vector `w` and met `first`;
  /// adds its links, its end, and the emitters that it sees. The first meeting counts
  /// `share_of_first`; points bring the rest of it (solver/lines/bright_view.h). `line` addresses
  /// the random numbers of glossy surfaces (its `block` is set here). Returns the rays cast.
  std::uint64_t follow(Vec3 origin, Vec3 w, const FirstMeeting& first, const RandomKey& line,
                       LineCollector& into, double share_of_first = 1) const {
    if (ends_at_first(w, first, into, share_of_first)) return 0;
    return follow_on(origin, w, first, line, into, share_of_first);
  }
  /// The same of a line that met `hit`.
  std::uint64_t follow(Vec3 origin, Vec3 w, const Hit& hit, const RandomKey& line,
                       LineCollector& into, double share_of_first = 1) const;
  /// Adds the link to a point of a bright surface, and the emitter that it is.
  void link(const BrightView::SeenPoint& point, LineCollector& into) const;

  /// Where light ends that arrives along -`w` at a patch which sends it on. `absorbed` counts only
  /// surfaces that `depends_on_angle` is true of. `met`, if not null, receives the patches that the
  /// light reaches on its way, and its weight there.
  Followed mirrored_on(Vec3 origin, Vec3 w, std::size_t patch, const RandomKey& line,
                       std::vector<LinkTable::Link>* met = nullptr) const;
  /// The same of a ray that carries `weight` along `w`, from its first hit on.
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
  /// Books a line that ends where it first comes, as most do; false if it is one of the others.
  bool ends_at_first(Vec3 w, const FirstMeeting& first, LineCollector& into, double share) const;
  std::uint64_t follow_on(Vec3 origin, Vec3 w, const FirstMeeting& first, const RandomKey& line,
                          LineCollector& into, double share_of_first) const;
  /// Links a line of that weight which mirrors sent out of the scene along `w`.
  void link_outside(Vec3 w, double weight, LineCollector& into) const;

  /// What is done with a line that meets a surface.
  enum class AtSurface : std::uint8_t { followed, linked, ended };
  static std::vector<AtSurface> at_surfaces(const Scene& scene);

  SurfaceWalk walk_;
  const Hierarchy& hierarchy_;
  const SkyGrid& grid_;
  std::vector<AtSurface> at_surface_;  ///< per triangle
};

inline bool LineFollower::ends_at_first(Vec3 w, const FirstMeeting& first, LineCollector& into,
                                        double share) const {
  if (first.hit.left_scene()) {
    into.ends.fate.escaped += 1;
    if (w.z > 0) {
      into.ends.sky += 1;
      into.sky.push_back({first.target, 1});
    } else {
      into.ends.ground += 1;
    }
    return true;
  }
  if (first.patch < 0) {
    into.ends.fate.backs += 1;
    return true;
  }
  const AtSurface what = at_surface_[static_cast<std::size_t>(first.hit.triangle)];
  if (what == AtSurface::linked || (what == AtSurface::ended && into.links_all))
    into.patches.push_back({first.target, static_cast<float>(share)});
  return what != AtSurface::followed;
}

}  // namespace sunload
