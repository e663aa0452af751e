// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Section `sensors` of a study.
#include <filesystem>
#include <optional>

#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

std::optional<SensorPoint> read_point(YamlMap& map) {
  for (const char* key : {"position_m", "normal"}) map.require(key);
  const auto position = read_vector(map, "position_m"), normal = read_vector(map, "normal");
  if (normal && norm(*normal) < shortest_normal) {
    map.problem("normal", "has no length", "it tells where the sensor looks");
    return {};
  }
  return position && normal ? std::optional(SensorPoint{*position, *normal}) : std::nullopt;
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
