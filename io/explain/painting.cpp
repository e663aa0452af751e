// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/painting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "io/base/statistics.h"
#include "io/explain/explanation.h"
#include "io/explain/light_of_part.h"
#include "io/explain/place.h"
#include "solver/explain/importance.h"

namespace sunload {

namespace {

constexpr double painted_step = 0.1;

/// Patches that become brighter together.
struct Surface {
  PaintedRow::Kind kind;
  std::string material, object;
  auto operator<=>(const Surface&) const = default;
};
using Surfaces = std::map<Surface, std::vector<std::size_t>>;

Surfaces surfaces_of(const ResultReader& result) {
  const auto objects = result.strings("object_name"), materials = result.strings("material_name");
  const auto object = result.integers("patch_object"), material = result.integers("patch_material");
  Surfaces surfaces;
  for (std::size_t i = 0; i < material.size(); ++i) {
    if (material[i] < 0) continue;
    const auto& name = materials[static_cast<std::size_t>(material[i])];
    surfaces[{PaintedRow::Kind::material, name, {}}].push_back(i);
    surfaces[{PaintedRow::Kind::surface, name, objects[static_cast<std::size_t>(object[i])]}]
        .push_back(i);
  }
  return surfaces;
}

/// [realization][patch]: what the place gains where that patch reflects 0.1 more. Without light of
/// each realization that of all of them stands for it.
std::vector<std::vector<double>> gains(const ResultReader& result, const ResultScene& scene,
                                       const Place& place) {
  const auto readers = readers_of_bands(result);
  const auto of_bands = importance(scene.traced(), place, reflectances_of_bands(scene));
  std::vector<std::vector<double>> gains(of_bands.front().size());
  const bool has_realizations = result.has("light_load_realization");
  for (std::size_t r = 0; r < gains.size(); ++r) {
    gains[r].assign(of_bands.front()[r].size(), 0);
    for (std::size_t b = 0; b < readers.size(); ++b) {
      const auto load = has_realizations ? readers[b]->row("light_load_realization", r)
                                         : readers[b]->doubles("light_load");
      for (std::size_t i = 0; i < load.size(); ++i)
        gains[r][i] +=
            painted_step * of_bands[b][r][i] * load[i] / static_cast<double>(readers.size());
    }
  }
  return gains;
}

PaintedRow row_of(const Surface& surface, const std::vector<std::size_t>& patches,
                  const std::vector<std::vector<double>>& gains, const std::vector<double>& area,
                  const std::vector<float>& reflectance) {
  PaintedRow row{surface.kind, surface.material, surface.object};
  for (const std::size_t i : patches) row.area_m2 += area[i];
  row.reflectance = static_cast<double>(reflectance[patches.front()]);
  std::vector<double> changes;
  for (const auto& of_realization : gains) {
    double change = 0;
    for (const std::size_t i : patches) change += of_realization[i];
    changes.push_back(change);
  }
  const SampleMean mean = sample_mean(changes);
  row.change = mean.mean;
  row.se = changes.size() > 1 ? mean.se : not_known;
  return row;
}

}  // namespace

Painting painted(const ResultReader& result, const ResultScene& scene, const NamedParts& parts) {
  expect_explainable(result);
  scene.expect_one_season();
  const Place place = place_named(result, parts);
  Painting painting;
  painting.study = result.text_attribute("study");
  painting.variant = result.text_attribute("variant");
  painting.place = words_of(parts);
  painting.part = result.chosen().words();
  painting.units = result.units("light_load");
  painting.extent = extent_of(result, place);
  painting.quantity = result.quantity();
  painting.load =
      mean_over(place, result.doubles(place.is_of_sensors ? "sensor_light_load" : "light_load"));
  const auto of_patches = gains(result, scene, place);
  const auto area = result.doubles("patch_area");
  for (const auto& [surface, patches] : surfaces_of(result))
    painting.rows.push_back(
        row_of(surface, patches, of_patches, area, scene.traced().optics.diffuse));
  std::stable_sort(painting.rows.begin(), painting.rows.end(),
                   [](const PaintedRow& a, const PaintedRow& b) {
                     return std::tuple(a.kind, -a.change) < std::tuple(b.kind, -b.change);
                   });
  return painting;
}

}  // namespace sunload
