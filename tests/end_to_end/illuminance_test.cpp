// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A study in lux from its file to its pictures, beside the same one in watts.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "io/result/reader.h"
#include "io/result/shown_quantity.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"

namespace sunload::test {
namespace {

/// An open field whose sky is uniform: no noise but rounding.
std::string field_study(const std::string& name, const std::string& quantity) {
  return "format: sunload-study-1\nname: " + name +
         "\nsite: {latitude_deg: 50, longitude_deg: 14, timezone: UTC}\n"
         "period: {days: [2026-06-21], from: \"06:00\", to: \"16:00\", step_min: 60}\n"
         "light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 120, sky: uniform, quantity: " +
         quantity +
         "}\nscene: {files: [field.obj], materials: {soil: {diffuse: 0.2}}}\n"
         "mesh: {max_edge_m: 4}\n";
}

class Fields : public ::testing::Test {
 protected:
  Fields() {
    folder.write("field.obj",
                 "o field\nusemtl soil\nv 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n");
    for (const char* quantity : {"irradiance", "illuminance"}) {
      const std::string name = std::string("field_") + quantity;
      folder.write(name + ".yaml", field_study(name, quantity));
      const Ran ran = program(folder, {"run", name + ".yaml"});
      EXPECT_EQ(ran.code, 0) << ran.err;
    }
  }
  std::string path(const std::string& quantity) const {
    return "results/field_" + quantity + "/baseline.h5";
  }
  WorkFolder folder;
};

TEST_F(Fields, LevelGroundHasTheGlobalValue) {
  const ResultReader light(folder / path("illuminance")), power(folder / path("irradiance"));
  EXPECT_FALSE(light.has("irradiance"));
  EXPECT_EQ(light.units("illuminance"), "lx");
  EXPECT_EQ(light.units("light_load"), "klx h");
  const auto global = light.doubles("global_horizontal_illuminance");
  const auto beam = light.doubles("direct_normal_illuminance"), dni = power.doubles("dni");
  EXPECT_EQ(light.doubles("dni"), dni);
  EXPECT_EQ(light.doubles("ghi"), power.doubles("ghi"));
  // Series are float: 24 bits.
  constexpr double rounding = 1e-5;
  std::vector<double> load(light.shape("patch_area")[0], 0);
  for (std::size_t t = 0; t < global.size(); ++t) {
    const auto lux = light.row("illuminance", t), direct = light.row("illuminance_direct", t);
    const auto watts = power.row("irradiance_direct", t);
    for (std::size_t i = 0; i < lux.size(); ++i) {
      EXPECT_NEAR(lux[i], global[t], rounding * global[t]);
      EXPECT_NEAR(direct[i] / watts[i], beam[t] / dni[t], rounding * beam[t] / dni[t]);
      load[i] += lux[i] / 1000;  // hours
    }
    // Daylight has some 100 lm/W.
    EXPECT_GT(beam[t] / dni[t], 60);
    EXPECT_LT(beam[t] / dni[t], 140);
  }
  const auto stored = light.doubles("light_load");
  for (std::size_t i = 0; i < load.size(); ++i) EXPECT_NEAR(stored[i], load[i], rounding * load[i]);
  const auto noon = shown_quantity(light, "luminance", "2026-06-21T12:30");
  EXPECT_EQ(noon.units, "cd/m²");
  EXPECT_NEAR(noon.values[0], 0.2 * global[noon.interval] / pi, rounding * global[noon.interval]);
  EXPECT_EQ(light.doubles("sun_hours"), power.doubles("sun_hours"));
}

TEST_F(Fields, ProgramsSayLuxAndDoNotMixThem) {
  const Ran info = program(folder, {"info", path("illuminance")});
  for (const char* words : {"light load, klx h", "illuminance, lx (1)", "light, klm h"})
    EXPECT_NE(info.out.find(words), std::string::npos) << info.out;
  for (const char* words : {"kWh", "W/m²"})
    EXPECT_EQ(info.out.find(words), std::string::npos) << info.out;
  const Ran patches = program(folder, {"info", path("illuminance"), "--patches"});
  EXPECT_NE(patches.out.find("light_load_klx_h"), std::string::npos) << patches.out;
  const Ran mixed = program(folder, {"compare", path("irradiance"), path("illuminance")});
  EXPECT_EQ(mixed.code, 2);
  EXPECT_NE(mixed.err.find("klx h"), std::string::npos) << mixed.err;
  const Ran same = program(folder, {"compare", path("illuminance"), path("illuminance"), "--csv"});
  EXPECT_EQ(
      same.out.substr(0, same.out.find('\n')),
      "group,name,area_m2,base_klx_h,variant_klx_h,difference_klx_h,difference_percent,se_klx_h,"
      "paired,p_value,p_corrected,significant,unmatched_area_m2");
  EXPECT_EQ(program(folder, {"render", path("illuminance"), "--quantity", "illuminance", "--camera",
                             "top", "-o", "a.png"})
                .code,
            0);
  const Ran wrong =
      program(folder, {"render", path("illuminance"), "--quantity", "irradiance", "-o", "b.png"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("illuminance_direct"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace sunload::test
