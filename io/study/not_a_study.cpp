// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/not_a_study.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "geo/base/check.h"
#include "io/base/file_text.h"
#include "io/scene/file.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

enum class FileKind { unknown, city, mesh, plan, weather, table, result };

std::string first_bytes(const std::string& path) {
  constexpr std::size_t enough = 64 * 1024;  // CityJSON may name its type behind its metadata
  std::string head(enough, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(enough));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

/// Names of cities tell nothing: studies may be in JSON.
FileKind kind_of_name(const std::string& path) {
  const auto format = scene_format_of_name(path);
  if (!format || format->kind == SceneFileKind::city) return FileKind::unknown;
  return format->kind == SceneFileKind::plan ? FileKind::plan : FileKind::mesh;
}

FileKind kind_of(const std::string& path, std::string_view head) {
  head = without_byte_order_mark(head);
  const auto has = [&](std::string_view text) { return head.find(text) != std::string_view::npos; };
  const std::string ending = lower_extension(path);
  const auto ends_with = [&](std::initializer_list<std::string_view> endings) {
    for (const auto each : endings)
      if (ending == each) return true;
    return false;
  };
  if (head.starts_with("\x89HDF\r\n")) return FileKind::result;
  if (head.starts_with("LOCATION,") || ends_with({".epw", ".wea", ".tm2", ".tmy3"}))
    return FileKind::weather;
  if (head.starts_with('{') && (has("\"CityJSON\"") || has("\"CityJSONFeature\"") ||
                                has("\"CityObjects\"") || ends_with({".jsonl"})))
    return FileKind::city;
  if (head.starts_with('<') && (has(":CityModel") || has("<CityModel") || has("/citygml/")))
    return FileKind::city;
  if (head.starts_with("#VRML") || head.starts_with("glTF") || head.starts_with("ply\n") ||
      head.starts_with("ply\r"))
    return FileKind::mesh;
  if (ends_with({".csv", ".tsv", ".pts"})) return FileKind::table;
  return kind_of_name(path);
}

std::string study_with(const std::string& site, const std::string& light,
                       const std::string& scene) {
  return fmt::format(
      "write a study, for instance with\n"
      "    format: sunload-study-1\n"
      "    name: first\n"
      "    site: {{{}timezone: Europe/Berlin}}\n"
      "    period: {{days: [2026-06-21], step_min: 60}}\n"
      "    light: {{source: {}}}\n"
      "    scene: {{{}}}",
      site, light, scene);
}

}  // namespace

void refuse_other_files(const std::string& path) {
  std::error_code unreadable;
  if (!fs::is_regular_file(path, unreadable)) return;
  const std::string name = fs::path(path).filename().string();
  constexpr const char* place = "latitude_deg: 52.5, longitude_deg: 13.4, ";
  const std::string init = "`sunload init " + name + "` writes one; or ";
  switch (kind_of(path, first_bytes(path))) {
    case FileKind::unknown:
      return;
    case FileKind::city:
      throw InputError({path}, "is a city model, not a study", "a study names its models",
                       init + study_with("", "clear_sky", "files: [" + name + "]"));
    case FileKind::mesh:
      throw InputError(
          {path}, "is a model, not a study", "a study names its models",
          init + study_with(place, "clear_sky", "files: [" + name + "], ground: {margin_m: 50}"));
    case FileKind::plan:
      throw InputError({path}, "is plan data, not a study", "a study names its models",
                       init + study_with("", "clear_sky", "files: [" + name + "]"));
    case FileKind::weather:
      throw InputError({path}, "is a weather file, not a study", "a study names its weather",
                       study_with("", "weather, weather: " + name, "builtin: {name: street}"));
    case FileKind::table:
      throw InputError(
          {path}, "is a table, not a study",
          "a study names weather as light.weather, points as sensors.file, far hills as "
          "site.horizon",
          study_with(place, "clear_sky", "builtin: {name: street}"));
    case FileKind::result:
      throw InputError({path}, "is a file of results, not a study", "",
                       "`sunload info` shows it; the study it came from is in its attributes");
  }
}

}  // namespace sunload
