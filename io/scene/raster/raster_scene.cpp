// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/raster_scene.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "io/scene/base/indexed_faces.h"
#include "io/scene/raster/raster.h"

namespace sunload {

namespace {

class TerrainReader {
 public:
  TerrainReader(const std::string& path, const SceneFileRules& rules)
      : path_(path),
        faces_(path, rules, 'z'),
        raster_(read_raster(path, rules.unit_m, RasterValues::elevations, faces_.notes())) {
    faces_.use_object(std::filesystem::path(path).stem().string(), "TINRelief");
  }

  PolygonModel read() {
    add_vertices();
    add_triangles();
    auto model = faces_.finish();
    model.crs = raster_.crs;
    return model;
  }

 private:
  void add_vertices() {
    const auto& heights = raster_.values;
    faces_.expect(heights.size(), 2 * heights.size());
    for (std::size_t cell = 0; cell < heights.size(); ++cell) {
      const double column = static_cast<double>(cell % raster_.columns) + 0.5;
      const double row = static_cast<double>(cell / raster_.columns) + 0.5;
      // Cells without data make no face, so that their vertex is left out.
      const double height = std::isnan(heights[cell]) ? 0 : heights[cell];
      if (!faces_.add_vertex(raster_.place(column, row, height)))
        throw InputError({path_}, "lies beyond all coordinates on Earth", "", "is unit_m right?");
    }
  }

  void add_triangles() {
    const auto& heights = raster_.values;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (std::isnan(heights[a] + heights[b] + heights[c])) return;
      if (raster_.rows_go_north()) std::swap(b, c);
      for (const auto corner : {a, b, c}) faces_.add_corner(static_cast<std::int32_t>(corner));
      faces_.end_face();
    };
    for (std::size_t row = 0; row + 1 < raster_.rows; ++row) {
      for (std::size_t column = 0; column + 1 < raster_.columns; ++column) {
        // Counter-clockwise seen from above, where rows go south.
        const auto a = row * raster_.columns + column, b = a + raster_.columns, c = b + 1,
                   d = a + 1;
        const double climb_ac = std::abs(heights[a] - heights[c]);
        const double climb_bd = std::abs(heights[b] - heights[d]);
        // A comparison with NaN is false: the diagonal between two cells with data is taken.
        const bool along_ac = !std::isnan(climb_ac) && !(climb_bd < climb_ac);
        if (along_ac) {
          add(a, b, c);
          add(a, c, d);
        } else {
          add(a, b, d);
          add(b, c, d);
        }
      }
    }
  }

  std::string path_;
  IndexedFaces faces_;
  Raster raster_;
};

}  // namespace

PolygonModel read_scene_raster(const std::string& path, const SceneFileRules& rules) {
  return TerrainReader(path, rules).read();
}

}  // namespace sunload
