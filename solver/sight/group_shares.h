// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The shares of a group's patches that are lit by suns which stand close together
/// (solver/sight/lit_shares.h).
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sight/lit_area.h"
#include "solver/sight/lit_shares.h"
#include "solver/sight/sun_view.h"

namespace sunload {

/// Numbers that have been seen before.
class NumbersSeen {
 public:
  void forget_all();
  /// False where it has been added before.
  bool add(std::uint32_t number);

 private:
  struct Slot {
    std::uint32_t number = 0, round = 0;
  };
  /// Of the number, or where it belongs.
  std::size_t place_of(std::uint32_t number) const;

  std::vector<Slot> slots_ = std::vector<Slot>(64);  ///< as many as a power of two
  std::uint32_t round_ = 1;
  std::size_t count_ = 0;
};

/// Works on one group at a time and keeps its room; each thread needs one of its own.
class GroupShares {
 public:
  /// Puts what it finds into `out`, LitShares::of.
  GroupShares(const LitShares& shares, std::span<const IntervalLight> block, SendsOn what_sends_on,
              Columns& out);
  void tell(const PlaneGroups::Group& group, const SunView& view);

 private:
  /// What may be shaded: the group's polygon, or a patch, as the sun sees it.
  struct Seen {
    ViewPolygon polygon;
    ViewBox box;
    SunView::Height lowest;
  };
  /// What may stand before it: the part of a face before the plane of the group.
  struct Shade {
    ViewPolygon polygon;
    ViewBox box;
    double wider_x = 0, wider_y = 0;  ///< what is nearer to it than that may be shaded or not [m]
    bool is_solid = true;
    std::uint32_t face = 0;
    double area = 0;  ///< of shades of one sun [m2]
  };
  /// How far the corners of a face are before the plane of the group [m].
  struct Before {
    std::array<double, SunFaces::most_corners_of_all> by;
    bool all;  ///< of them are
  };
  enum class Overlap { none, some, all };
  using Numbers = std::vector<std::uint32_t>;

  bool see(std::span<const Vec3> corners, const ViewFrame& frame, Seen& seen) const;
  bool see_patch(std::uint32_t patch, const ViewFrame& frame, Seen& seen) const;
  Overlap find_shades(const Seen& group);
  bool add_shades(const Seen& group, std::span<const std::uint32_t> highest_first);
  bool hides_all_suns(std::uint32_t face) const;
  bool measure(std::uint32_t face, Before& before) const;
  bool outline(std::uint32_t face, const Before& before, const ViewFrame& frame, Shade& shade);
  void outline_of_face(std::uint32_t face, const Before& before, const ViewFrame& frame,
                       Shade& shade) const;
  void outline_of_core(std::uint32_t core, const Before& before, const ViewFrame& frame,
                       Shade& shade);
  static Overlap overlap(const Seen& seen, const Shade& shade);
  static Overlap overlap_by_outline(const Seen& seen, const Shade& shade);
  static bool is_beside(const Seen& seen, const Shade& shade);
  void tell_patch(std::uint32_t patch);
  float share_of_one_point(const Seen& patch);
  float share_at(std::uint32_t patch, std::size_t k);
  const Shade& shade_at(std::uint32_t number, std::size_t k);
  float share(const Seen& patch);
  void tell(std::uint32_t patch, float share);

  const LitShares& shares_;
  std::span<const IntervalLight> block_;
  SendsOn what_sends_on_;
  Columns& out_;
  std::vector<ViewFrame> frames_;  ///< of each sun
  // The group and the suns at hand:
  const PlaneGroups::Group* group_ = nullptr;
  const SunView* view_ = nullptr;
  Vec3 lift_{};                      ///< from the group to where rays of it start
  std::vector<std::size_t> facing_;  ///< suns that the group faces
  bool faces_all_ = false;
  bool is_one_point_ = false;  ///< one sun, without a disk: what its view shows is what it sees
  NumbersSeen asked_;
  Numbers found_;              ///< cores, then faces that may shade the group, from any of the suns
  std::vector<Shade> shades_;  ///< these, seen from the middle of the suns; and more room
  std::vector<Before> before_;  ///< of the same
  std::vector<Shade> of_suns_;  ///< as each sun sees them, [found][suns]; and more room
  std::vector<std::uint8_t> is_made_;
  // The patch at hand:
  Numbers chosen_;  ///< which of the shades it may be in
  std::vector<const Shade*> kept_;
  std::vector<const ViewPolygon*> cover_;
  LitArea area_;
  std::vector<ViewCorner> points_, hull_;  ///< of a core
};

}  // namespace sunload
