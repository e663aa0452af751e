// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of plan data, and which of their layers is meant.
#pragma once

#include <span>
#include <string>

#include "io/scene/raster/gdal_file.h"

namespace sunload {

/// GeoJSON, GeoPackage, Shapefile or FlatGeobuf; null where it is none of them.
GdalDataset open_plan_data(const std::string& path);

/// What a layer is asked for.
struct LayerWanted {
  std::span<const OGRwkbGeometryType> types;  ///< of layers that may be meant
  const char* of;                             ///< "polygons"
  const char* subject;                        ///< "the buildings"
  const char* key;                            ///< of the study that names one: "footprints"
};
/// The layer of that name, or where it is empty the only one that may be meant. Throws InputError,
/// which lists the layers.
OGRLayerH plan_layer(const std::string& path, const GdalDataset& dataset, const std::string& name,
                     const LayerWanted& wanted);

}  // namespace sunload
