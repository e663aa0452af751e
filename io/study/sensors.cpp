// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Section `sensors` of a study.
#include <filesystem>
#include <optional>

#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

constexpr Range tilts_deg{0, 180};

/// `tilt_deg` and `azimuth_deg`, of which one alone is no direction; nothing where none is there.
std::optional<Tilted> read_tilted(YamlMap& map) {
  const auto tilt_deg = map.number("tilt_deg", tilts_deg);
  const auto azimuth_deg = map.number("azimuth_deg", turns_deg);
  if (map.has("tilt_deg") && !map.has("azimuth_deg") && tilt_deg.value_or(1) != 0)
    map.require("azimuth_deg", "a tilted sensor looks somewhere");
  if (map.has("azimuth_deg")) map.require("tilt_deg", "without it the sensor may look up or aside");
  if (!tilt_deg) return {};
  return Tilted{*tilt_deg, azimuth_deg.value_or(0)};
}

std::optional<SensorPoint> read_point(YamlMap& map) {
  map.require("position_m");
  const auto position = read_vector(map, "position_m"), normal = read_vector(map, "normal");
  const auto tilted = read_tilted(map);
  const bool is_tilted = map.has("tilt_deg") || map.has("azimuth_deg");
  if (!is_tilted) map.require("normal", "or tilt_deg and azimuth_deg: where the sensor looks");
  if (is_tilted && map.has("normal"))
    map.problem("normal", "stands beside tilt_deg or azimuth_deg", "they say the same",
                "leave one of them out");
  if (normal && norm(*normal) < shortest_normal) {
    map.problem("normal", "has no length", "it tells where the sensor looks");
    return {};
  }
  if (!position || !(normal || tilted)) return {};
  return SensorPoint{*position, normal.value_or(Vec3{}), tilted};
}

}  // namespace

SensorsStudy read_sensors(YamlMap& map, const std::string& folder) {
  SensorsStudy sensors;
  sensors.where = map.where();
  map.each("points", [&](YamlMap& point) {
    if (const auto sensor = read_point(point)) sensors.points.push_back(*sensor);
  });
  const auto file = map.text("file");
  if (map.has("points") == map.has("file") && map.is_usable())
    map.reading().problem(
        map.where(), file ? "sensors has points and file" : "sensors has neither points nor file",
        "it needs one of the two");
  if (!file || map.has("points")) return sensors;
  try {
    const auto path = (std::filesystem::path(folder) / *file).lexically_normal();
    sensors.points = read_sensor_file(path.string());
  } catch (const InputError& error) {
    add_at(map, "file", map.where("file"), error);
  }
  return sensors;
}

}  // namespace sunload::study_sections
