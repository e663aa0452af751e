// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of ordinary Central European street houses, and whole houses.
///
/// House frame: the front faces −y at y = 0, x runs along the street, z = 0 is
/// the pavement. Dimensions are those common in tenement houses of about 1900
/// (storeys of 3.2–4 m, windows of 1.1 × 1.9 m in reveals of 0.2 m) and in
/// curtain walls of today (panes of a storey's height in 6 cm mullions).
#pragma once

#include <string>
#include <vector>

#include "geo/builtin/shapes.h"

namespace sunload::builtin {

/// Finishes of the parts of a house, by what they are.
struct HouseFinishes {
  Finish wall, base_wall, trim, frame, window, door, roof, balcony, floor, chimney;
};

/// Panes of a window: one, two side by side, or two with a light above each.
enum class Panes { one, two, four };

/// Measures of a window [m].
struct WindowKind {
  double width = 1.1, height = 1.9;
  double reveal = 0.2;  ///< depth of the frame behind the wall
  double sill = 0.12;   ///< how far the sill stands out; 0 = none
  Panes panes = Panes::two;
  double hood = 0;  ///< how far the moulding above stands out; 0 = none
};

/// A window with its lower middle at `foot`.
void window(Face& wall, Point2 foot, const WindowKind& kind, const HouseFinishes& finishes);

/// A street door with a light above it and a step before it.
void door(Face& wall, double middle, double width, double height, const HouseFinishes& finishes);

/// A large pane for a shop: frame with one pane, no sill.
void shop_window(Face& wall, Point2 low, Point2 high, const HouseFinishes& finishes);

/// A slab with a parapet around it, and a glazed door above.
void balcony(Face& wall, Point2 foot, double width, double depth, const HouseFinishes& finishes);

/// A stack with pots on a sloping face, its foot around `middle`, up to height `top` (z).
void chimney(Face& slope, Point2 middle, Point2 size, double top, int pots,
             const HouseFinishes& finishes);

/// A gabled dormer with a window; `foot` is the lower middle of its front.
struct DormerKind {
  double width = 1.8, wall_height = 1.5, gable_height = 0.7;
  WindowKind window{.width = 1.0, .height = 1.1, .reveal = 0.08, .sill = 0};
};
void dormer(Face& slope, Point2 foot, const DormerKind& kind, const HouseFinishes& finishes);

/// A window in the roof's plane.
void roof_window(Face& slope, Point2 middle, const HouseFinishes& finishes);

/// A closed body swept along x from 0 to `length`.
///
/// The profile (u = y, v = z) is counter-clockwise seen from +x; every edge
/// makes one face whose v axis points up (or outwards for level edges), and the
/// two ends are gables. All faces are kept open for windows until `emit`.
class Sweep {
 public:
  /// One edge of the profile, and what its face is made of.
  struct Edge {
    Point2 from;  ///< the edge runs to the next one's `from`
    Finish finish;
    std::string name;  ///< to find the face again; may be empty
  };
  Sweep(Builder& builder, std::vector<Edge> profile, double length, Finish gable);

  /// The face of the edge with this name.
  Face& face(const std::string& name);
  Face& gable_low() { return faces_[faces_.size() - 2]; }   ///< at x = 0, facing −x
  Face& gable_high() { return faces_[faces_.size() - 1]; }  ///< at x = length
  void emit();

 private:
  std::vector<std::string> names_;
  std::vector<Face> faces_;
};

}  // namespace sunload::builtin
