// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Facades: what a planner calls the north side of a house.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Faces of kind wall or window that are at least this steep may be in a facade.
inline constexpr double facade_slope_deg = 45;
/// Largest angle to the facade's direction: a window's reveals stay out, slight
/// bends and zigzags stay in, a round tower falls into a dozen sectors.
inline constexpr double facade_angle_deg = 15;
/// Largest distance of a region's centre from the facade's plane: recessed
/// windows and shallow bays stay in.
inline constexpr double facade_offset_m = 1;
/// Largest gap between two regions of a facade: ledges and pilasters do not
/// divide it, the next wing in line is another facade.
inline constexpr double facade_gap_m = 1;
/// Least area of the largest connected region of a facade.
inline constexpr double least_facade_area_m2 = 1;

/// What the order and the name of a facade follow from, beside north.
struct FoundFacade {
  ObjectId object;
  double azimuth_deg;  ///< in the scene frame
  double area_m2;
  Vec3 centre;
  std::size_t group;  ///< its number among those found
  std::string name;
};

/// Finds the facades of each object and sets `triangle_facade` and `facades`.
///
/// Two steps, both within one object. *Regions*: beginning with the largest
/// face, a region grows over shared edges to faces within `facade_angle_deg`
/// and `facade_offset_m` of its first face. *Facades*: beginning with the
/// largest region (at least `least_facade_area_m2`), a facade takes in regions
/// within that angle and offset of its first region (area-weighted normal and
/// centre) whose bounding boxes come within `facade_gap_m`, along each axis, of
/// one that it has. Regions that no facade takes have none. Of more than 200
/// faces at one edge, or parallel regions in one place, not all are compared.
///
/// Names are `<object>/<compass>_<n>`: the nearest of eight compass points to
/// the facade's mean normal, `north_deg` (azimuth of scene +y) added, and n
/// from 1 in the order of decreasing area. `facades` is ordered by object,
/// compass point (clockwise from north) and n. Facade::azimuth_deg is in the
/// scene frame, without `north_deg`. Returns them as they were found, in that order.
std::vector<FoundFacade> find_facades(Mesh& mesh, double north_deg);

/// Names and orders them as they would have been found with another north. Of `mesh` some of
/// `found`, in their order: what is covered may have been cut from them since.
void turn_facades(Mesh& mesh, std::vector<FoundFacade>& found, double north_deg);

}  // namespace sunload
