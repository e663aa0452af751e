// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/plan_file.h"

#include <cpl_error.h>
#include <gdal.h>

namespace sunload::test {

bool write_plan(const std::string& geojson, const std::string& driver, const std::string& path) {
  GDALAllRegister();
  GDALDatasetH from =
      GDALOpenEx(geojson.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr);
  if (!from) return false;
  GDALDatasetH to =
      GDALCreate(GDALGetDriverByName(driver.c_str()), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  const bool is_written =
      to && GDALDatasetCopyLayer(to, GDALDatasetGetLayer(from, 0), "plan", nullptr) != nullptr;
  if (to) GDALClose(to);
  GDALClose(from);
  return is_written;
}

bool change_plan(const std::string& path, const std::string& sql) {
  GDALAllRegister();
  GDALDatasetH file =
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
  if (!file) return false;
  CPLErrorReset();
  GDALDatasetReleaseResultSet(file, GDALDatasetExecuteSQL(file, sql.c_str(), nullptr, nullptr));
  const bool is_done = CPLGetLastErrorType() == CE_None;
  GDALClose(file);
  return is_done;
}

bool write_mask(const std::string& raster, std::vector<std::uint8_t> is_valid) {
  GDALAllRegister();
  GDALDatasetH file = GDALOpen(raster.c_str(), GA_Update);
  if (!file) return false;
  const int columns = GDALGetRasterXSize(file), rows = GDALGetRasterYSize(file);
  const bool is_written =
      GDALCreateDatasetMaskBand(file, GMF_PER_DATASET) == CE_None &&
      GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(file, 1)), GF_Write, 0, 0, columns, rows,
                   is_valid.data(), columns, rows, GDT_Byte, 0, 0) == CE_None;
  GDALClose(file);
  return is_written;
}

}  // namespace sunload::test
