// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sections `sun` and `light` of a study.
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "io/study/sections.h"
#include "io/study/words.h"

namespace sunload::study_sections {

namespace {

constexpr Range linke_turbidities{1, 20};   // 1: a clean, dry sky; smog reaches some 10
constexpr Range irradiances_w_m2{0, 2000};  // above the sun outside of the atmosphere (1361)
constexpr Range albedos{0, 1};
constexpr Range preetham_turbidities{2, 10};  // Preetham et al. (1999), fitted to 2 … 10
// Above the brightest zenith of any clear sky (a sun overhead in haze) by a factor of some ten.
constexpr Range luminances_cd_m2{0, 1e6, Range::Low::excluded};
constexpr int cie_sky_types = 15;  // ISO 15469:2004, table 1

Turbidity read_turbidity(YamlMap& map) {
  const std::string key = "linke_turbidity";
  Turbidity turbidity;
  if (map.kind(key) != YamlNode::Kind::list) {
    turbidity.monthly.fill(map.number(key, linke_turbidities, turbidity.monthly.front()));
    return turbidity;
  }
  const auto months = map.numbers(key, linke_turbidities);
  const std::size_t written = map.tree(key)->items.size();
  if (written != turbidity.monthly.size()) {
    map.problem(key, "has " + std::to_string(written) + " values",
                "one value, or 12 from January to December");
  } else if (months.size() == written) {
    std::copy(months.begin(), months.end(), turbidity.monthly.begin());
  }
  return turbidity;
}

/// Values that the chosen source or sky does not use.
void warn_unused(YamlMap& map, const LightStudy& light) {
  const auto unused = [&](const char* key, const char* of) {
    if (map.has(key)) map.warn(key, "is not used", std::string("it belongs to ") + of);
  };
  if (light.source != LightSource::fixed) {
    unused("dni_w_m2", "source: fixed");
    unused("dhi_w_m2", "source: fixed");
  }
  if (light.source != LightSource::clear_sky) {
    unused("model", "source: clear_sky");
    unused("linke_turbidity", "source: clear_sky");
  } else if (light.model == ClearSkyModel::haurwitz) {
    unused("linke_turbidity", "model: ineichen or bird");
  }
  if (light.source != LightSource::weather) {
    for (const char* key : {"weather", "stamp", "missing", "decomposition"}) {
      unused(key, "source: weather");
    }
  }
  if (light.sky != SkyModel::cie_general) unused("sky_type", "sky: cie_general");
  if (light.sky_scale != SkyScale::absolute) {
    unused("zenith_luminance_cd_m2", "sky_scale: absolute");
    if (light.sky != SkyModel::preetham) unused("turbidity", "sky: preetham");
  } else {
    if (light.zenith_luminance_cd_m2 && light.sky != SkyModel::preetham)
      unused("turbidity", "skies without zenith_luminance_cd_m2");
    if (light.source == LightSource::fixed) unused("dhi_w_m2", "sky_scale: diffuse");
  }
}

/// Whether the zenith's luminance is known, and nothing else says how bright the sky is.
void expect_absolute(YamlMap& map, const LightStudy& light) {
  if (light.source == LightSource::weather)
    map.problem("sky_scale", "absolute cannot go with source: weather",
                "the weather says how bright the sky is", "write sky_scale: diffuse");
  if (light.sky == SkyModel::perez) {
    map.problem("sky_scale", "absolute cannot go with sky: perez",
                "its shape follows from the diffuse irradiance, which would follow from it",
                "write sky_scale: diffuse, or sky: preetham, cie_clear or cie_general");
    return;
  }
  const bool by_turbidity = light.sky == SkyModel::preetham || light.sky == SkyModel::cie_clear ||
                            light.sky == SkyModel::cie_general;
  if (!by_turbidity && !light.zenith_luminance_cd_m2)
    map.problem("sky_scale", "absolute needs zenith_luminance_cd_m2 here",
                "turbidity tells the zenith's luminance of clear skies only",
                "write zenith_luminance_cd_m2, or sky: preetham, cie_clear or cie_general");
}

/// The weather file and how it is read.
void read_weather(YamlMap& map, const std::string& folder, LightStudy& light) {
  const auto file = map.text("weather");
  if (map.has("stamp")) {
    light.stamp = map.choice("stamp", Stamp::end);
  }
  map.tree("stamp");
  light.missing = map.choice("missing", light.missing);
  light.decomposition = map.choice("decomposition", light.decomposition);
  if (light.source != LightSource::weather) return;
  if (!file) {
    map.problem("source", "weather needs a file", "", "write light.weather: x.epw beside `source`");
    return;
  }
  light.weather = read_path(map, "weather", folder);
}

}  // namespace

bool is_of_weather(YamlMap& map, const std::string& key) {
  return map.kind(key) == YamlNode::Kind::text && map.text(key, "") == "weather";
}

SunStudy read_sun(YamlMap& map) {
  SunStudy sun;
  sun.refraction = map.choice("refraction", sun.refraction);
  sun.ut1_utc = map.choice("ut1_utc", sun.ut1_utc);
  sun.disk = map.choice("disk", sun.disk);
  return sun;
}

LightStudy read_light(YamlMap& map, const std::string& folder) {
  LightStudy light;
  light.source = map.choice("source", light.source);
  light.model = map.choice("model", light.model);
  light.linke_turbidity = read_turbidity(map);
  light.dni_w_m2 = map.number("dni_w_m2", irradiances_w_m2, light.dni_w_m2);
  light.dhi_w_m2 = map.number("dhi_w_m2", irradiances_w_m2, light.dhi_w_m2);
  light.sky = map.choice("sky", light.sky);
  light.sky_type = map.integer("sky_type", 1, cie_sky_types, light.sky_type);
  light.turbidity = map.number("turbidity", preetham_turbidities, light.turbidity);
  light.sky_scale = map.choice("sky_scale", light.sky_scale);
  light.zenith_luminance_cd_m2 = map.number("zenith_luminance_cd_m2", luminances_cd_m2);
  if (light.sky_scale == SkyScale::absolute) expect_absolute(map, light);
  light.far_ground_of_weather = is_of_weather(map, "far_ground_albedo");
  if (!light.far_ground_of_weather)
    light.far_ground_albedo = map.number("far_ground_albedo", albedos, light.far_ground_albedo);
  map.section("far_ground_seasons", [&](YamlMap& section) {
    for (const auto& season : section.other_keys())
      if (const auto albedo = section.number(season, albedos))
        light.far_ground_seasons.push_back({season, *albedo, section.where(season)});
  });
  read_weather(map, folder, light);
  light.quantity = map.choice("quantity", light.quantity);
  light.colour = map.choice("colour", light.colour);
  for (const char* key : {"dni_w_m2", "dhi_w_m2"}) {
    const bool follows = key == std::string("dhi_w_m2") && light.sky_scale == SkyScale::absolute;
    if (light.source == LightSource::fixed && !map.has(key) && !follows) {
      map.problem("source", std::string("fixed needs ") + key, "", "write it beside `source`");
    }
  }
  warn_unused(map, light);
  return light;
}

}  // namespace sunload::study_sections
