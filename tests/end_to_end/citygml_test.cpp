// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A town in CityGML, from the first command to its light.
#include <gtest/gtest.h>

#include <string>

#include "tests/io/scene/citygml/gml_text.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

std::string result_in(const WorkFolder& folder, const std::string& name) {
  for (const auto& file : folder.content(name))
    if (file.ends_with("baseline.h5")) return name + "/" + file;
  return {};
}

TEST(CityGml, GetsAStudyAndTheLightOfTheSameTownInCityJson) {
  const WorkFolder folder;
  const std::string original = source_folder() + std::string("/configs/models/town.city.json");
  folder.write("town.gml", city_gml_of(read_scene_file(original, {}),
                                       "urn:ogc:def:crs,crs:EPSG::25833,crs:EPSG::5783"));
  folder.write("town.city.json", bytes_of(original));
  std::string facades;
  for (const std::string name : {"town.gml", "town.city.json"}) {
    const Ran begun = program(folder, {"init", name, "-o", name + ".yaml"});
    ASSERT_EQ(begun.code, 0) << begun.err;
    const Ran checked = program(folder, {"check", name + ".yaml"});
    ASSERT_EQ(checked.code, 0) << checked.err;
    EXPECT_NE(checked.out.find("position and north from "), std::string::npos) << checked.out;
    folder.write("day.yaml",
                 "format: sunload-study-1\nname: day\nsite: {timezone: Europe/Berlin}\n"
                 "period: {days: [2026-06-21], from: \"10:00\", to: \"12:00\", step_min: 60}\n"
                 "light: {source: clear_sky}\nscene: {files: [" +
                     name +
                     "]}\nmesh: {max_edge_m: 8, oracle: none}\n"
                     "solver: {lines_per_patch: 16, direct_samples: 4, realizations: 2}\n");
    const Ran ran = program(folder, {"run", "day.yaml", "--output", name + "_results"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string result = result_in(folder, name + "_results");
    const Ran told = program(folder, {"info", result, "--facades", "--csv"});
    ASSERT_EQ(told.code, 0) << told.err;
    EXPECT_GT(told.out.size(), 1000u);
    if (facades.empty()) facades = told.out;
    EXPECT_EQ(told.out, facades);
  }
  EXPECT_FALSE(facades.empty());
}

TEST(CityGml, OfAnotherKindIsRefusedByWhatItIs) {
  const WorkFolder folder;
  folder.write("plan.gml", "<kml/>");
  const Ran ran = program(folder, {"init", "plan.gml"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("plan.gml:1:1: is no CityGML (it is KML)"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace sunload::test
