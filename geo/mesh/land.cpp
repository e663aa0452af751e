// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/land.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/constrained_delaunay.h"
#include "geo/mesh/land_points.h"
#include "geo/mesh/land_slope.h"
#include "geo/mesh/plan_lines.h"
#include "geo/mesh/weld.h"

namespace sunload {

namespace {

constexpr int border_points = 32;  // on each side of the rectangle, where the land is not level
constexpr double most_border_points = 1000;
// Lines of n pieces may cross n² times; houses that overlap cross a few times each.
constexpr std::size_t crossings_per_line = 8, fewest_crossings = 100;

struct PointInfo {
  std::int32_t point = -1;
};
using LandDelaunay = ConstrainedDelaunay<PointInfo>;

Box box_near(const Segment& line) { return widened(box_around({line[0], line[1]}), land_snap_m); }

class LandMaker {
 public:
  explicit LandMaker(const LandLines& lines)
      : lines_(lines), rims_(lines.rims), feet_(lines.feet), slopes_(lines) {}

  Land run() {
    find_points();
    insert_lines();
    add_border();
    fill_open_land();
    return collect();
  }

 private:
  /// Rims first; else the highest of the feet here; nothing away from all lines.
  double height(double x, double y) const {
    for (const PlanLines* lines : {&rims_, &feet_}) {
      double highest = -infinity;
      lines->visit_within(x, y, land_snap_m, [&](const NearestOnLine& found) {
        highest = std::max(highest, found.z);
      });
      if (highest > -infinity) return highest;
    }
    return -infinity;
  }

  void find_points() {
    std::vector<Vec3> ends;
    for (const auto* lines : {&lines_.rims, &lines_.feet})
      for (const auto& [a, b] : *lines) {
        ends.push_back({a.x, a.y, 0});
        ends.push_back({b.x, b.y, 0});
      }
    const std::vector<std::uint8_t> all(ends.size(), 1);
    points_ = weld(ends, all, land_snap_m).vertices;
    for (Vec3& p : points_) p.z = height(p.x, p.y);
  }

  void insert_lines() {
    LandDelaunay::Face_handle near{};
    for (std::size_t p = 0; p < points_.size(); ++p) {
      handles_.push_back(delaunay_.insert({points_[p].x, points_[p].y}, near));
      handles_[p]->info().point = static_cast<std::int32_t>(p);
      near = handles_[p]->face();
    }
    std::vector<Box> boxes;
    for (const Vec3 p : points_) boxes.push_back({p, p});
    const BoxTree tree(std::move(boxes));
    const std::size_t most = delaunay_.number_of_vertices() + fewest_crossings +
                             crossings_per_line * (lines_.rims.size() + lines_.feet.size());
    for (const auto* lines : {&lines_.rims, &lines_.feet})
      for (const Segment& line : *lines) {
        insert_line(line, tree);
        if (delaunay_.number_of_vertices() > most)
          throw InputError({}, "feet of bodies cross each other more often than land can follow",
                           "the ground would go through all of them",
                           "write scene.ground: {surface: level}");
      }
    for (const auto handle : delaunay_.finite_vertex_handles()) {
      if (handle->info().point >= 0) continue;
      handle->info().point = static_cast<std::int32_t>(points_.size());
      const auto& q = handle->point();
      points_.push_back({q.x(), q.y(), height(q.x(), q.y())});
    }
    // A crossing that rounding took away from its lines: as high as what is around it.
    for (const auto handle : delaunay_.finite_vertex_handles()) {
      Vec3& p = points_[static_cast<std::size_t>(handle->info().point)];
      if (p.z > -infinity) continue;
      auto around = delaunay_.incident_vertices(handle);
      const auto first = around;
      do {
        if (!delaunay_.is_infinite(around))
          p.z = std::max(p.z, points_[static_cast<std::size_t>(around->info().point)].z);
      } while (++around != first);
    }
  }

  /// Through all points that are on it.
  void insert_line(const Segment& line, const BoxTree& tree) {
    std::vector<std::pair<double, std::size_t>> on;
    tree.visit_meeting(upright(box_near(line)), [&](std::size_t p) {
      const NearestOnLine found = nearest_in_plan(line, points_[p].x, points_[p].y);
      if (found.distance <= land_snap_m) on.emplace_back(found.along, p);
    });
    std::sort(on.begin(), on.end());
    for (std::size_t i = 1; i < on.size(); ++i) {
      const auto a = handles_[on[i - 1].second], b = handles_[on[i].second];
      if (a != b) delaunay_.insert_constraint(a, b);
    }
  }

