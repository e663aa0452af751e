// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/viewpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/coordinates.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "io/base/name_pattern.h"

namespace sunload {
namespace {

// Facades that turn by no more from their mean are one front.
constexpr double same_way_deg = 45;
// A person at a window, and one who stands.
constexpr double before_facade_m = 0.5, eye_height_m = 1.7;

/// "x,y,z" and nothing else.
std::optional<Vec3> three_numbers(const std::string& text) {
  Vec3 point;
  const char* at = text.data();
  const char* end = at + text.size();
  for (double* value : {&point.x, &point.y, &point.z}) {
    while (at != end && *at == ' ') ++at;
    if (at != end && *at == '+') ++at;
    const auto [rest, error] = std::from_chars(at, end, *value);
    if (error != std::errc() || !std::isfinite(*value)) return {};
    at = rest;
    if (value == &point.z) break;
    if (at == end || *at++ != ',') return {};
  }
  return at == end ? std::optional(point) : std::nullopt;
}

bool has_match(const std::vector<std::string>& names, const std::string& pattern) {
  return !pattern.empty() && std::any_of(names.begin(), names.end(), [&](const auto& name) {
    return name == pattern || matches(pattern, name);
  });
}

/// Objects of that name, or else facades; nothing where there are neither.
std::optional<NamedParts> parts_named(const ResultReader& result, const std::string& name) {
  if (has_match(result.strings("object_name"), name)) return NamedParts{{}, {name}, {}};
  if (has_match(result.strings("facade_name"), name)) return NamedParts{{name}, {}, {}};
  return {};
}

std::string option_in_words(const std::string& text, ViewpointOf of) {
  return (of == ViewpointOf::eye ? "--eye " : "--look ") + text;
}

/// Throws InputError for what lies beyond all scenes.
Vec3 within_reach(Vec3 place, const std::string& text, ViewpointOf of) {
  for (const double x : {place.x, place.y, place.z})
    if (!(std::abs(x) <= largest_coordinate_m))
      throw InputError({}, option_in_words(text, of),
                       fmt::format("{:g} m is beyond all coordinates on Earth", x),
                       "write x,y,z in metres of the scene");
  return place;
}

[[noreturn]] void refuse_unknown(const ResultReader& result, const std::string& text,
                                 ViewpointOf of) {
  auto known = result.strings("object_name");
  const auto facades = result.strings("facade_name");
  known.insert(known.end(), facades.begin(), facades.end());
  std::string near;
  constexpr std::size_t most_told = 5;
  for (const auto& name : near_names(text.substr(0, text.rfind('+')), known)) {
    near += (near.empty() ? "'" : ", '") + name + "'";
    if (std::count(near.begin(), near.end(), ',') + 1 >= static_cast<std::ptrdiff_t>(most_told))
      break;
  }
  throw InputError({}, option_in_words(text, of),
                   "neither three numbers nor an object or facade of " + result.path(),
                   near.empty() ? "write x,y,z in metres, or a name; sunload info --objects lists "
                                  "the names"
                                : "did you mean " + near + "?");
}

void add_normals(const ResultReader& result, const std::vector<std::size_t>& patches,
                 ScenePlace& place) {
  const auto normal = result.doubles("patch_normal"), area = result.doubles("patch_area");
  for (const auto p : patches) {
    place.normal_sum += Vec3{normal[3 * p], normal[3 * p + 1], normal[3 * p + 2]} * area[p];
    place.area += area[p];
  }
  if (norm(place.normal_sum) == 0) return;
  const Vec3 mean = normalized(place.normal_sum);
  const double least = std::cos(radians(same_way_deg));
  const bool is_one_front = std::all_of(patches.begin(), patches.end(), [&](std::size_t p) {
    return dot(mean, {normal[3 * p], normal[3 * p + 1], normal[3 * p + 2]}) >= least;
  });
  if (is_one_front) place.normal = mean;
}

}  // namespace

Vec3 ScenePlace::foot() const {
  const Vec3 m = middle();
  return {m.x, m.y, low.z};
}

ScenePlace scene_place(const ResultReader& result, const NamedParts& parts) {
  ScenePlace place;
  place.patches = chosen_patches(result, parts);
  const auto vertices = result.integers("patch_vertices");
  const auto position = result.doubles("vertex_position");
  for (const auto p : place.patches)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(vertices[3 * p + k]);
      place.points.push_back({position[3 * v], position[3 * v + 1], position[3 * v + 2]});
    }
  if (place.points.empty())
    throw InputError({result.path()}, "what is named has no patches", "there is nothing to see");
  const Box box = bounding_box(place.points);
  place.low = box.low;
  place.high = box.high;
  add_normals(result, place.patches, place);
  return place;
}

Viewpoint viewpoint(const ResultReader& result, const std::string& text, ViewpointOf of) {
  if (const auto point = three_numbers(text))
    return {within_reach(*point, text, of) - result.origin(), {}, {}};
  if (const auto parts = parts_named(result, text)) {
    ScenePlace place = scene_place(result, *parts);
    Vec3 at = place.middle();
    std::optional<Vec3> towards;
    if (of == ViewpointOf::eye && !parts->facades.empty() && place.normal) {
      towards = place.normal;
      at += *towards * before_facade_m;
    } else if (of == ViewpointOf::eye) {
      at.z = place.high.z + eye_height_m;
    }
    return {at, towards, std::move(place)};
  }
  const auto plus = text.rfind('+');
  const auto offset =
      plus == std::string::npos ? std::nullopt : three_numbers(text.substr(plus + 1));
  const auto parts = offset ? parts_named(result, text.substr(0, plus)) : std::nullopt;
  if (!parts) refuse_unknown(result, text, of);
  return {scene_place(result, *parts).foot() + within_reach(*offset, text, of), {}, {}};
}

}  // namespace sunload
