#include "io/export_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <tuple>

#include "geo/check.h"
#include "geo/units.h"
#include "io/render_scene.h"

namespace sunload {
namespace {

constexpr double default_crease_deg = 20;  // as in the viewer
// Normals of one plane differ by rounding; a crease angle of 0 still joins them.
constexpr double plane_cosine = 1e-9;

std::vector<Vec3> vectors(const std::vector<double>& flat) {
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return points;
}

/// For every vertex the first one in the same place.
std::vector<std::size_t> same_places(const std::vector<Vec3>& vertices) {
  std::vector<std::size_t> order(vertices.size()), place(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(vertices[i].x, vertices[i].y, vertices[i].z);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(key(a), a) < std::tuple(key(b), b);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    place[order[k]] =
        k > 0 && vertices[order[k]] == vertices[order[k - 1]] ? place[order[k - 1]] : order[k];
  return place;
}

std::int32_t palette_step(double value, double largest) {
  if (std::isnan(value)) return -1;
  const double share = std::clamp(value / largest, 0.0, 1.0);
  return static_cast<std::int32_t>(std::lround(share * (export_palette_steps - 1)));
}

}  // namespace

ExportPatches::ExportPatches(const ResultReader& result)
    : vertices(vectors(result.doubles("vertex_position"))),
      normal(vectors(result.doubles("patch_normal"))),
      area(result.doubles("patch_area")),
      object(result.integers("patch_object")),
      object_names(result.strings("object_name")),
      origin(scene_origin(result)) {
  if (area.empty()) throw InputError({result.path()}, "no patches", "there is nothing to export");
  const auto flat = result.integers("patch_vertices");
  corners.resize(area.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
}

Colour export_colour(Palette palette, std::int32_t step) {
  return step < 0 ? back_colour
                  : map_colour(palette, static_cast<double>(step) / (export_palette_steps - 1));
}

std::vector<std::array<double, 3>> corner_values(const ExportPatches& patches,
                                                 const std::vector<double>& values,
                                                 double crease_angle_deg) {
  const auto place = same_places(patches.vertices);
  std::vector<std::vector<std::size_t>> around(patches.vertices.size());
  for (std::size_t p = 0; p < patches.corners.size(); ++p)
    for (const auto vertex : patches.corners[p])
      around[place[static_cast<std::size_t>(vertex)]].push_back(p);
  const double least_cosine = std::cos(radians(crease_angle_deg)) - plane_cosine;
  std::vector<std::array<double, 3>> means(patches.corners.size());
  for (std::size_t p = 0; p < means.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0, area = 0;
      for (const auto q : around[place[static_cast<std::size_t>(patches.corners[p][k])]]) {
        if (std::isnan(values[q]) || dot(patches.normal[p], patches.normal[q]) < least_cosine)
          continue;
        sum += values[q] * patches.area[q];
        area += patches.area[q];
      }
      means[p][k] = area > 0 ? sum / area : std::nan("");
    }
  return means;
}

ShownQuantity export_quantity(const ResultReader& result, const ExportRules& rules) {
  const bool is_default = rules.quantity.empty();
  auto shown = shown_quantity(result, is_default ? "light_load" : rules.quantity, rules.time);
  if (!rules.time.empty() && !shown.is_series)
    throw InputError({}, "--time " + rules.time,
                     shown.dataset + " is of the whole period" +
                         (is_default ? " and what is exported without --quantity" : ""),
                     "leave it out, or name a series, e.g. --quantity " +
                         dataset_name("irradiance", result.quantity()));
  return shown;
}

ExportColours export_colours(const ResultReader& result, const ExportRules& rules,
                             const ExportPatches& patches) {
  ExportColours colours;
  colours.shown = export_quantity(result, rules);
  colours.largest = scale_end(rules.largest, colours.shown.values, patches.area);
  colours.palette = rules.palette.value_or(Palette::false_colour);
  for (const double value : colours.shown.values)
    colours.patch_step.push_back(palette_step(value, colours.largest));
  if (!rules.interpolate) return colours;
  for (const auto& corner : corner_values(patches, colours.shown.values,
                                          rules.crease_angle_deg.value_or(default_crease_deg))) {
    auto& steps = colours.corner_step.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) steps[k] = palette_step(corner[k], colours.largest);
  }
  return colours;
}

std::string column_name(const ResultReader& result, const std::string& dataset) {
  std::string units = result.units(dataset);
  if (units == "1") return dataset;
  for (char& c : units) c = c == ' ' ? '_' : static_cast<char>(std::tolower(c));
  std::erase(units, '-');
  return dataset + "_" + units;
}

std::string export_caption(const ResultReader& result, const ShownQuantity& shown) {
  return fmt::format("{}: {}{}{}, {}", std::filesystem::path(result.path()).filename().string(),
                     shown.name, shown.units.empty() ? "" : " ", shown.units, shown.when);
}

}  // namespace sunload