  /// Land outside of the hull: on the border, and where it ceases to slope.
  void add_border() {
    std::vector<Segment> hull;
    double low = infinity, high = -infinity;
    for (const Vec3 p : points_) low = std::min(low, p.z), high = std::max(high, p.z);
    if (delaunay_.dimension() == 2) {
      auto v = delaunay_.incident_vertices(delaunay_.infinite_vertex());
      const auto first = v;
      std::vector<std::int32_t> ring;
      do ring.push_back(v->info().point);
      while (++v != first);
      for (std::size_t i = 0; i < ring.size(); ++i)
        hull.push_back({points_[static_cast<std::size_t>(ring[i])],
                        points_[static_cast<std::size_t>(ring[(i + 1) % ring.size()])]});
    } else {
      for (const auto* lines : {&lines_.rims, &lines_.feet})
        hull.insert(hull.end(), lines->begin(), lines->end());
    }
    const int count = high - low > 0 ? border_points : 1;
    const Box around = bounding_box(points_);
    reach_ = std::min(slope_reach_m, std::hypot(around.high.x - around.low.x,  //
                                                around.high.y - around.low.y));
    const Box sloping = widened(around, reach_);
    near_lines_.low = {std::max(sloping.low.x, lines_.x0), std::max(sloping.low.y, lines_.y0), 0};
    near_lines_.high = {std::min(sloping.high.x, lines_.x1), std::min(sloping.high.y, lines_.y1),
                        0};
    Box whole = sloping;
    whole.low = {lines_.x0, lines_.y0, low};
    whole.high = {lines_.x1, lines_.y1, low};
    add_border(whole, count, hull);
    if (count > 1 && sloping.low.x > lines_.x0 && sloping.low.y > lines_.y0 &&
        sloping.high.x < lines_.x1 && sloping.high.y < lines_.y1)
      add_border(sloping, count, hull);
  }

  void add_border(const Box& box, int count, const std::vector<Segment>& hull) {
    const Vec3 corners[] = {{box.low.x, box.low.y, box.low.z},
                            {box.high.x, box.low.y, box.low.z},
                            {box.high.x, box.high.y, box.low.z},
                            {box.low.x, box.high.y, box.low.z}};
    const Vec3 size = box.high - box.low;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 from = corners[k], to = corners[(k + 1) % 4];
      // Triangles at the long sides of a strip would be needles all along it.
      const double across =
          std::floor(norm(to - from) / std::max(std::min(size.x, size.y), land_snap_m));
      const int pieces = std::max(count, static_cast<int>(std::min(across, most_border_points)));
      for (int i = 0; i < pieces; ++i)
        add_border_point(from + (static_cast<double>(i) / pieces) * (to - from), hull);
    }
  }

  void add_border_point(Vec3 p, const std::vector<Segment>& hull) {
    NearestOnLine best{infinity, 0, p.z};
    Vec3 foot = p;
    for (const Segment& edge : hull) {
      const NearestOnLine found = nearest_in_plan(edge, p.x, p.y);
      if (found.distance >= best.distance) continue;
      best = found;
      foot = edge[0] + found.along * (edge[1] - edge[0]);
    }
    if (best.distance <= land_snap_m) return;  // without a margin the hull ends at the border
    const LandSlope slope = slopes_.around(foot.x, foot.y);
    steepest_beyond_ = std::max(steepest_beyond_, std::hypot(slope.x, slope.y));
    const double part = std::min(1.0, reach_ / best.distance);
    best.z += part * (slope.x * (p.x - foot.x) + slope.y * (p.y - foot.y));
    const auto handle = delaunay_.insert({p.x, p.y});
    handle->info().point = static_cast<std::int32_t>(points_.size());
    p.z = best.z;
    points_.push_back(p);
  }

  /// Points between the lines, on the triangles that are there.
  void fill_open_land() {
    std::vector<Vec3> open = open_land_points(lines_, near_lines_);
    LandDelaunay::Face_handle near{};
    for (Vec3& p : open) {
      near = delaunay_.locate({p.x, p.y}, near);
      p.z = delaunay_.is_infinite(near) ? -infinity : height_on(near, p.x, p.y);
    }
    near = {};
    for (const Vec3 p : open) {
      if (p.z == -infinity) continue;
      const auto handle = delaunay_.insert({p.x, p.y}, near);
      handle->info().point = static_cast<std::int32_t>(points_.size());
      points_.push_back(p);
      near = handle->face();
    }
  }

  /// Where `height_at` would refuse what rounding puts beside an edge.
  double height_on(LandDelaunay::Face_handle face, double x, double y) const {
    const auto corner = [&](int k) {
      return points_[static_cast<std::size_t>(face->vertex(k)->info().point)];
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    const double v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    return a.z + std::clamp(u, 0.0, 1.0) * (b.z - a.z) + std::clamp(v, 0.0, 1.0) * (c.z - a.z);
  }

  Land collect() const {
    Land land;
    land.points = points_;
    land.steepest_beyond = steepest_beyond_;
    for (const auto face : delaunay_.finite_face_handles()) {
      std::array<std::int32_t, 3> t{};
      for (int k = 0; k < 3; ++k) t[static_cast<std::size_t>(k)] = face->vertex(k)->info().point;
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      land.triangles.push_back(t);
    }
    std::sort(land.triangles.begin(), land.triangles.end());
    return land;
  }

  const LandLines& lines_;
  PlanLines rims_, feet_;
  LandSlopes slopes_;
  double reach_ = 0, steepest_beyond_ = 0;
  Box near_lines_;  ///< of the rectangle, as far as land slopes
  std::vector<Vec3> points_;
  LandDelaunay delaunay_;
  std::vector<LandDelaunay::Vertex_handle> handles_;
};

}  // namespace

Land triangulate_land(const LandLines& lines) {
  try {
    return LandMaker(lines).run();
  } catch (const CGAL::Failure_exception& failure) {
    throw InputError({}, "the feet of bodies make no land",
                     "their triangulation failed: " + failure.message(),
                     "write scene.ground: {surface: level}");
  }
}

}  // namespace sunload
