// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A small town as CityJSON whose buildings have parts and installations.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

#include "geo/base/vec.h"

namespace sunload::test {

/// Objects that are boxes, each with the vertices of its own.
class FamilyTown {
 public:
  FamilyTown& add(const std::string& id, const std::string& type, const std::string& family,
                  Vec3 low, Vec3 high) {
    const int first = vertices_;
    for (const double z : {low.z, high.z})
      for (const auto& [x, y] : {std::array{low.x, low.y}, std::array{high.x, low.y},
                                 std::array{high.x, high.y}, std::array{low.x, high.y}}) {
        corners_ += fmt::format("{}[{},{},{}]", vertices_ == 0 ? "" : ",", x, y, z);
        ++vertices_;
      }
    std::string faces;
    for (const auto& face :
         {std::array{3, 2, 1, 0}, std::array{4, 5, 6, 7}, std::array{0, 1, 5, 4},
          std::array{1, 2, 6, 5}, std::array{2, 3, 7, 6}, std::array{3, 0, 4, 7}})
      faces += fmt::format("{}[[{},{},{},{}]]", faces.empty() ? "" : ",", first + face[0],
                           first + face[1], first + face[2], first + face[3]);
    return add_object(
        id, type, family,
        R"("geometry":[{"type":"MultiSurface","lod":"2","boundaries":[)" + faces + "]}]");
  }
  FamilyTown& add_bare(const std::string& id, const std::string& type, const std::string& family) {
    return add_object(id, type, family, "");
  }

  std::string text() const {
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],)"
           R"("translate":[0,0,0]},"CityObjects":{)" +
           objects_ + R"(},"vertices":[)" + corners_ + "]}";
  }

 private:
  FamilyTown& add_object(const std::string& id, const std::string& type, const std::string& family,
                         const std::string& geometry) {
    objects_ += fmt::format(R"({}"{}":{{"type":"{}")", objects_.empty() ? "" : ",", id, type);
    for (const auto& member : {family, geometry})
      if (!member.empty()) objects_ += "," + member;
    objects_ += "}";
    return *this;
  }

  std::string objects_, corners_;
  int vertices_ = 0;
};

/// A house with a dormer on its roof, steps at its foot and a mast along its wall; a hall that is
/// two parts with a chimney on the higher one; a shed; a ruin of which nothing is there. House and
/// shed are a group.
inline std::string family_town() {
  const std::string of_house = R"("parents":["house"])", of_hall = R"("parents":["hall"])";
  return FamilyTown()
      .add("house", "Building", R"("children":["dormer","steps","mast"])", {0, 0, 0}, {10, 10, 6})
      .add("dormer", "BuildingInstallation", of_house, {1, 2, 6}, {3, 4, 7})
      .add("steps", "BuildingInstallation", of_house, {4, -1, 0}, {6, 0, 1})
      .add("mast", "BuildingInstallation", of_house, {8, 10, 3}, {9, 11, 8})
      .add_bare("hall", "Building", R"("children":["hall_low","hall_high","chimney"])")
      .add("hall_low", "BuildingPart", of_hall, {20, 0, 0}, {30, 10, 6})
      .add("hall_high", "BuildingPart", of_hall, {30, 0, 0}, {36, 10, 12})
      .add("chimney", "BuildingInstallation", of_hall, {32, 4, 12}, {33, 5, 14})
      .add("shed", "Building", "", {45, 0, 0}, {50, 5, 3})
      .add_bare("ruin", "Building", "")
      .add_bare("quarter", "CityObjectGroup", R"("children":["house","shed"])")
      .text();
}

}  // namespace sunload::test
