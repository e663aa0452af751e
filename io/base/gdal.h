// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of GDAL that are called, under their own names in a namespace: GDAL and the 70
/// libraries behind it are loaded when the first is called (io/base/late_library.h), by who reads
/// rasters and footprints or writes a GeoPackage.
#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "io/base/late_library.h"

namespace sunload::gdal {

// Of attributes of functions a type keeps nothing.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"
#define SUNLOAD_GDAL(name) inline LateFunction<decltype(::name)> name(SUNLOAD_GDAL_LIBRARY, #name)
SUNLOAD_GDAL(CPLGetErrorHandlerUserData);
SUNLOAD_GDAL(CPLGetLastErrorMsg);
SUNLOAD_GDAL(CPLPopErrorHandler);
SUNLOAD_GDAL(CPLPushErrorHandler);
SUNLOAD_GDAL(CPLPushErrorHandlerEx);
SUNLOAD_GDAL(GDALAllRegister);
SUNLOAD_GDAL(GDALClose);
SUNLOAD_GDAL(GDALCreate);
SUNLOAD_GDAL(GDALDatasetCommitTransaction);
SUNLOAD_GDAL(GDALDatasetCreateLayer);
SUNLOAD_GDAL(GDALDatasetGetLayer);
SUNLOAD_GDAL(GDALDatasetGetLayerCount);
SUNLOAD_GDAL(GDALDatasetStartTransaction);
SUNLOAD_GDAL(GDALGetBlockSize);
SUNLOAD_GDAL(GDALGetDataTypeSizeBytes);
SUNLOAD_GDAL(GDALGetDriverByName);
SUNLOAD_GDAL(GDALGetGeoTransform);
SUNLOAD_GDAL(GDALGetMaskBand);
SUNLOAD_GDAL(GDALGetMaskFlags);
SUNLOAD_GDAL(GDALGetRasterBand);
SUNLOAD_GDAL(GDALGetRasterCount);
SUNLOAD_GDAL(GDALGetRasterDataType);
SUNLOAD_GDAL(GDALGetRasterNoDataValue);
SUNLOAD_GDAL(GDALGetRasterOffset);
SUNLOAD_GDAL(GDALGetRasterScale);
SUNLOAD_GDAL(GDALGetRasterUnitType);
SUNLOAD_GDAL(GDALGetRasterXSize);
SUNLOAD_GDAL(GDALGetRasterYSize);
SUNLOAD_GDAL(GDALGetSpatialRef);
SUNLOAD_GDAL(GDALOpenEx);
SUNLOAD_GDAL(GDALRasterIO);
SUNLOAD_GDAL(GDALSetCacheMax64);
SUNLOAD_GDAL(OGR_FD_GetFieldCount);
SUNLOAD_GDAL(OGR_FD_GetFieldDefn);
SUNLOAD_GDAL(OGR_F_Create);
SUNLOAD_GDAL(OGR_F_Destroy);
SUNLOAD_GDAL(OGR_F_GetFID);
SUNLOAD_GDAL(OGR_F_GetFieldAsString);
SUNLOAD_GDAL(OGR_F_GetFieldIndex);
SUNLOAD_GDAL(OGR_F_GetGeometryRef);
SUNLOAD_GDAL(OGR_F_IsFieldSetAndNotNull);
SUNLOAD_GDAL(OGR_F_SetFieldDouble);
SUNLOAD_GDAL(OGR_F_SetFieldString);
SUNLOAD_GDAL(OGR_F_SetGeometryDirectly);
SUNLOAD_GDAL(OGR_Fld_Create);
SUNLOAD_GDAL(OGR_Fld_Destroy);
SUNLOAD_GDAL(OGR_Fld_GetNameRef);
SUNLOAD_GDAL(OGR_GT_Flatten);
SUNLOAD_GDAL(OGR_G_AddGeometry);
SUNLOAD_GDAL(OGR_G_AddGeometryDirectly);
SUNLOAD_GDAL(OGR_G_AddPoint);
SUNLOAD_GDAL(OGR_G_CreateGeometry);
SUNLOAD_GDAL(OGR_G_DestroyGeometry);
SUNLOAD_GDAL(OGR_G_Difference);
SUNLOAD_GDAL(OGR_G_GetDimension);
SUNLOAD_GDAL(OGR_G_GetEnvelope);
SUNLOAD_GDAL(OGR_G_GetGeometryCount);
SUNLOAD_GDAL(OGR_G_GetGeometryRef);
SUNLOAD_GDAL(OGR_G_GetGeometryType);
SUNLOAD_GDAL(OGR_G_GetLinearGeometry);
SUNLOAD_GDAL(OGR_G_GetPointCount);
SUNLOAD_GDAL(OGR_G_GetX);
SUNLOAD_GDAL(OGR_G_GetY);
SUNLOAD_GDAL(OGR_G_GetZ);
SUNLOAD_GDAL(OGR_G_Is3D);
SUNLOAD_GDAL(OGR_G_IsEmpty);
SUNLOAD_GDAL(OGR_G_IsSimple);
SUNLOAD_GDAL(OGR_G_IsValid);
SUNLOAD_GDAL(OGR_G_MakeValid);
SUNLOAD_GDAL(OGR_G_SetPoint);
SUNLOAD_GDAL(OGR_L_CreateFeature);
SUNLOAD_GDAL(OGR_L_CreateField);
SUNLOAD_GDAL(OGR_L_GetGeomType);
SUNLOAD_GDAL(OGR_L_GetLayerDefn);
SUNLOAD_GDAL(OGR_L_GetName);
SUNLOAD_GDAL(OGR_L_GetNextFeature);
SUNLOAD_GDAL(OGR_L_GetSpatialRef);
SUNLOAD_GDAL(OGR_L_ResetReading);
SUNLOAD_GDAL(OSRClone);
SUNLOAD_GDAL(OSRDestroySpatialReference);
SUNLOAD_GDAL(OSRExportToWkt);
SUNLOAD_GDAL(OSRGetAuthorityCode);
SUNLOAD_GDAL(OSRGetAuthorityName);
SUNLOAD_GDAL(OSRGetLinearUnits);
SUNLOAD_GDAL(OSRGetTargetLinearUnits);
SUNLOAD_GDAL(OSRIsCompound);
SUNLOAD_GDAL(OSRIsGeographic);
SUNLOAD_GDAL(OSRNewSpatialReference);
SUNLOAD_GDAL(OSRRelease);
SUNLOAD_GDAL(OSRSetAxisMappingStrategy);
SUNLOAD_GDAL(OSRSetFromUserInput);
SUNLOAD_GDAL(OSRStripVertical);
SUNLOAD_GDAL(VSIFree);
SUNLOAD_GDAL(VSIGetMemFileBuffer);
SUNLOAD_GDAL(VSIUnlink);
#undef SUNLOAD_GDAL
#pragma GCC diagnostic pop

}  // namespace sunload::gdal
