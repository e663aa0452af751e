// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/group_shares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/sight/view_hull.h"

namespace sunload {

namespace {

/// Sine of the angle by which a patch must face the sun: less brings no light.
constexpr double least_facing = 1e-6;
/// What overlaps by less touches [m]: a thousand roundings of a coordinate of a kilometre.
constexpr double touching_m = 1e-9;

// Lines have normals as long as edges, and no root is taken where a bound will do.
double wider(const ViewLine& line, double by_x, double by_y) {
  return std::abs(line.x) * by_x + std::abs(line.y) * by_y;
}
double touching(const ViewLine& line) { return wider(line, touching_m, touching_m); }

/// How far the corners of a polygon lie beyond a line.
struct Beyond {
  double nearest, farthest;
};
Beyond beyond(const ViewLine& line, const ViewPolygon& polygon) {
  const double first = line.beyond(polygon[0]);
  Beyond all{first, first};
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const double by = line.beyond(polygon[i]);
    all = {std::min(all.nearest, by), std::max(all.farthest, by)};
  }
  return all;
}

}  // namespace

void NumbersSeen::forget_all() {
  count_ = 0;
  if (++round_ != 0) return;
  slots_.assign(slots_.size(), {});
  round_ = 1;
}

std::size_t NumbersSeen::place_of(std::uint32_t number) const {
  constexpr std::uint32_t golden = 2654435769u;  // Knuth (1973), The art of computer programming 3
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = number * golden & mask;
  while (slots_[at].round == round_ && slots_[at].number != number) at = (at + 1) & mask;
  return at;
}

bool NumbersSeen::add(std::uint32_t number) {
  if (2 * (count_ + 1) > slots_.size()) {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.round == round_) slots_[place_of(slot.number)] = slot;
  }
  Slot& slot = slots_[place_of(number)];
  if (slot.round == round_) return false;
  slot = {number, round_};
  ++count_;
  return true;
}

GroupShares::GroupShares(const LitShares& shares, std::span<const IntervalLight> block,
                         SendsOn what_sends_on, Columns& out)
    : shares_(shares), block_(block), what_sends_on_(what_sends_on), out_(out) {
  for (const auto& sun : block) frames_.emplace_back(sun.direction);
}

void GroupShares::tell(const PlaneGroups::Group& group, const SunView& view) {
  group_ = &group;
  view_ = &view;
  lift_ = group.normal * shares_.offset_m();
  facing_.clear();
  const SunCluster& suns = view.suns();
  for (std::size_t k = suns.first; k < suns.first + suns.count; ++k)
    if (dot(group.normal, block_[k].direction) > block_[k].disk_spread() + least_facing)
      facing_.push_back(k);
  Seen seen;
  if (facing_.empty()) return;
  see(shares_.groups().corners_of(group), suns.frame, seen);
  const double drift = suns.drift_x + suns.drift_y;
  faces_all_ = dot(group.normal, suns.frame.to_sun) > drift;
  is_one_point_ = suns.count == 1 && drift == 0;
  const Overlap shaded = find_shades(seen);
  for (const auto patch : shares_.groups().patches_of(group)) {
    if (shaded == Overlap::some)
      tell_patch(patch);
    else
      tell(patch, shaded == Overlap::none ? 1 : 0);
  }
}

/// False where it is seen from the side, without area.
bool GroupShares::see(std::span<const Vec3> corners, const ViewFrame& frame, Seen& seen) const {
  std::array<ViewPoint, ViewPolygon::most> p;
  seen.lowest = {1e300, 1e300};
  double turn = 0;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec3 v = corners[c] + lift_;
    p[c] = frame(v);
    seen.lowest = {std::min(seen.lowest.z, v.z), std::min(seen.lowest.along, p[c].h)};
    if (c > 1)
      turn += (p[c - 1].x - p[0].x) * (p[c].y - p[0].y) - (p[c - 1].y - p[0].y) * (p[c].x - p[0].x);
  }
  if (turn < 0)
    std::reverse(p.begin() + 1, p.begin() + static_cast<std::ptrdiff_t>(corners.size()));
  seen.polygon.clear();
  seen.box = {};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    seen.polygon.add({p[c].x, p[c].y});
    seen.box.include({p[c].x, p[c].y});
  }
  return turn != 0;
}

