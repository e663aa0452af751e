// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/gdal_file.h"

#include <mutex>

namespace sunload {

GdalDataset open_with_gdal(const std::string& path, unsigned flags,
                           std::vector<const char*> drivers) {
  static std::once_flag registered;
  std::call_once(registered, [] {
    gdal::GDALAllRegister();
    // Rows are read once; the default is 5 % of all memory.
    constexpr GIntBig cache_bytes = 64'000'000;
    gdal::GDALSetCacheMax64(cache_bytes);
  });
  drivers.push_back(nullptr);
  return GdalDataset(
      gdal::GDALOpenEx(path.c_str(), flags | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
}

std::string crs_name(OGRSpatialReferenceH crs) {
  const char* authority = gdal::OSRGetAuthorityName(crs, nullptr);
  const char* code = gdal::OSRGetAuthorityCode(crs, nullptr);
  if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
  char* text = nullptr;
  std::string name;
  if (gdal::OSRExportToWkt(crs, &text) == OGRERR_NONE && text != nullptr) name = text;
  gdal::VSIFree(text);
  return name;
}

}  // namespace sunload
