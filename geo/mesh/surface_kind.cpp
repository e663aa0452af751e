// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "geo/base/units.h"

namespace sunload {

namespace {

// CityJSON 2.0.1, section 2.2: objects that are land or water, and plants.
constexpr std::array<std::string_view, 8> land_kinds{"TINRelief", "LandUse",         "Road",
                                                     "Railway",   "TransportSquare", "WaterBody",
                                                     "Waterway",  "PlantCover"};
constexpr std::array<std::string_view, 2> plant_kinds{"SolitaryVegetationObject", "PlantCover"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

enum class Slope { upward, upright, downward };

std::optional<Slope> slope(const Mesh& mesh, std::size_t t) {
  static const double steepest = std::cos(radians(upright_slope_deg));
  const Vec3 area_vector2 = mesh.area_vector2(t);
  const double length = norm(area_vector2);
  if (!(length > 0)) return {};
  const double z = area_vector2.z / length;
  return z > steepest ? Slope::upward : (z < -steepest ? Slope::downward : Slope::upright);
}

struct Heights {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const Box& box) {
    low = std::min(low, box.low.z);
    high = std::max(high, box.high.z);
  }
  double foot() const { return low + std::min(foot_height_m, foot_height_ratio * (high - low)); }
  double foot_tolerance() const { return foot() - low; }
};

/// A downward face at the foot of a body that may hover.
struct Foot {
  std::size_t triangle;
  std::int32_t body;
  double x, y, foot_z, top_z, tolerance;
  double support_z = -std::numeric_limits<double>::infinity();  // highest surface found below
};

/// Feet in square cells, about one per cell.
class FootGrid {
 public:
  explicit FootGrid(std::vector<Foot>& feet) : feet_(feet) {
    double high_x = feet[0].x, high_y = feet[0].y;
    low_x_ = feet[0].x, low_y_ = feet[0].y;
    for (const auto& foot : feet) {
      low_x_ = std::min(low_x_, foot.x), high_x = std::max(high_x, foot.x);
      low_y_ = std::min(low_y_, foot.y), high_y = std::max(high_y, foot.y);
    }
    per_side_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::sqrt(static_cast<double>(feet.size()))));
    width_x_ = (high_x - low_x_) / static_cast<double>(per_side_);
    width_y_ = (high_y - low_y_) / static_cast<double>(per_side_);
    cells_.resize(per_side_ * per_side_);
    for (std::size_t i = 0; i < feet.size(); ++i) {
      cells_[row(feet[i].y) * per_side_ + column(feet[i].x)].push_back(i);
    }
  }

  /// Lets an upward triangle support the feet of other bodies above it.
  void support(std::int32_t body, Vec3 a, Vec3 b, Vec3 c) {
    const double x0 = std::min({a.x, b.x, c.x}), x1 = std::max({a.x, b.x, c.x});
    const double y0 = std::min({a.y, b.y, c.y}), y1 = std::max({a.y, b.y, c.y});
    for (std::size_t j = row(y0); j <= row(y1); ++j) {
      for (std::size_t i = column(x0); i <= column(x1); ++i) {
        for (const auto f : cells_[j * per_side_ + i]) {
          if (feet_[f].body != body) support_foot(feet_[f], a, b, c);
        }
      }
    }
  }