bool GroupShares::see_patch(std::uint32_t patch, const ViewFrame& frame, Seen& seen) const {
  const Hierarchy& mesh = shares_.hierarchy();
  return see(std::array{mesh.corner(patch, 0), mesh.corner(patch, 1), mesh.corner(patch, 2)}, frame,
             seen);
}

/// All that may shade some of the group, from any of the suns.
GroupShares::Overlap GroupShares::find_shades(const Seen& group) {
  const SunView& view = *view_;
  const SunCluster& suns = view.suns();
  const double rise = std::max(0.0, view.rise(group.lowest, view.highest()));
  const auto cells = view.cells(group.box, suns.drift_x * rise, suns.drift_y * rise);
  asked_.forget_all();
  found_.clear();
  for (std::size_t r = cells.row0; r <= cells.row1; ++r)
    for (std::size_t c = cells.column0; c <= cells.column1; ++c)
      if (add_shades(group, view.cores_in(c, r))) return Overlap::all;
  for (std::size_t r = cells.row0; r <= cells.row1; ++r)
    for (std::size_t c = cells.column0; c <= cells.column1; ++c)
      if (add_shades(group, view.faces_in(c, r))) return Overlap::all;
  if (found_.empty()) return Overlap::none;
  if (is_one_point_) return Overlap::some;
  is_made_.assign(found_.size() * suns.count, 0);
  if (of_suns_.size() < is_made_.size()) of_suns_.resize(is_made_.size());
  return Overlap::some;
}

/// Of one cell; true where one of them is found to shade all of the group from all suns.
bool GroupShares::add_shades(const Seen& group, std::span<const std::uint32_t> highest_first) {
  const SunView& view = *view_;
  const SunCluster& suns = view.suns();
  for (const auto face : highest_first) {
    const SunView::Bounds& bounds = view.bounds(face);
    if (bounds.highest.along <= group.lowest.along) break;  // and so are all that follow
    const double face_rise = view.rise(group.lowest, bounds.highest);
    if (face_rise <= 0) continue;
    const double wider_x = suns.drift_x * face_rise, wider_y = suns.drift_y * face_rise;
    if (bounds.box.is_apart_from(group.box, wider_x, wider_y) || !asked_.add(face)) continue;
    if (shades_.size() == found_.size()) shades_.emplace_back(), before_.emplace_back();
    Shade& shade = shades_[found_.size()];
    shade.wider_x = wider_x;
    shade.wider_y = wider_y;
    if (!measure(face, before_[found_.size()])) continue;
    if (!outline(face, before_[found_.size()], suns.frame, shade)) continue;
    const Overlap shaded = overlap(group, shade);
    if (shaded == Overlap::all && hides_all_suns(face)) return true;
    if (shaded == Overlap::none) continue;
    shade.face = face;
    if (is_one_point_) shade.area = shade.polygon.area();
    found_.push_back(face);
  }
  return false;
}

/// Of a face before all that is looked at: that each sun by itself would find it so.
bool GroupShares::hides_all_suns(std::uint32_t face) const {
  return faces_all_ && std::all_of(facing_.begin(), facing_.end(), [&](std::size_t k) {
           return shares_.faces().is_needed(face, frames_[k].to_sun, 2 * block_[k].disk_spread());
         });
}

/// How far the face's corners are before the plane of the group; false where none is.
bool GroupShares::measure(std::uint32_t face, Before& before) const {
  const SunFaces& faces = shares_.faces();
  const Vec3 normal = group_->normal;
  const double offset = group_->plane_offset + shares_.offset_m();
  const SunFaces::Sphere& sphere = faces.sphere(face);
  if (dot(normal, sphere.centre) + sphere.radius <= offset) return false;
  const auto corners = faces.corners(face);
  bool any = false;
  before.all = true;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    before.by[k] = dot(normal, corners[k]) - offset;
    any = any || before.by[k] > 0;
    before.all = before.all && before.by[k] > 0;
  }
  return any;
}

