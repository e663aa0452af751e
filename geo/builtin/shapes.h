// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Building blocks of the built-in scenes: closed bodies with openings.
///
/// A body is made of planar faces. Whatever a face carries (a window, a door, a
/// chimney) begins with a hole in it, and the walls of the feature start at the
/// edges of that hole: bodies are closed by construction, without faces that
/// lie on other faces and without vertices in the middle of an edge.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload::builtin {

/// Between bodies and plates that would touch [m].
inline constexpr double joint = 0.005;
inline constexpr double plate_thickness = 0.3;  ///< of the ground [m]

/// A point in the plane of a face [m].
struct Point2 {
  double u = 0, v = 0;
};
/// A closed line, counter-clockwise seen from the front of its face.
using Ring = std::vector<Point2>;

/// Its corners, counter-clockwise from `low`.
Ring rectangle(Point2 low, Point2 high);

/// A plane with orthonormal axes; the front is where u × v points to.
struct Frame {
  Vec3 origin, u, v;

  Vec3 normal() const { return cross(u, v); }
  Vec3 at(Point2 p, double height = 0) const {
    return origin + p.u * u + p.v * v + height * normal();
  }
  Point2 coordinates(Vec3 point) const { return {dot(point - origin, u), dot(point - origin, v)}; }
  Frame lifted(double height) const { return {at({}, height), u, v}; }
};

/// What a face is made of and what it is.
struct Finish {
  MaterialId material;
  Surface surface = Surface::other;
};

/// Where the next bodies stand: turned about the vertical, then moved.
enum class Turn { none, half };
/// Turned by nothing or by half a turn, then moved by `position` [m].
struct Placement {
  Vec3 position;
  Turn turn = Turn::none;

  Vec3 operator()(Vec3 p) const {
    return turn == Turn::half ? position + Vec3{-p.x, -p.y, p.z} : position + p;
  }
};

/// Collects faces into a model; equal points of one object are one vertex.
class Builder {
 public:
  explicit Builder(std::string source);

  /// `emitted_power_w` is shared by all faces of the material.
  MaterialId material(const std::string& name, double diffuse, double mirror = 0,
                      double emitted_power_w = 0);
  /// Faces added from now on belong to this object.
  void begin_object(const std::string& name, Placement placement = {});
  /// Rings: outer counter-clockwise seen from the front, holes clockwise.
  void face(const std::vector<std::vector<Vec3>>& rings, Finish finish);
  PolygonModel take() { return std::move(model_); }

 private:
  std::int32_t vertex(Vec3 point);

  PolygonModel model_;
  Placement placement_;
  std::map<std::array<std::int64_t, 3>, std::int32_t> vertex_of_;  ///< of the current object
};

/// A planar face that openings are cut into before it is handed to the builder.
class Face {
 public:
  Face(Builder& builder, Frame frame, Ring outline, Finish finish);

  Builder& builder() const { return *builder_; }
  const Frame& frame() const { return frame_; }
  /// Extent of the outline.
  Point2 low() const { return low_; }
  Point2 high() const { return high_; }
  /// Cuts a hole that the caller closes: its first edges run along `ring`.
  void cut(const Ring& ring);
  /// Cuts `ring` and moves it by `height` along the normal: a boss (> 0) or a
  /// recess (< 0). Its sides are added, its moved face is returned.
  Face step(const Ring& ring, double height, Finish sides, Finish cap);
  /// The same with the moved points given; they must lie in `cap_frame`.
  Face step_to(const Ring& ring, const std::vector<Vec3>& moved, Frame cap_frame, Finish sides,
               Finish cap);
  /// Adds the face with all its holes; must be the last call.
  void emit();

 private:
  Builder* builder_;
  Frame frame_;
  Ring outline_;
  std::vector<Ring> holes_;
  Finish finish_;
  Point2 low_, high_;
};

/// An axis-parallel box; the finish of its bottom may differ.
void box(Builder& builder, Vec3 low, Vec3 high, Finish finish, std::optional<Finish> bottom = {});

/// A box turned by `angle` about the axis through its centre (unit vector).
void turned_box(Builder& builder, Vec3 centre, Vec3 size, Vec3 axis, double angle, Finish finish);

/// An upright prism over `outline` (counter-clockwise from above) with separate
/// finishes; `shafts` are openings from top to bottom, inside the outline.
struct PrismFinish {
  Finish side, top, bottom;
  Finish shaft{};
};
void prism(Builder& builder, const Ring& outline, double z_low, double z_high, PrismFinish finish,
           const std::vector<Ring>& shafts = {});

/// The ring about `centre`, each point `factor` times as far from it.
Ring scaled(const Ring& ring, Point2 centre, double factor);
/// Every point moved by `by`.
Ring moved(const Ring& ring, Point2 by);

/// A body of revolution about the vertical through `foot`: points (radius,
/// height) from the centre of the foot up to the centre of the top.
void lathe(Builder& builder, Vec3 foot, const std::vector<Point2>& profile, int sides,
           Finish finish, Finish bottom);

/// Regular polygon about the origin, the first side facing −v.
Ring regular_polygon(int sides, double radius);

/// A one-sided rectangle; front where u × v points to (u, v are its edges).
void sheet(Builder& builder, Vec3 corner, Vec3 edge_u, Vec3 edge_v, Finish finish);

}  // namespace sunload::builtin
