// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "geo/sun/map_axes.h"
#include "io/scene/base/indexed_faces.h"
#include "io/scene/base/plain_names.h"
#include "io/scene/raster/fill_holes.h"
#include "io/scene/raster/raster.h"

namespace sunload {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double grid_tolerance = 1e-3;  // of a cell: files round their corners

/// Columns on a grid of cells, each from its bottom, which may slope, to its flat top.
struct BlockColumns {
  std::vector<double> top;     ///< per cell; NaN: no column
  std::vector<double> bottom;  ///< per cell; empty: the land is

  bool has(std::size_t cell) const { return !std::isnan(top[cell]); }
};

/// Which faces of columns are told to be what.
struct Kinds {
  Surface top, side, bottom;
};
constexpr Kinds of_buildings{Surface::roof, Surface::wall, Surface::floor};
constexpr Kinds of_crowns{Surface::other, Surface::other, Surface::other};

/// A corner of a cell, (0, 0) at its first row and column.
struct Corner {
  std::size_t column, row;
};

class BlockReader {
 public:
  BlockReader(const RasterFiles& files, const SceneFileRules& rules)
      : files_(files),
        unit_m_(rules.unit_m),
        faces_(files.surface, rules, 'z'),
        surface_(read_raster(files.surface, unit_m_, RasterValues::elevations, faces_.notes())),
        terrain_(read_on_grid(files.terrain, RasterValues::elevations)) {
    if (!files.canopy.empty()) canopy_ = read_on_grid(files.canopy, RasterValues::heights);
    // Counter-clockwise seen from above.
    if (surface_.rows_go_north()) ring_ = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  }

  PolygonModel read() {
    fill_terrain();
    find_buildings();
    find_land();
    add_land();
    add_bodies(buildings_, "building", "Building", of_buildings);
    if (!canopy_.values.empty()) {
      find_crowns();
      FileMaterial crown;
      crown.name = "crown";
      crown.is_reference = true;
      faces_.use_material(faces_.add_material(crown));
      add_bodies(crowns_, "crown", "SolitaryVegetationObject", of_crowns);
    }
    auto model = faces_.finish();
    model.crs = surface_.crs;
    return model;
  }

 private:
  Raster read_on_grid(const std::string& path, RasterValues values) {
    Raster raster = read_raster(path, unit_m_, values, faces_.notes());
    const auto refuse = [&](const std::string& what) {
      throw InputError(
          {path}, what,
          "its cells must be those of " + std::filesystem::path(files_.surface).filename().string(),
          "bring it onto that grid, for example with gdalwarp -te … -ts …");
    };
    if (raster.columns != surface_.columns || raster.rows != surface_.rows)
      refuse(fmt::format("has {} × {} cells, not {} × {}", raster.columns, raster.rows,
                         surface_.columns, surface_.rows));
    const double cell = std::hypot(surface_.file_from_cell[1], surface_.file_from_cell[4]);
    for (const auto& [c, r] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
      const double column = c * static_cast<double>(raster.columns);
      const double row = r * static_cast<double>(raster.rows);
      const Vec3 off = raster.place(column, row, 0) - surface_.place(column, row, 0);
      if (!(norm(off) <= grid_tolerance * cell)) refuse("lies on another grid");
    }
    if (!raster.crs.empty() && !surface_.crs.empty() && !are_of_one_map(raster.crs, surface_.crs))
      refuse("has coordinates in " + raster.crs);
    return raster;
  }

  std::size_t cell_count() const { return surface_.values.size(); }
  std::size_t corner_index(Corner corner) const {
    return corner.row * (surface_.columns + 1) + corner.column;
  }

