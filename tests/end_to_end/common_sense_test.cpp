// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What everybody knows about sun and shadow holds in whole runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "io/result/reader.h"
#include "io/result/shown_quantity.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// What tests look at, patch by patch.
struct Patches {
  std::vector<double> area, x, y, z, normal_x, normal_y, normal_z;
  std::vector<std::string> object, material;
  explicit Patches(const ResultReader& result) : area(result.doubles("patch_area")) {
    const auto centroid = result.doubles("patch_centroid"), normal = result.doubles("patch_normal");
    const auto objects = result.strings("object_name"), materials = result.strings("material_name");
    const auto object_of = result.integers("patch_object"),
               material_of = result.integers("patch_material");
    for (std::size_t i = 0; i < area.size(); ++i) {
      x.push_back(centroid[3 * i]);
      y.push_back(centroid[3 * i + 1]);
      z.push_back(centroid[3 * i + 2]);
      normal_x.push_back(normal[3 * i]);
      normal_y.push_back(normal[3 * i + 1]);
      normal_z.push_back(normal[3 * i + 2]);
      object.push_back(objects[static_cast<std::size_t>(object_of[i])]);
      material.push_back(materials[static_cast<std::size_t>(material_of[i])]);
    }
  }
  /// Area-weighted mean over the chosen patches.
  template <class Chosen>
  double mean(const std::vector<double>& values, Chosen&& chosen) const {
    double sum = 0, of = 0;
    for (std::size_t i = 0; i < area.size(); ++i) {
      if (!chosen(i)) continue;
      sum += area[i] * values[i];
      of += area[i];
    }
    EXPECT_GT(of, 0) << "no patch was chosen";
    return sum / of;
  }
};

TEST(CommonSense, StreetInTheSun) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  ASSERT_EQ(program(folder, {"run", "street.yaml"}).code, 0);
  const std::string path = folder / "results/street/baseline.h5";
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
  const ResultReader result(path);
  const Patches patches(result);

  // A clear noon of March at 50° north, 310 m: some 900 W/m² of direct light.
  const auto dni = result.doubles("dni");
  EXPECT_GT(*std::max_element(dni.begin(), dni.end()), 800);
  EXPECT_LT(*std::max_element(dni.begin(), dni.end()), 950);

  // Walls that look south get more than those that look north.
  const auto load = result.doubles("light_load");
  const auto south = [&](std::size_t i) { return patches.normal_y[i] < -0.99; };
  const auto north = [&](std::size_t i) { return patches.normal_y[i] > 0.99; };
  EXPECT_GT(patches.mean(load, south), 2 * patches.mean(load, north));
  EXPECT_EQ(patches.mean(result.doubles("light_load_direct"), north), 0);

  // Roofs see more of the sky than walls.
  const auto sky = result.doubles("sky_view_factor");
  EXPECT_GT(patches.mean(sky, [&](std::size_t i) { return patches.normal_z[i] > 0.6; }),
            patches.mean(sky, [&](std::size_t i) { return std::abs(patches.normal_z[i]) < 0.1; }));
  EXPECT_LE(*std::max_element(sky.begin(), sky.end()), 1);
}

TEST(CommonSense, ShadowOfABoxLiesNorthOfIt) {
  const WorkFolder folder;
  folder.write("box.yaml",
               "format: sunload-study-1\n"
               "name: box\n"
               "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
               "period: {days: [2026-03-21], from: \"09:00\", to: \"15:00\", step_min: 60}\n"
               "scene: {builtin: {name: box_on_plane}}\n"  // 10 m × 10 m × 10 m at the origin
               "mesh: {max_edge_m: 2}\n"
               "solver: {lines_per_patch: 64, realizations: 16}\n");
  ASSERT_EQ(program(folder, {"run", "box.yaml"}).code, 0);
  const std::string path = folder / "results/box/baseline.h5";
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
  const ResultReader result(path);
  const Patches patches(result);
  const auto beside = [&](double from_y, double to_y) {
    return [&patches, from_y, to_y](std::size_t i) {
      return patches.normal_z[i] > 0.9 && patches.z[i] < 1 && std::abs(patches.x[i]) < 5 &&
             patches.y[i] > from_y && patches.y[i] < to_y;
    };
  };
  for (const char* quantity : {"light_load", "light_load_direct", "sun_hours"}) {
    const auto values = result.doubles(quantity);
    EXPECT_LT(patches.mean(values, beside(5, 12)), 0.5 * patches.mean(values, beside(-12, -5)))
        << quantity;
  }
  // South of the box the sun shines all the time.
  EXPECT_NEAR(patches.mean(result.doubles("sun_hours"), beside(-20, -8)), 6, 1e-6);
}