/// False where what of the face or core is before the plane of the group has no area.
bool GroupShares::outline(std::uint32_t face, const Before& before, const ViewFrame& frame,
                          Shade& shade) {
  const SunFaces& faces = shares_.faces();
  shade.is_solid = !faces.is_screen(face);
  shade.polygon.clear();
  shade.box = {};
  faces.is_core(face) ? outline_of_core(face, before, frame, shade)
                      : outline_of_face(face, before, frame, shade);
  return shade.polygon.has_area();
}

void GroupShares::outline_of_face(std::uint32_t face, const Before& before, const ViewFrame& frame,
                                  Shade& shade) const {
  const SunFaces& faces = shares_.faces();
  const auto corners = faces.corners(face);
  const std::size_t n = corners.size();
  const auto add = [&](const Vec3& p) {
    const ViewCorner corner{dot(p, frame.x), dot(p, frame.y)};
    shade.polygon.add(corner);
    shade.box.include(corner);
  };
  const bool from_behind = dot(faces.normal(face), frame.to_sun) < 0;
  const auto in_turn = [&](std::size_t k) { return from_behind ? n - 1 - k : k; };
  if (before.all) {
    for (std::size_t k = 0; k < n; ++k) add(corners[in_turn(k)]);
    return;
  }
  std::size_t p = in_turn(n - 1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t q = in_turn(k);
    const double before_p = before.by[p], before_q = before.by[q];
    if ((before_p > 0) != (before_q > 0))
      add(corners[p] + (corners[q] - corners[p]) * (before_p / (before_p - before_q)));
    if (before_q > 0) add(corners[q]);
    p = q;
  }
}

/// Of corners before the plane, and of where edges come through it.
void GroupShares::outline_of_core(std::uint32_t core, const Before& before, const ViewFrame& frame,
                                  Shade& shade) {
  const auto corners = shares_.faces().corners(core);
  points_.clear();
  const auto add = [&](const Vec3& p) { points_.push_back({dot(p, frame.x), dot(p, frame.y)}); };
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (before.by[k] > 0) add(corners[k]);
  if (!before.all)
    for (const auto [p, q] : shares_.faces().edges_of_core(core))
      if (const double before_p = before.by[p], before_q = before.by[q];
          (before_p > 0) != (before_q > 0))
        add(corners[p] + (corners[q] - corners[p]) * (before_p / (before_p - before_q)));
  const auto hull = convex_hull(points_, hull_);
  if (hull.size() > ViewPolygon::most) return;  // faces tell
  for (const ViewCorner& corner : hull) {
    shade.polygon.add(corner);
    shade.box.include(corner);
  }
}

GroupShares::Overlap GroupShares::overlap(const Seen& seen, const Shade& shade) {
  const Overlap shaded = overlap_by_outline(seen, shade);
  return shaded == Overlap::some && is_beside(seen, shade) ? Overlap::none : shaded;
}

/// By the edges of the shade: some may be none.
GroupShares::Overlap GroupShares::overlap_by_outline(const Seen& seen, const Shade& shade) {
  if (shade.box.is_apart_from(seen.box, shade.wider_x - touching_m, shade.wider_y - touching_m))
    return Overlap::none;
  const ViewPolygon& outline = shade.polygon;
  bool all = shade.is_solid;
  std::size_t p = outline.size() - 1;
  for (std::size_t q = 0; q < outline.size(); p = q++) {
    const ViewLine line = line_through(outline[p], outline[q]);
    const auto [nearest, farthest] = beyond(line, seen.polygon);
    const double by = wider(line, shade.wider_x, shade.wider_y);
    if (nearest > by - touching(line)) return Overlap::none;
    all = all && farthest <= -by;
  }
  return all ? Overlap::all : Overlap::some;
}