  /// Many terrain models have no data below buildings.
  void fill_terrain() {
    const auto has_surface = [&](std::size_t cell) { return !std::isnan(surface_.values[cell]); };
    const std::vector<std::size_t> filled = fill_holes(terrain_, has_surface);
    // No land is above the surface: water, pits.
    for (const std::size_t cell : filled)
      terrain_.values[cell] = std::min(terrain_.values[cell], surface_.values[cell]);
    faces_.notes().count(
        "cells without data in the terrain raster are filled from what is about them",
        filled.size());
    std::size_t bare = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell)
      if (has_surface(cell) && std::isnan(terrain_.values[cell])) ++bare;
    faces_.notes().warn(
        "cells have a surface but no terrain below or about them: they are left out, and so is "
        "what stands there",
        bare);
  }

  void find_buildings() {
    buildings_.top.assign(cell_count(), nothing);
    const double least = files_.least_height_m / unit_m_;
    std::size_t unknown = 0, known = 0, sunken = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      const double height = surface_.values[cell] - terrain_.values[cell];
      if (std::isnan(surface_.values[cell]) && !std::isnan(terrain_.values[cell])) ++unknown;
      if (height >= least) buildings_.top[cell] = surface_.values[cell];
      known += !std::isnan(height);
      sunken += height <= -least;
    }
    constexpr std::size_t hardly_pits = 20;  // from one cell in so many on
    const std::string below = fmt::format(
        "cells have a surface that lies {:g} m or more below the terrain, and are bare "
        "land at its height",
        files_.least_height_m);
    if (sunken * hardly_pits < known)
      faces_.notes().count(below, sunken);
    else
      faces_.notes().warn(
          below + "; are the two rasters the wrong way round, or one of heights above the ground?",
          sunken);
    faces_.notes().count("cells without data in the surface raster are taken for bare land",
                         unknown);
  }

  /// Land at the corners of cells: the mean around it, never above a roof that stands there.
  void find_land() {
    land_.assign((surface_.columns + 1) * (surface_.rows + 1), 0);
    std::vector<double> roof(land_.size(), std::numeric_limits<double>::infinity());
    std::vector<int> count(land_.size(), 0);
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      if (std::isnan(terrain_.values[cell])) continue;
      for (int k = 0; k < 4; ++k) {
        const auto corner = corner_index(corner_of(cell, k));
        land_[corner] += terrain_.values[cell];
        ++count[corner];
        if (buildings_.has(cell)) roof[corner] = std::min(roof[corner], buildings_.top[cell]);
      }
    }
    std::size_t lowered = 0;
    for (std::size_t corner = 0; corner < land_.size(); ++corner) {
      if (count[corner] == 0) continue;
      land_[corner] /= count[corner];
      if (land_[corner] <= roof[corner]) continue;
      land_[corner] = roof[corner];
      ++lowered;
    }
    faces_.notes().count("corners of cells are lowered to the roof beside them", lowered);
  }

  void find_crowns() {
    crowns_.top.assign(cell_count(), nothing);
    crowns_.bottom.assign(cell_count(), nothing);
    constexpr double tallest_tree_m = 120;
    std::size_t hidden = 0, too_high = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      const double height = canopy_.values[cell];
      if (!(height > 0) || std::isnan(terrain_.values[cell])) continue;
      too_high += height * unit_m_ > tallest_tree_m;
      const double top = terrain_.values[cell] + height;
      double bottom = terrain_.values[cell] + files_.trunk_share * height;
      if (buildings_.has(cell)) bottom = std::max(bottom, buildings_.top[cell]);
      if (bottom >= top) {
        ++hidden;
        continue;
      }
      crowns_.top[cell] = top;
      crowns_.bottom[cell] = bottom;
    }
    faces_.notes().count("cells of the canopy lie inside of buildings and are left out", hidden);
    faces_.notes().warn(
        fmt::format("cells of the canopy have crowns of more than {:g} m; its values are heights "
                    "above the ground",
                    tallest_tree_m),
        too_high);
  }

  Corner corner_of(std::size_t cell, int k) const {
    const auto& [column, row] = ring_[static_cast<std::size_t>(k % 4)];
    return {cell % surface_.columns + column, cell / surface_.columns + row};
  }

  double bottom_at(const BlockColumns& columns, std::size_t cell, std::size_t corner) const {
    return columns.bottom.empty() ? land_[corner] : columns.bottom[cell];
  }

  std::int32_t vertex(Corner corner, double height) {
    const auto [entry, is_new] = vertices_.try_emplace(
        {corner_index(corner), height}, static_cast<std::int32_t>(faces_.vertex_count()));
    if (is_new && !faces_.add_vertex(surface_.place(static_cast<double>(corner.column),
                                                    static_cast<double>(corner.row), height)))
      throw InputError({files_.surface}, "lies beyond all coordinates on Earth", "",
                       "is unit_m right?");
    return entry->second;
  }

  /// A face through corners of the land, divided along the diagonal that climbs less.
  template <class Height>
  void add_sloping(std::size_t cell, const Height& height, bool looks_up) {
    std::array<std::int32_t, 4> v{};
    std::array<double, 4> z{};
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::size_t>(k);
      z[i] = height(corner_index(corner_of(cell, k)));
      v[i] = vertex(corner_of(cell, k), z[i]);
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const auto corner : looks_up ? std::array{a, b, c} : std::array{a, c, b})
        faces_.add_corner(v[corner]);
      faces_.end_face();
    };
    if (std::abs(z[0] - z[2]) <= std::abs(z[1] - z[3])) {
      add(0, 1, 2);
      add(0, 2, 3);
    } else {
      add(0, 1, 3);
      add(1, 2, 3);
    }
  }

  void add_land() {
    faces_.use_object("terrain", "TINRelief");
    faces_.use_surface(Surface::ground);
    // Below buildings, too, where it is covered: they may be taken away.
    for (std::size_t cell = 0; cell < cell_count(); ++cell)
      if (!std::isnan(terrain_.values[cell]))
        add_sloping(
            cell, [&](std::size_t corner) { return land_[corner]; }, true);
  }

  /// The cell across the border from corner k to k + 1; none at the rim of the raster.
  std::size_t neighbour(std::size_t cell, int k) const {
    const auto& [c0, r0] = ring_[static_cast<std::size_t>(k)];
    const auto& [c1, r1] = ring_[static_cast<std::size_t>((k + 1) % 4)];
    const std::size_t column = cell % surface_.columns, row = cell / surface_.columns;
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    if (c0 == c1) {
      if (c0 == 0) return column == 0 ? none : cell - 1;
      return column + 1 == surface_.columns ? none : cell + 1;
    }
    if (r0 == 0 && r1 == 0) return row == 0 ? none : cell - surface_.columns;
    return row + 1 == surface_.rows ? none : cell + surface_.columns;
  }

  bool has_neighbour(const BlockColumns& columns, std::size_t other) const {
    return other < cell_count() && columns.has(other);
  }

  void add_bodies(const BlockColumns& columns, const std::string& name, const std::string& kind,
                  const Kinds& kinds) {
    levels_ = levels_of(columns);
    std::vector<bool> is_done(cell_count(), false);
    std::size_t number = 0;
    for (std::size_t first = 0; first < cell_count(); ++first) {
      if (!columns.has(first) || is_done[first]) continue;
      faces_.use_object(fmt::format("{}_{}", name, ++number), kind);
      std::vector<std::size_t> cells{first};
      is_done[first] = true;
      for (std::size_t i = 0; i < cells.size(); ++i)
        for (int k = 0; k < 4; ++k)
          if (const auto other = neighbour(cells[i], k);
              has_neighbour(columns, other) && !is_done[other]) {
            is_done[other] = true;
            cells.push_back(other);
          }
      std::sort(cells.begin(), cells.end());
      for (const auto cell : cells) add_column(columns, cell, kinds);
    }
  }

  /// Heights at which columns around a corner begin and end: vertices of all faces that pass there.
  std::map<std::size_t, std::vector<double>> levels_of(const BlockColumns& columns) const {
    std::map<std::size_t, std::vector<double>> levels;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      if (!columns.has(cell)) continue;
      for (int k = 0; k < 4; ++k) {
        const auto corner = corner_index(corner_of(cell, k));
        levels[corner].push_back(columns.top[cell]);
        levels[corner].push_back(bottom_at(columns, cell, corner));
      }
    }
    for (auto& [corner, heights] : levels) {
      std::sort(heights.begin(), heights.end());
      heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    }
    return levels;
  }

  void add_column(const BlockColumns& columns, std::size_t cell, const Kinds& kinds) {
    const double top = columns.top[cell];
    faces_.use_surface(kinds.top);
    for (int k = 0; k < 4; ++k) faces_.add_corner(vertex(corner_of(cell, k), top));
    faces_.end_face();
    faces_.use_surface(kinds.bottom);
    add_sloping(
        cell, [&](std::size_t corner) { return bottom_at(columns, cell, corner); }, false);
    faces_.use_surface(kinds.side);
    for (int k = 0; k < 4; ++k) add_sides(columns, cell, k);
  }

  /// What the neighbour does not cover of the side from corner k to k + 1.
  void add_sides(const BlockColumns& columns, std::size_t cell, int k) {
    const Corner p = corner_of(cell, k), q = corner_of(cell, k + 1);
    const double top = columns.top[cell];
    const double low_p = bottom_at(columns, cell, corner_index(p));
    const double low_q = bottom_at(columns, cell, corner_index(q));
    const auto other = neighbour(cell, k);
    if (!has_neighbour(columns, other)) return add_side(p, q, {low_p, low_q}, {top, top});
    const double other_top = columns.top[other];
    add_side(p, q, {std::max(low_p, other_top), std::max(low_q, other_top)}, {top, top});
    const double other_p = bottom_at(columns, other, corner_index(p));
    const double other_q = bottom_at(columns, other, corner_index(q));
    add_side(p, q, {low_p, low_q}, {std::min(top, other_p), std::min(top, other_q)});
  }

  /// Heights at p and q.
  using Ends = std::array<double, 2>;

  /// A face from `low` to `high`, unless it is nothing, with a vertex at every level on its way.
  void add_side(Corner p, Corner q, Ends low, Ends high) {
    if (!(high[0] >= low[0] && high[1] >= low[1] && high[0] + high[1] > low[0] + low[1])) return;
    std::vector<std::int32_t> ring{vertex(p, low[0])};
    const auto go_to = [&](Corner corner, double height) {
      const auto v = vertex(corner, height);
      if (v != ring.back()) ring.push_back(v);
    };
    const auto& at_q = levels_.at(corner_index(q));
    const auto& at_p = levels_.at(corner_index(p));
    go_to(q, low[1]);
    for (const double level : at_q)
      if (level > low[1] && level < high[1]) go_to(q, level);
    go_to(q, high[1]);
    go_to(p, high[0]);
    for (auto level = at_p.rbegin(); level != at_p.rend(); ++level)
      if (*level > low[0] && *level < high[0]) go_to(p, *level);
    if (ring.back() == ring.front()) ring.pop_back();
    for (const auto v : ring) faces_.add_corner(v);
    faces_.end_face();
  }

  RasterFiles files_;
  double unit_m_;
  IndexedFaces faces_;
  Raster surface_, terrain_, canopy_;
  std::array<Corner, 4> ring_{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};  ///< of a cell
  BlockColumns buildings_, crowns_;
  std::vector<double> land_;  ///< per corner
  std::map<std::size_t, std::vector<double>> levels_;
  std::map<std::pair<std::size_t, double>, std::int32_t> vertices_;
};

}  // namespace

PolygonModel read_scene_blocks(const RasterFiles& files, const SceneFileRules& rules) {
  PolygonModel model = BlockReader(files, rules).read();
  make_names_plain(model);
  return model;
}

}  // namespace sunload
