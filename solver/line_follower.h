/// One line along its chain of mirrors.
#pragma once

#include <vector>

#include "geo/sky.h"
#include "solver/lines.h"

namespace sunload {

/// Links and ends of the lines of one patch or sensor.
struct LineCollector {
  std::vector<LinkTable::Link> patches, sky, sky_by_mirror;
  LineEnds ends;
  void clear();
  /// Puts the lines of another realization to these.
  LineCollector& operator+=(const LineCollector& other);
  /// Writes the next row of its block in `set`: what `count` lines brought.
  void store(LineSet& set, std::size_t row, int count);
};

/// Follows lines from their first hit on, by the law of reflection, until they
/// end; const and shared by all threads.
class LineFollower {
 public:
  LineFollower(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
               const SkyGrid& grid, int mirror_depth, double largest_link = 0);

  /// A line that left its patch from `origin` along the unit vector `w` and met
  /// `hit`; adds its links and its end. Returns the rays cast.
  std::uint64_t follow(Vec3 origin, Vec3 w, const Hit& hit, LineCollector& into) const;

  /// Where light ends that arrives along -`w` at a mirror patch and is sent on.
  struct Fate {
    double escaped = 0, backs = 0, cut = 0;
    std::uint64_t rays = 0;
  };
  Fate mirrored_on(Vec3 origin, Vec3 w, std::size_t mirror_patch) const;
  /// The same from the first hit of the mirrored ray on: `weight` goes along `w`.
  Fate sent_on(Vec3 w, double weight, const Hit& first) const;

  /// Cell of a direction that left the scene upward.
  std::uint32_t sky_cell(Vec3 w) const { return static_cast<std::uint32_t>(grid_.cell(w)); }
  double mirror_of(std::size_t patch) const;

 private:
  struct Meeting;
  const Material& material_of(std::int32_t triangle) const;
  std::uint32_t linked_element(std::size_t patch, Vec3 point, double path_m) const;
  Vec3 offset_point(std::int32_t triangle, const Hit& hit, Vec3 side_normal) const;

  const Scene& scene_;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const SkyGrid& grid_;
  int mirror_depth_;
  double largest_link_;
};

}  // namespace sunload
