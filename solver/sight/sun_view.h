// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene as suns that stand close together see it: which faces may shade what lies in each cell
/// of a grid across their light.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/sight/sun_clusters.h"
#include "solver/sight/sun_faces.h"
#include "solver/sight/view_polygon.h"

namespace sunload {

class SunView {
 public:
  /// Of all that receives light, and the size of cells that suits it.
  struct Extent {
    Vec3 centre;
    double radius_m, cell_m;
  };
  /// `faces` and `suns` must outlive it. Cost: some nanoseconds for each face and cell that it
  /// reaches into.
  SunView(const SunFaces& faces, const Extent& extent, const SunCluster& suns);

  const SunCluster& suns() const { return suns_; }
  /// How high a place lies: its z, and its height towards the middle of the suns [m].
  struct Height {
    double z, along;
  };
  /// How far light rises along the middle of the suns, at the most, from a place no lower than
  /// `lowest` to one no higher than `highest` [m]; 0 or below: it does not reach it.
  double rise(const Height& lowest, const Height& highest) const {
    const double along = highest.along - lowest.along;
    // Of a disk that has half set some light goes upward.
    return suns_.lowest_sine > 0 ? std::min(along, (highest.z - lowest.z) / suns_.lowest_sine)
                                 : along;
  }
  /// Where a face lies across the light, and how high its highest corner is.
  struct Bounds {
    ViewBox box;
    Height highest;
  };
  const Bounds& bounds(std::size_t face) const { return bounds_[face]; }
  const Height& highest() const { return highest_; }  ///< of all faces

  /// Inclusive. Cells at the rim stand for all beyond.
  struct Cells {
    std::size_t column0, column1, row0, row1;
  };
  /// Cells that a box meets which is wider by so much on each side [m].
  Cells cells(const ViewBox& box, double wider_x, double wider_y) const {
    return {place(box.x0 - wider_x - x0_), place(box.x1 + wider_x - x0_),
            place(box.y0 - wider_y - y0_), place(box.y1 + wider_y - y0_)};
  }
  /// Faces that reach into a cell, by what of them is highest along the light: the highest first.
  std::span<const std::uint32_t> faces_in(std::size_t column, std::size_t row) const {
    return in_cell_[0].of(row * across_ + column);
  }
  /// Cores likewise.
  std::span<const std::uint32_t> cores_in(std::size_t column, std::size_t row) const {
    return in_cell_[1].of(row * across_ + column);
  }

 private:
  std::size_t place(double along_m) const {
    const double at = along_m * cells_per_m_;
    return at > 0 ? std::min(static_cast<std::size_t>(at), across_ - 1) : 0;
  }
  /// What reaches into each cell.
  struct InCells {
    std::vector<std::uint32_t> first, number;
    std::span<const std::uint32_t> of(std::size_t cell) const {
      return std::span(number).subspan(first[cell], first[cell + 1] - first[cell]);
    }
  };
  void project();
  InCells listed(const std::vector<std::uint32_t>& highest_first) const;

  const SunFaces& faces_;
  const SunCluster& suns_;
  double x0_, y0_, cells_per_m_;
  std::size_t across_;
  Height highest_{-1e300, -1e300};
  std::vector<ViewCorner> corner_;  ///< of all faces and cores
  std::vector<Bounds> bounds_;
  std::array<InCells, 2> in_cell_;  ///< faces that are needed, cores
};

}  // namespace sunload