TEST(CommonSense, BlackSurfacesReceiveAndSendNothing) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  std::string study = square_study();
  study.replace(study.find("plaster: {diffuse: 0.6}"), 23, "plaster: {diffuse: 0.0}");
  folder.write("square.yaml", study);
  ASSERT_EQ(program(folder, {"run", "square.yaml"}).code, 0);
  const std::string path = folder / "results/square/baseline.h5";
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
  const ResultReader result(path);
  const Patches patches(result);
  const auto load = result.doubles("light_load"), power = result.doubles("power_load");
  const auto of = [&](const char* material) {
    return [&patches, material](std::size_t i) { return patches.material[i] == material; };
  };
  EXPECT_EQ(patches.mean(power, of("plaster")), 0);
  EXPECT_GT(patches.mean(load, of("plaster")), 0);
  EXPECT_NEAR(patches.mean(power, of("paving")), 0.3 * patches.mean(load, of("paving")), 1e-5);
  // A lamp of 200 W/m² in 12 h, and what it reflects.
  EXPECT_NEAR(patches.mean(power, of("lamp")), 2.4 + 0.1 * patches.mean(load, of("lamp")), 1e-5);
  // Whatever the light, diffuse light leaves in equal radiance: (rho E + M) / π.
  const auto noon = shown_quantity(result, "radiance", "2026-03-21T12:30");
  const auto irradiance = shown_quantity(result, "irradiance", "2026-03-21T12:30").values;
  const auto mean = shown_quantity(result, "radiance", "").values;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const bool is_paving = patches.material[i] == "paving";
    if (!is_paving && patches.material[i] != "lamp") continue;
    const double sent = is_paving ? 0.3 * irradiance[i] : 0.1 * irradiance[i] + 200;
    EXPECT_NEAR(noon.values[i], sent / pi, 1e-6 * sent);
    EXPECT_NEAR(mean[i], 1000 * power[i] / 12 / pi, 1e-6 * mean[i]);
  }
  // The mirror throws light on the ground south of the house, and nowhere behind it.
  const auto mirrored = result.doubles("light_load_mirror");
  const auto ground = [&](double from_y, double to_y) {
    return [&patches, from_y, to_y](std::size_t i) {
      return patches.material[i] == "paving" && std::abs(patches.x[i]) < 4 &&
             patches.y[i] > from_y && patches.y[i] < to_y;
    };
  };
  EXPECT_GT(patches.mean(mirrored, ground(-1, 3)), 0.1);
  EXPECT_EQ(patches.mean(mirrored, ground(10, 15)), 0);
  // Both sides of the awning are there: the upper one sees the sky.
  const auto side = result.integers("patch_side");
  const auto sky = result.doubles("sky_view_factor");
  const auto awning = [&](int of_side) {
    return [&, of_side](std::size_t i) {
      return patches.material[i] == "canvas" && side[i] == of_side;
    };
  };
  EXPECT_GT(patches.mean(sky, awning(0)), 0.5);
  EXPECT_LT(patches.mean(sky, awning(1)), 0.1);
}

