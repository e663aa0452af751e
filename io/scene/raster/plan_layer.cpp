// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/plan_layer.h"

#include <fmt/format.h>

#include <algorithm>

#include "geo/base/check.h"

namespace sunload {

GdalDataset open_plan_data(const std::string& path) {
  return open_with_gdal(path, GDAL_OF_VECTOR, {"GeoJSON", "GPKG", "ESRI Shapefile", "FlatGeobuf"});
}

OGRLayerH plan_layer(const std::string& path, const GdalDataset& dataset, const std::string& name,
                     const LayerWanted& wanted) {
  std::string known;
  OGRLayerH found = nullptr;
  int layers = 0;
  for (int k = 0; k < gdal::GDALDatasetGetLayerCount(dataset.get()); ++k) {
    OGRLayerH layer = gdal::GDALDatasetGetLayer(dataset.get(), k);
    const std::string own = gdal::OGR_L_GetName(layer);
    known += (known.empty() ? "" : ", ") + own;
    const auto type = gdal::OGR_GT_Flatten(gdal::OGR_L_GetGeomType(layer));
    const bool may_be = std::ranges::find(wanted.types, type) != wanted.types.end();
    if (name.empty() ? !may_be : own != name) continue;
    found = layer;
    ++layers;
  }
  if (found == nullptr)
    throw InputError({path},
                     name.empty() ? fmt::format("has no layer of {}", wanted.of)
                                  : fmt::format("has no layer '{}'", name),
                     "its layers: " + known);
  if (layers > 1 && name.empty())
    throw InputError({path}, fmt::format("has several layers of {}: {}", wanted.of, known),
                     fmt::format("which are {} is not known", wanted.subject),
                     fmt::format("name one: {}: {{layer: …}}", wanted.key));
  return found;
}

}  // namespace sunload
