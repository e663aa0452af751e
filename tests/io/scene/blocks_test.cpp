// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Rasters of surface, terrain and canopy as blocks: volumes, areas, places.

#include "io/scene/blocks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "geo/mesh/mesh_prepare.h"
#include "io/plan/scene_build.h"
#include "io/scene/raster/raster.h"
#include "tests/support/real_models.h"
#include "tests/support/scene_text.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

constexpr std::size_t columns = 5, rows = 4;
constexpr double cell = 2;

using Value = std::function<double(std::size_t column, std::size_t row)>;

/// Rows from north to south, the south-west corner at (1000, 2000).
std::string grid_text(const Value& value) {
  std::string text = fmt::format(
      "ncols {}\nnrows {}\nxllcorner 1000\nyllcorner 2000\ncellsize {}\nnodata_value -9999\n",
      columns, rows, cell);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      text += fmt::format("{}{}", value(c, r), c + 1 == columns ? "\n" : " ");
  return text;
}

/// Land that falls to the south: corners are means of cells, so the plane goes through them.
double land(std::size_t, std::size_t row) { return 10 - 0.5 * static_cast<double>(row); }

PolygonModel blocks(const Value& surface, const Value& terrain, const Value& canopy = {},
                    RasterFiles files = {}) {
  files.surface = write_text("dsm.asc", grid_text(surface));
  files.terrain = write_text("dem.asc", grid_text(terrain));
  if (canopy) files.canopy = write_text("cdsm.asc", grid_text(canopy));
  return read_scene_blocks(files, {});
}

/// A house of 2 x 2 cells with two heights, and one of a single cell at its corner.
double houses(std::size_t c, std::size_t r) {
  if ((c == 1 || c == 2) && (r == 1 || r == 2)) return c == 1 ? 16 : 20;
  if (c == 3 && r == 3) return 14;
  return land(c, r);
}

TEST(SceneBlocks, VolumesAndAreasAreThoseOfTheCells) {
  const auto model = blocks(houses, land);
  EXPECT_EQ(broken_arrays(model), "");
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"terrain", "building_1", "building_2"}));
  EXPECT_EQ(model.object_kinds, (std::vector<std::string>{"TINRelief", "Building", "Building"}));
  const auto p = prepare(model, {});
  EXPECT_EQ(p.report.closed_bodies, 2u);
  EXPECT_EQ(p.report.nonmanifold_edges, 0u);
  EXPECT_EQ(p.report.triangles_flipped, 0u);
  EXPECT_EQ(p.report.inside_out_bodies, 0u);
  // Inside of the raster the land's corners lie on the plane: 9.75 - 0.5 (r - 0.5) …; the mean of a
  // cell is its own height. At the southern rim corners have only one row: 8.5, not 8.25.
  const double rim = (9 - 0.25 + 8.5) / 2;  // mean height below row 3
  const double volume = cell * cell * ((16 - 9.5) + (16 - 9) + (20 - 9.5) + (20 - 9) + (14 - rim));
  EXPECT_NEAR(p.report.volume_m3, volume, 1e-9 * volume);
  const auto area = [&](Surface s) { return p.report.area_m2[static_cast<std::size_t>(s)]; };
  EXPECT_NEAR(area(Surface::roof), 5 * cell * cell, 1e-9);
  // Walls between cells by their mean heights at the border, here at the corners of the plane.
  const auto corner = [](double row) {
    return row == 0 ? 10 : row == rows ? 8.5 : 10.25 - 0.5 * row;
  };
  const auto beside = [&](double top, double row) {
    return cell * (top - (corner(row) + corner(row + 1)) / 2);
  };
  double walls = 0;
  for (const double row : {1.0, 2.0}) walls += beside(16, row) + beside(20, row) + cell * (20 - 16);
  walls += cell * ((16 - corner(1)) + (16 - corner(3)) + (20 - corner(1)) + (20 - corner(3)));
  walls += 2 * beside(14, 3) + cell * ((14 - corner(3)) + (14 - corner(4)));
  EXPECT_NEAR(area(Surface::wall), walls, 1e-9 * walls);
  const double slope = std::hypot(1, 0.25);  // 0.5 m on 2 m
  // Below buildings, too.
  EXPECT_GT(area(Surface::ground), 20 * cell * cell);
  EXPECT_LT(area(Surface::ground), 20 * cell * cell * slope + 1e-9);
  EXPECT_EQ(area(Surface::other), 0);
}

