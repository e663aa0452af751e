// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The dome of the sky on a disc of paper.
///
/// A map: north up, east right, azimuth clockwise from true north, the zenith in the centre,
/// the horizon as the outer circle. (Lying on one's back, east is left.)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/base/units.h"
#include "geo/sky/horizon.h"
#include "io/picture/picture.h"

namespace sunload {

/// stereographic: distance from the centre = radius · tan(zenith angle / 2), circles on the
/// sphere stay circles. equidistant: proportional to the zenith angle.
enum class DomeProjection { stereographic, equidistant };

/// Converts places of the sky to pixels and back, and draws the grid.
class DomeChart {
 public:
  /// Fills a picture below its title, left of `right_margin` pixels. The labels of azimuths
  /// stand outside of a ring that is left free for others, a share of the radius.
  DomeChart(const Picture& picture, DomeProjection projection, double right_margin,
            double room_for_labels = 0);

  PicturePoint centre() const { return centre_; }
  double radius() const { return radius_; }
  double text_size() const { return text_size_; }
  /// Elevations below 0 lie outside of the outer circle.
  PicturePoint at(Horizontal place) const;
  /// A place at the horizon, moved outward by a share of the radius: for labels.
  PicturePoint beyond_horizon(double azimuth_deg, double share) const;
  /// Place of a pixel; nothing outside of the outer circle.
  std::optional<Horizontal> place(PicturePoint p) const;

  /// Circles every 10° of elevation, azimuth lines every 30° with labels, N E S W.
  void draw_grid(Picture& picture, Colour colour) const;
  void fill_below(Picture& picture, const Horizon& hills, Colour colour) const;
  void draw_line(Picture& picture, const Horizon& hills, Colour colour) const;

 private:
  std::vector<PicturePoint> ring(const Horizon& hills) const;

  DomeProjection projection_;
  double room_;
  PicturePoint centre_;
  double radius_ = 0, text_size_ = 0;
};

/// What the chart's directions mean, in words for the picture.
inline const std::string dome_convention =
    "map view: N up, E right, azimuth clockwise from true north";

}  // namespace sunload