/// The ledger of the demonstration, as it is shipped.
TEST(CommonSense, EnergyOfTheStreetDemonstration) {
  const WorkFolder folder;
  const Ran ran = program(folder, {"run", test::source_folder() + "/configs/street.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  for (const char* variant : {"baseline", "glazed"}) {
    const std::string path = folder / fmt::format("results/street/{}.h5", variant);
    EXPECT_EQ(ledger_problem(path), "");
    EXPECT_EQ(sums_problem(path), "");
    const Energy energy = energy_of(path);
    std::printf("%s: in %.6g kWh, residual %.3g +- %.2g kWh (%.2g %%)\n", variant, energy.in,
                energy.residual, energy.residual_se, 100 * energy.residual / energy.in);
    constexpr double largest_share = 0.002;  // promised for 60 000 leaves at 256 lines
    EXPECT_LE(std::abs(energy.residual), largest_share * energy.in);
  }
}

/// An OBJ of boxes, whose faces are those of `skipped` left out (bottom, top, south, east, north,
/// west). Corners are written anew for each box.
struct ObjBox {
  double x0, y0, z0, x1, y1, z1;
  std::vector<int> skipped;
};
std::string obj_of(const std::vector<ObjBox>& boxes, bool are_objects) {
  constexpr int corners[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5},
                                 {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
  std::string text = "o house\n";
  std::size_t number = 0;
  for (const ObjBox& b : boxes) {
    if (are_objects) text += fmt::format("o part_{}\n", number);
    for (const double z : {b.z0, b.z1})
      for (const auto& [x, y] : {std::pair{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}})
        text += fmt::format("v {} {} {}\n", x, y, z);
    for (int f = 0; f < 6; ++f) {
      if (std::ranges::find(b.skipped, f) != b.skipped.end()) continue;
      text += "f";
      for (const int c : corners[f]) text += fmt::format(" {}", c + 8 * static_cast<int>(number));
      text += "\n";
    }
    ++number;
  }
  return text;
}

Ran run_on_meadow(const WorkFolder& folder, const std::string& name, const std::string& obj) {
  folder.write(name + ".obj", obj);
  folder.write(name + ".yaml",
               "format: sunload-study-1\n"
               "name: " +
                   name +
                   "\n"
                   "site: {latitude_deg: 50, longitude_deg: 14, timezone: \"+01:00\"}\n"
                   "period: {days: [2026-03-21], step_min: 120}\n"
                   "light: {source: clear_sky}\n"
                   "scene: {files: [" +
                   name +
                   ".obj], ground: {surface: level, height_m: 0, margin_m: "
                   "20, material: stone}, materials: {stone: {diffuse: 0.2}}, assign: [{material: "
                   "stone}]}\n"
                   "mesh: {oracle: none, max_edge_m: 3}\n"
                   "solver: {lines_per_patch: 64}\n");
  return program(folder, {"run", name + ".yaml"});
}

TEST(CommonSense, SlabsBetweenStoreysChangeNothing) {
  const WorkFolder folder;
  const Ran whole = run_on_meadow(folder, "whole", obj_of({{0, 0, 0, 8, 6, 9, {}}}, false));
  const Ran storeys = run_on_meadow(
      folder, "storeys",
      obj_of({{0, 0, 0, 8, 6, 3, {}}, {0, 0, 3, 8, 6, 6, {0}}, {0, 0, 6, 8, 6, 9, {0}}}, false));
  ASSERT_EQ(whole.code + storeys.code, 0) << whole.err << storeys.err;
  const auto mean = [&](const char* study) {
    const ResultReader result(folder / (std::string("results/") + study + "/baseline.h5"));
    const auto area = result.doubles("patch_area"), load = result.doubles("light_load");
    const auto surface = result.integers("patch_surface");
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < area.size(); ++i) {
      if (static_cast<Surface>(surface[i]) == Surface::ground) continue;
      sum += area[i] * load[i];
      all += area[i];
    }
    return std::pair{sum / all, all};
  };
  const auto [load, area] = mean("whole");
  const auto [of_storeys, area_of_storeys] = mean("storeys");
  EXPECT_NEAR(area_of_storeys, area, 1e-6 * area);
  EXPECT_NEAR(of_storeys, load, 0.02 * load);  // 64 lines, on patches of other shapes
}

TEST(CommonSense, FacesWithinHousesThatAreNotClosedAreTold) {
  // Walls and slabs as solids of their own, as building models are exported.
  const WorkFolder folder;
  const Ran parts = run_on_meadow(folder, "parts",
                                  obj_of({{0, 0, 0, 8, 6, 0.3, {}},
                                          {0, 0, 0.3, 8, 0.3, 3, {}},
                                          {0, 5.7, 0.3, 8, 6, 3, {}},
                                          {0, 0.3, 0.3, 0.3, 5.7, 3, {}},
                                          {7.7, 0.3, 0.3, 8, 5.7, 3, {}},
                                          {0, 0, 3, 8, 6, 3.3, {}}},
                                         true));
  ASSERT_EQ(parts.code, 0) << parts.err;
  EXPECT_NE(parts.err.find("get no light at all"), std::string::npos) << parts.err;
  const Ran whole = run_on_meadow(folder, "whole", obj_of({{0, 0, 0, 8, 6, 9, {}}}, false));
  EXPECT_EQ(whole.err.find("get no light at all"), std::string::npos) << whole.err;
}

}  // namespace
}  // namespace sunload::test