/// All of the shade lies beyond an edge of what may be shaded.
bool GroupShares::is_beside(const Seen& seen, const Shade& shade) {
  const ViewPolygon& before = seen.polygon;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const ViewLine line = line_through(before[k], before[k + 1 < before.size() ? k + 1 : 0]);
    const double nearest = beyond(line, shade.polygon).nearest;
    if (nearest > wider(line, shade.wider_x, shade.wider_y) - touching(line)) return true;
  }
  return false;
}

void GroupShares::tell_patch(std::uint32_t patch) {
  Seen seen;
  const SunCluster& suns = view_->suns();
  const bool has_area = see_patch(patch, suns.frame, seen);
  chosen_.clear();
  for (std::uint32_t number = 0; number < found_.size(); ++number) {
    // A patch that is the group has been asked already.
    const Overlap shaded = group_->count > 1 ? overlap(seen, shades_[number]) : Overlap::some;
    if (shaded == Overlap::all && hides_all_suns(found_[number])) return tell(patch, 0);
    if (shaded != Overlap::none) chosen_.push_back(number);
  }
  if (chosen_.empty()) return tell(patch, 1);
  if (is_one_point_) return tell(patch, has_area ? share_of_one_point(seen) : LitShares::by_rays);
  for (const auto k : facing_) out_[patch * block_width + k] = share_at(patch, k);
}

/// Each of the chosen shades shades some of it, none shades all.
float GroupShares::share_of_one_point(const Seen& patch) {
  kept_.clear();
  for (const auto number : chosen_)
    if (!shares_.faces().is_core(shades_[number].face)) kept_.push_back(&shades_[number]);
  return share(patch);
}

float GroupShares::share_at(std::uint32_t patch, std::size_t k) {
  Seen seen;
  if (!see_patch(patch, frames_[k], seen)) return LitShares::by_rays;
  kept_.clear();
  for (const auto number : chosen_) {
    const Shade& shade = shade_at(number, k);
    if (!shade.polygon.has_area()) continue;
    const Overlap shaded = overlap(seen, shade);
    if (shaded == Overlap::all) return 0;
    if (shaded == Overlap::some && !shares_.faces().is_core(shade.face)) kept_.push_back(&shade);
  }
  return share(seen);
}

const GroupShares::Shade& GroupShares::shade_at(std::uint32_t number, std::size_t k) {
  const SunCluster& suns = view_->suns();
  const std::size_t at = number * suns.count + (k - suns.first);
  Shade& shade = of_suns_[at];
  if (is_made_[at] != 0) return shade;
  is_made_[at] = 1;
  const double disk = block_[k].disk_spread();
  // Suns with a disk are looked at one by one (solver/sight/sun_clusters.h).
  shade.wider_x = disk > 0 ? shades_[number].wider_x : 0;
  shade.wider_y = disk > 0 ? shades_[number].wider_y : 0;
  if (!shares_.faces().is_needed(found_[number], frames_[k].to_sun, 2 * disk) ||
      !outline(found_[number], before_[number], frames_[k], shade))
    shade.polygon.clear();
  shade.face = found_[number];
  shade.area = shade.polygon.area();
  return shade;
}

/// That the kept shades leave of a patch.
float GroupShares::share(const Seen& patch) {
  if (kept_.empty()) return 1;
  const bool is_for_rays =
      (group_->sends_on && what_sends_on_ == SendsOn::by_rays) ||
      block_[facing_.front()].disk_half_angle > 0 ||
      std::any_of(kept_.begin(), kept_.end(), [](const Shade* shade) { return !shade->is_solid; });
  if (is_for_rays) return LitShares::by_rays;
  std::sort(kept_.begin(), kept_.end(), LargestFirst());
  cover_.clear();
  for (const Shade* shade : kept_) cover_.push_back(&shade->polygon);
  const auto lit = area_.share(patch.polygon, cover_);
  return lit ? static_cast<float>(*lit) : LitShares::by_rays;
}

/// Of all suns that the group faces.
void GroupShares::tell(std::uint32_t patch, float share) {
  for (const auto k : facing_) out_[patch * block_width + k] = share;
}

}  // namespace sunload
