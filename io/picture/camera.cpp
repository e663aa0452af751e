// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/camera.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "geo/mesh/mesh.h"

namespace sunload {
namespace {

// Share of the image that the points may fill; the rest is their margin.
constexpr double filled_share = 0.94;
// Sine of the angle below which a line of sight counts as vertical.
constexpr double vertical = 1e-6;

Vec3 usual_up(Vec3 towards_viewer) {
  const Vec3 z{0, 0, 1};
  return norm(cross(z, towards_viewer)) < vertical ? Vec3{0, 1, 0} : z;
}

Vec3 middle(const std::vector<Vec3>& points) {
  const Box box = bounding_box(points);
  return (box.low + box.high) / 2;
}

}  // namespace

Camera::Camera(Projection projection, Vec3 towards_viewer, Vec3 up, int width, int height)
    : projection_(projection),
      right_(normalized(cross(up, towards_viewer))),
      back_(normalized(towards_viewer)),
      width_(width),
      height_(height) {
  up_ = cross(back_, right_);
}

Camera Camera::perspective(Vec3 eye, Vec3 look, double field_deg, int width, int height) {
  const Vec3 back = normalized(eye - look);
  Camera camera(Projection::central, back, usual_up(back), width, height);
  camera.eye_ = eye;
  camera.scale_ = std::tan(radians(field_deg) / 2);
  return camera;
}

Camera Camera::fitted(const std::vector<Vec3>& points, Vec3 towards_viewer, double field_deg,
                      int width, int height) {
  Camera camera(Projection::central, towards_viewer, usual_up(normalized(towards_viewer)), width,
                height);
  camera.scale_ = std::tan(radians(field_deg) / 2);
  const double y_tangent = camera.scale_ * filled_share;
  const double x_tangent = y_tangent * width / height;
  // Of each side plane of the frustum, the one that touches the points:
  // |x - x_eye| ≤ tangent·(z_eye - z) for all of them.
  double x_low = -1e300, x_high = -1e300, y_low = -1e300, y_high = -1e300;
  const Vec3 centre = middle(points);
  for (const Vec3 p : points) {
    const double x = dot(p - centre, camera.right_), y = dot(p - centre, camera.up_),
                 z = dot(p - centre, camera.back_);
    x_low = std::max(x_low, z - x / x_tangent);
    x_high = std::max(x_high, z + x / x_tangent);
    y_low = std::max(y_low, z - y / y_tangent);
    y_high = std::max(y_high, z + y / y_tangent);
  }
  const double distance = std::max(x_low + x_high, y_low + y_high) / 2;
  camera.eye_ = centre + camera.right_ * (x_tangent * (x_high - x_low) / 2) +
                camera.up_ * (y_tangent * (y_high - y_low) / 2) + camera.back_ * distance;
  return camera;
}

Camera Camera::parallel(const std::vector<Vec3>& points, Vec3 towards_viewer, Vec3 up, int width,
                        int height, std::optional<double> front_m) {
  const bool is_along = norm(cross(up, normalized(towards_viewer))) < vertical;
  Camera camera(Projection::parallel, towards_viewer, is_along ? Vec3{0, 1, 0} : up, width, height);
  std::vector<Vec3> projected;
  projected.reserve(points.size());
  for (const Vec3 p : points)
    projected.push_back({dot(p, camera.right_), dot(p, camera.up_), dot(p, camera.back_)});
  const Box box = bounding_box(projected);
  const Vec3 size = box.high - box.low, centre = middle(projected);
  camera.scale_ = std::max(size.y, size.x * height / width) / 2 / filled_share;
  // In front of everything by as much as the scene is deep, points behind included.
  const double reach = front_m.value_or(size.x + size.y + size.z);
  camera.eye_ =
      camera.right_ * centre.x + camera.up_ * centre.y + camera.back_ * (box.high.z + reach);
  return camera;
}

CameraRay Camera::ray(double x, double y) const {
  const double across = (2 * x - width_) / height_ * scale_;
  const double upward = (height_ - 2 * y) / height_ * scale_;
  const Vec3 shift = right_ * across + up_ * upward;
  if (projection_ == Projection::parallel) return {eye_ + shift, -back_};
  return {eye_, normalized(shift - back_)};
}

double Camera::pixel_size(double distance) const {
  const double pixel = 2 * scale_ / height_;
  return projection_ == Projection::parallel ? pixel : pixel * distance;
}

PicturePoint Camera::image_direction(Vec3 direction) const {
  return {dot(direction, right_), -dot(direction, up_)};
}

PicturePoint Camera::ground_direction(Vec3 direction) const {
  const PicturePoint at = image_direction(direction);
  constexpr double sine_of_45_deg = 0.70710678118654752;
  const bool looks_up = back_.z < 0 && back_.z > -sine_of_45_deg;
  return {at.x, looks_up ? -at.y : at.y};
}

}  // namespace sunload