TEST(SceneBlocks, CellsAreAreas) {
  const auto model = blocks(houses, land);
  const auto box = bounding_box(model.vertices);
  EXPECT_EQ(box.low.x, 1000);
  EXPECT_EQ(box.low.y, 2000);
  EXPECT_EQ(box.high.x, 1000 + columns * cell);
  EXPECT_EQ(box.high.y, 2000 + rows * cell);
  EXPECT_EQ(box.high.z, 20);
  // Row 1 is the second from the north.
  Vec3 low{1e9, 1e9, 0}, high{-1e9, -1e9, 0};
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    if (model.object_names[model.facts[p].object.index()] != "building_1") continue;
    for (std::int64_t k = 0; k < ring_size(model, p, 0); ++k) {
      const Vec3 v = corner(model, p, 0, k);
      low = {std::min(low.x, v.x), std::min(low.y, v.y), 0};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), 0};
    }
  }
  EXPECT_EQ(low, (Vec3{1002, 2002, 0}));
  EXPECT_EQ(high, (Vec3{1006, 2006, 0}));
}

TEST(SceneBlocks, LowThingsAreLand) {
  const auto low = [](std::size_t c, std::size_t r) { return land(c, r) + (c == 2 ? 1.9 : 0); };
  EXPECT_EQ(blocks(low, land).object_names.size(), 1u);
  RasterFiles files;
  files.least_height_m = 1.5;
  EXPECT_EQ(blocks(low, land, {}, files).object_names.size(), 2u);
}

TEST(SceneBlocks, ASurfaceBelowTheTerrainIsTold) {
  const auto pit = [](std::size_t c, std::size_t r) {
    return land(c, r) - (c == 2 && r == 2 ? 1.9 : 0);
  };
  EXPECT_TRUE(blocks(pit, land).warnings.empty());
  const auto swapped = blocks(land, houses);
  ASSERT_EQ(swapped.warnings.size(), 1u);
  EXPECT_NE(swapped.warnings[0].find("5 cells have a surface that lies 2 m or more below"),
            std::string::npos);
  EXPECT_EQ(swapped.object_names.size(), 1u);
}

TEST(SceneBlocks, HeightsOfCrownsAboveTheSeaAreTold) {
  for (const double foot : {0.0, 300.0}) {
    const auto crown = [&](std::size_t c, std::size_t r) { return c == 4 && r < 2 ? foot + 9 : 0; };
    EXPECT_EQ(blocks(houses, land, crown).warnings.size(), foot > 0 ? 1u : 0u);
  }
}

TEST(SceneBlocks, MissingCellsAreLeftOut) {
  const auto surface = [](std::size_t c, std::size_t r) {
    return c == 1 && r == 1 ? -9999 : houses(c, r);
  };
  const auto terrain = [](std::size_t c, std::size_t r) { return c == 4 ? -9999 : land(c, r); };
  const auto model = blocks(surface, terrain);
  EXPECT_TRUE(has_note(model, "5 cells of the raster have no data"));  // of both together
  EXPECT_TRUE(
      has_note(model, "1 cells without data in the surface raster are taken for bare land"));
  EXPECT_EQ(bounding_box(model.vertices).high.x, 1000 + 4 * cell);
  EXPECT_EQ(prepare(model, {}).report.closed_bodies, 2u);
}

/// As in terrain models from which buildings were taken out.
TEST(SceneBlocks, BuildingsStandWhereTheTerrainHasHoles) {
  const auto is_house = [](std::size_t c, std::size_t r) {
    return (c == 1 || c == 2) && (r == 1 || r == 2);
  };
  const auto holed = [&](std::size_t c, std::size_t r) {
    return is_house(c, r) ? -9999 : land(c, r);
  };
  const auto model = blocks(houses, holed), whole = blocks(houses, land);
  EXPECT_TRUE(has_note(model, "4 cells without data in the terrain raster are filled"));
  EXPECT_TRUE(model.warnings.empty());
  const auto report = prepare(model, {}).report;
  EXPECT_EQ(report.closed_bodies, 2u);
  EXPECT_NEAR(report.volume_m3, prepare(whole, {}).report.volume_m3, 1e-9);  // the land is a plane
  // One cell of a house alone.
  const auto one = [&](std::size_t c, std::size_t r) {
    return c == 1 && r == 1 ? -9999 : land(c, r);
  };
  EXPECT_NEAR(prepare(blocks(houses, one), {}).report.volume_m3, report.volume_m3, 1e-9);
  // Beyond the rim of the terrain nothing is made up.
  const auto western = [](std::size_t c, std::size_t r) { return c >= 3 ? -9999 : land(c, r); };
  const auto cut = blocks(houses, western);
  EXPECT_TRUE(has_note(cut, "8 cells of the raster have no data"));
  ASSERT_EQ(cut.warnings.size(), 1u);
  EXPECT_NE(cut.warnings[0].find("8 cells have a surface but no terrain below or about them"),
            std::string::npos);
}

