// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What readers by GDAL share: its drivers, its messages, its datasets.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/base/gdal.h"

namespace sunload {

/// GDAL's messages of one reading; they do not reach the standard error.
class GdalMessages {
 public:
  GdalMessages() { gdal::CPLPushErrorHandlerEx(&note, this); }
  ~GdalMessages() { gdal::CPLPopErrorHandler(); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;
  const std::string& first() const { return first_; }

 private:
  static void CPL_STDCALL note(CPLErr, CPLErrorNum, const char* text) {
    auto& self = *static_cast<GdalMessages*>(gdal::CPLGetErrorHandlerUserData());
    if (self.first_.empty()) self.first_ = text;
  }
  std::string first_;
};

/// Closes a dataset of GDAL.
struct CloseDataset {
  void operator()(void* dataset) const { gdal::GDALClose(dataset); }
};
using GdalDataset = std::unique_ptr<void, CloseDataset>;

/// Frees a feature of a layer.
struct DestroyFeature {
  void operator()(void* feature) const { gdal::OGR_F_Destroy(feature); }
};
using GdalFeature = std::unique_ptr<void, DestroyFeature>;

/// Null where none of these drivers reads it. No other is tried: some follow links to elsewhere.
/// `flags`: GDAL_OF_RASTER or GDAL_OF_VECTOR.
GdalDataset open_with_gdal(const std::string& path, unsigned flags,
                           std::vector<const char*> drivers);

/// `EPSG:…`, or WKT where it has no code.
std::string crs_name(OGRSpatialReferenceH crs);

}  // namespace sunload