 private:
  static void support_foot(Foot& foot, Vec3 a, Vec3 b, Vec3 c) {
    const auto twice_area = [](double ux, double uy, double vx, double vy) {
      return ux * vy - uy * vx;
    };
    const double whole = twice_area(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    const double wa = twice_area(b.x - foot.x, b.y - foot.y, c.x - foot.x, c.y - foot.y);
    const double wb = twice_area(c.x - foot.x, c.y - foot.y, a.x - foot.x, a.y - foot.y);
    const double wc = whole - wa - wb;
    if (!(whole > 0 && wa >= 0 && wb >= 0 && wc >= 0)) return;
    const double z = (wa * a.z + wb * b.z + wc * c.z) / whole;
    if (z < foot.top_z) foot.support_z = std::max(foot.support_z, z);
  }
  std::size_t column(double x) const { return cell(x - low_x_, width_x_); }
  std::size_t row(double y) const { return cell(y - low_y_, width_y_); }
  std::size_t cell(double offset, double width) const {
    if (!(width > 0) || !(offset > 0)) return 0;
    return static_cast<std::size_t>(std::min(offset / width, static_cast<double>(per_side_ - 1)));
  }

  std::vector<Foot>& feet_;
  std::vector<std::vector<std::size_t>> cells_;
  std::size_t per_side_ = 1;
  double low_x_ = 0, low_y_ = 0, width_x_ = 0, width_y_ = 0;
};

class Decision {
 public:
  Decision(Mesh& mesh, const Bodies& bodies, SceneKind kind)
      : mesh_(mesh), bodies_(bodies), kind_(kind), of_object_(mesh.object_names.size()) {
    for (const auto& body : bodies.bodies) of_object_[body.object.index()].add(body.box);
  }

  void run() {
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (mesh_.triangle_surface[t] != Surface::other) continue;
      if (const auto s = slope(mesh_, t)) mesh_.triangle_surface[t] = surface(t, *s);
    }
    if (!feet_.empty()) take_back_hovering_floors();
  }

 private:
  const Body* body_of(std::size_t t) const {
    const auto b = bodies_.triangle_body[t];
    return b < 0 ? nullptr : &bodies_.bodies[static_cast<std::size_t>(b)];
  }

  Surface surface(std::size_t t, Slope s) {
    const Body* body = body_of(t);
    const bool is_closed = body && body->is_closed;
    const auto& word = mesh_.object_kinds[mesh_.triangle_object[t].index()];
    if (!is_closed && contains(land_kinds, word)) return on_land(s);
    if (contains(plant_kinds, word)) return Surface::other;
    if (kind_ == SceneKind::plain && !is_closed)
      return s == Slope::upright ? Surface::wall : Surface::other;
    if (s == Slope::upright) return Surface::wall;
    if (body && body->is_inside_out) return Surface::other;
    if (s == Slope::upward) return Surface::roof;
    return at_foot(t, body) ? Surface::floor : Surface::other;
  }

  static Surface on_land(Slope s) {
    if (s == Slope::upright) return Surface::wall;
    return s == Slope::upward ? Surface::ground : Surface::other;
  }

  bool at_foot(std::size_t t, const Body* body) {
    Heights heights;
    if (kind_ == SceneKind::city) {
      heights = of_object_[mesh_.triangle_object[t].index()];
    } else {
      heights.add(body->box);
    }
    for (int k = 0; k < 3; ++k) {
      if (mesh_.corner(t, k).z > heights.foot()) return false;
    }
    if (kind_ == SceneKind::plain) {
      const Vec3 middle = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
      feet_.push_back({t, bodies_.triangle_body[t], middle.x, middle.y, heights.low, heights.high,
                       heights.foot_tolerance()});
    }
    return true;
  }

  void take_back_hovering_floors() {
    FootGrid grid(feet_);
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (slope(mesh_, t) != Slope::upward) continue;
      grid.support(bodies_.triangle_body[t], mesh_.corner(t, 0), mesh_.corner(t, 1),
                   mesh_.corner(t, 2));
    }
    const double lowest_z = bounding_box(mesh_.vertices).low.z;
    for (const auto& foot : feet_) {
      const double ground_z = std::isfinite(foot.support_z) ? foot.support_z : lowest_z;
      if (ground_z < foot.foot_z - foot.tolerance) {
        mesh_.triangle_surface[foot.triangle] = Surface::other;
      }
    }
  }

  Mesh& mesh_;
  const Bodies& bodies_;
  SceneKind kind_;
  std::vector<Heights> of_object_;
  std::vector<Foot> feet_;
};

}  // namespace

void decide_surfaces(Mesh& mesh, const Bodies& bodies, SceneKind kind) {
  Decision(mesh, bodies, kind).run();
}

}  // namespace sunload
