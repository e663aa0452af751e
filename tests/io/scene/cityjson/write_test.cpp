// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/write.h"

#include <gtest/gtest.h>

#include "tests/support/family_town.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

/// "dormer (BuildingInstallation) of house (Building)".
std::vector<std::string> families_in_words(const PolygonModel& model) {
  const FamilyTree tree(model.object_names, model.object_kinds, model.families);
  std::vector<std::string> words;
  for (std::size_t o = 0; o < tree.object_count(); ++o) {
    const auto owner = tree.owner(o);
    words.push_back(tree.name(o) + " (" + tree.kind(o) + ")" +
                    (owner ? " of " + tree.name(*owner) + " (" + tree.kind(*owner) + ")" : ""));
  }
  return words;
}

TEST(WriteCityJson, KeepsTypesAndFamilies) {
  const auto model = read_text("town.city.json", family_town());
  const auto path = folder_of_test() / "again.city.json";
  write_cityjson(model, path);
  EXPECT_EQ(families_in_words(read_scene_file(path, {})),
            (std::vector<std::string>{
                "chimney (BuildingInstallation) of hall (Building)",
                "dormer (BuildingInstallation) of house (Building)",
                "hall_high (BuildingPart) of hall (Building)",
                "hall_low (BuildingPart) of hall (Building)", "house (Building)",
                "mast (BuildingInstallation) of house (Building)", "shed (Building)",
                "steps (BuildingInstallation) of house (Building)"}));
}

TEST(WriteCityJson, PartsOfNothingAreBuildings) {
  auto model = read_text("town.city.json", family_town());
  model.families = {};
  const auto path = folder_of_test() / "again.city.json";
  write_cityjson(model, path);
  for (const auto& kind : read_scene_file(path, {}).object_kinds)
    EXPECT_TRUE(kind == "Building" || kind == "GenericCityObject") << kind;
}

// A map in US survey feet has coordinates in feet, whoever reads it.
TEST(WriteCityJson, IsInTheUnitOfItsMap) {
  constexpr double foot_m = 1200.0 / 3937;
  auto model = read_text("town.city.json", family_town());
  model.crs = "EPSG:2263";
  const auto path = folder_of_test() / "feet.city.json";
  write_cityjson(model, path, foot_m);
  const auto in_feet = read_scene_file(path, {}),
             again = read_scene_file(path, {0, foot_m, "highest"});
  ASSERT_EQ(again.vertices.size(), model.vertices.size());
  constexpr double rounding_m = 2e-6;
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    EXPECT_LT(norm(again.vertices[v] - model.vertices[v]), rounding_m) << v;
    EXPECT_LT(norm(in_feet.vertices[v] - model.vertices[v] / foot_m), rounding_m / foot_m) << v;
  }
}

}  // namespace
}  // namespace sunload