TEST(SceneBlocks, CrownsStandOnTrunks) {
  const auto canopy = [](std::size_t c, std::size_t r) {
    if (c == 0 && r == 0) return 8.0;
    if (c == 1 && r == 0) return 4.0;
    return c == 2 && r == 1 ? 5.0 : 0.0;  // hidden in the house
  };
  const auto model = blocks(houses, land, canopy);
  EXPECT_TRUE(has_note(model, "1 cells of the canopy lie inside of buildings"));
  ASSERT_EQ(model.object_names.size(), 4u);
  EXPECT_EQ(model.object_names[3], "crown_1");
  const auto p = prepare(model, {});
  EXPECT_EQ(p.report.closed_bodies, 3u);
  double volume = 0, area = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (p.mesh.object_names[p.mesh.triangle_object[t].index()] != "crown_1") continue;
    EXPECT_EQ(p.mesh.triangle_surface[t], Surface::other);
    volume += dot(p.mesh.corner(t, 0), p.mesh.area_vector2(t)) / 6;
    area += p.mesh.area_m2(t);
  }
  // From 12 to 18 and from 11 to 14: 2 m of the border are shared.
  EXPECT_NEAR(volume, cell * cell * (6 + 3), 1e-9 * 36);
  EXPECT_NEAR(area, 4 * cell * cell + 4 * cell * (6 + 3) - 2 * cell * 2, 1e-9 * 100);
  EXPECT_EQ(p.report.area_m2[static_cast<std::size_t>(Surface::other)], area);
}

TEST(SceneBlocks, CrownsAreOfTheTablesMaterial) {
  const WorkFolder folder;
  folder.write("dsm.asc", grid_text(houses));
  folder.write("dem.asc", grid_text(land));
  folder.write("cdsm.asc",
               grid_text([](std::size_t c, std::size_t) { return c == 0 ? 8.0 : 0.0; }));
  const auto built = [&](const std::string& more) {
    return build_scene(
        read_study(
            folder.write("s.yaml",
                         "format: sunload-study-1\nname: s\n"
                         "site: {latitude_deg: 57.7, longitude_deg: 12, timezone: UTC}\n"
                         "period: {days: [2026-03-21]}\nscene: {files: [{file: dsm.asc, terrain: "
                         "dem.asc, canopy: cdsm.asc" +
                             more + "}\n"))
            .variants.front());
  };
  const auto material = [](const BuiltScene& b, const std::string& name) {
    for (const auto& m : b.scene.materials)
      if (m.name == name) return m;
    return Material{};
  };
  const auto plain = built("}], assign: [{type: Building, material: brick}]");
  EXPECT_NEAR(material(plain, "crown").transmittance, 0.173, 1e-12);
  EXPECT_EQ(material(plain, "brick").diffuse, 0.3);
  const auto own =
      built(", material: asphalt}], materials: {crown: {diffuse: 0.2, transmittance: 0.5}}");
  EXPECT_EQ(material(own, "crown").transmittance, 0.5);
  EXPECT_EQ(material(own, "asphalt").diffuse, 0.125);
  EXPECT_EQ(own.scene.materials.size(), 2u);
}

