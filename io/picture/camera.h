// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Cameras for pictures of a scene.
#pragma once

#include <optional>
#include <vector>

#include "geo/base/vec.h"
#include "io/picture/picture.h"

namespace sunload {

/// From the camera into the scene [m].
struct CameraRay {
  Vec3 origin, direction;  ///< direction of unit length
};

/// Maps points of the image plane to rays. Image coordinates are pixels, x to
/// the right, y down, of an image of `width` × `height`.
class Camera {
 public:
  /// Central perspective from `eye` to `look`; z is up, +y where that fails.
  /// The vertical field of view is `field_deg`.
  static Camera perspective(Vec3 eye, Vec3 look, double field_deg, int width, int height);
  /// Central perspective along -`towards_viewer` that just holds all `points`.
  static Camera fitted(const std::vector<Vec3>& points, Vec3 towards_viewer, double field_deg,
                       int width, int height);
  /// Parallel projection along -`towards_viewer` that just holds all `points`. What is more than
  /// `front_m` before the foremost of them is cut away; left out: nothing is.
  static Camera parallel(const std::vector<Vec3>& points, Vec3 towards_viewer, Vec3 up, int width,
                         int height, std::optional<double> front_m = std::nullopt);

  CameraRay ray(double x, double y) const;
  /// Length that a pixel covers across the line of sight at that distance.
  double pixel_size(double distance) const;
  /// Direction in the image (x right, y down) of a direction of the scene.
  PicturePoint image_direction(Vec3 direction) const;
  /// The same of a level direction, as ground below the viewer shows it: what is farther away lies
  /// higher in the image, also where the camera looks a little upward. Where it looks up by more
  /// than 45 degrees it shows no ground.
  PicturePoint ground_direction(Vec3 direction) const;

 private:
  enum class Projection { central, parallel };
  Camera(Projection projection, Vec3 towards_viewer, Vec3 up, int width, int height);

  Projection projection_;
  Vec3 right_, up_, back_;  ///< right-handed; back_ points to the viewer
  Vec3 eye_;
  double scale_ = 0;  ///< half height of the image: tangent (central) or length (parallel)
  int width_, height_;
};

}  // namespace sunload