TEST(SceneBlocks, OtherGridsAreRefused) {
  const auto surface = write_text("dsm.asc", grid_text(houses));
  auto moved = grid_text(land);
  moved.replace(moved.find("1000"), 4, "1001");
  auto shorter = grid_text(land);
  shorter.replace(shorter.find("nrows 4"), 7, "nrows 3");
  for (const auto& [text, part] :
       {std::pair{moved, "lies on another grid"}, {shorter, "has 5 × 3 cells"}}) {
    try {
      read_scene_blocks({.surface = surface, .terrain = write_text("dem.asc", text), .canopy = ""},
                        {});
      ADD_FAILURE() << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

/// Sites of the SOLWEIG measurements: volumes cell by cell, from the rasters alone.
void expect_site(const std::string& folder, const RasterFiles& files) {
  NoteCounter notes;
  const auto surface = read_raster(files.surface, 1, RasterValues::elevations, notes);
  const auto terrain = read_raster(files.terrain, 1, RasterValues::elevations, notes);
  const auto model = read_scene_blocks(files, {});
  EXPECT_EQ(broken_arrays(model), "") << folder;
  const auto p = prepare(model, {});
  const double area = std::abs(surface.file_from_cell[1] * surface.file_from_cell[5]);
  const auto at = [&](std::size_t c, std::size_t r) {  // mean of the land at a corner
    double sum = 0, roof = 1e9;
    int n = 0;
    for (const std::size_t i : {c, c + 1})
      for (const std::size_t j : {r, r + 1}) {
        if (i < 1 || j < 1 || i > surface.columns || j > surface.rows) continue;
        sum += terrain.at(i - 1, j - 1);
        ++n;
        if (surface.at(i - 1, j - 1) - terrain.at(i - 1, j - 1) >= files.least_height_m)
          roof = std::min(roof, surface.at(i - 1, j - 1));
      }
    return std::min(sum / n, roof);
  };
  const auto canopy = read_raster(files.canopy, 1, RasterValues::heights, notes);
  double volume = 0, roofs = 0, crowns = 0;
  for (std::size_t r = 0; r < surface.rows; ++r)
    for (std::size_t c = 0; c < surface.columns; ++c) {
      if (const double height = canopy.at(c, r); height > 0) {
        const bool is_built = surface.at(c, r) - terrain.at(c, r) >= files.least_height_m;
        const double trunk = std::max(files.trunk_share * height,
                                      is_built ? surface.at(c, r) - terrain.at(c, r) : 0.0);
        crowns += area * std::max(0.0, height - trunk);
      }
      if (surface.at(c, r) - terrain.at(c, r) < files.least_height_m) continue;
      roofs += area;
      // Of two triangles along the diagonal that climbs less.
      const double nw = at(c, r), sw = at(c, r + 1), se = at(c + 1, r + 1), ne = at(c + 1, r);
      const double floor = std::abs(nw - se) <= std::abs(sw - ne)
                               ? ((nw + sw + se) + (nw + se + ne)) / 6
                               : ((nw + sw + ne) + (sw + se + ne)) / 6;
      volume += area * (surface.at(c, r) - floor);
    }
  const auto found = [&](Surface s) { return p.report.area_m2[static_cast<std::size_t>(s)]; };
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(found(Surface::roof), roofs, 1e-6 * roofs) << folder;
  const auto count = [&](const std::string& kind) {
    return std::count(model.object_kinds.begin(), model.object_kinds.end(), kind);
  };
  // Two cells of a crown may meet at no height, and are two bodies then.
  EXPECT_GE(p.report.closed_bodies,
            static_cast<std::size_t>(count("Building") + count("SolitaryVegetationObject")));
  // Of closed bodies alone: so all of them are closed.
  EXPECT_NEAR(p.report.volume_m3, volume + crowns, 1e-6 * volume) << folder;
  double buildings = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
    if (p.mesh.object_kinds[p.mesh.triangle_object[t].index()] == "Building")
      buildings += dot(p.mesh.corner(t, 0), p.mesh.area_vector2(t)) / 6;
  EXPECT_NEAR(buildings, volume, 1e-6 * volume) << folder;
  std::cout << folder << ": " << count("Building") << " buildings of " << volume << " m3, "
            << count("SolitaryVegetationObject") << " crowns, " << p.mesh.triangle_count()
            << " triangles" << std::endl;
}

TEST(SceneBlocks, GothenburgsSites) {
  SUNLOAD_NEEDS_MODEL("data/studies");
  const std::string ga = shared_path("data/studies/gothenburg_gustav_adolfs/");
  expect_site(
      "gothenburg_gustav_adolfs",
      {.surface = ga + "DSM_GA.tif", .terrain = ga + "DEM_GA.tif", .canopy = ga + "CDSM_GA.tif"});
  const std::string kr = shared_path("data/studies/gothenburg_kronenhuset/");
  expect_site(
      "gothenburg_kronenhuset",
      {.surface = kr + "DSM_KR.tif", .terrain = kr + "DEM_KR.tif", .canopy = kr + "CDSM_KR.asc"});
}

}  // namespace
}  // namespace sunload::test
