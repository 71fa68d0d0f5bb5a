// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/gdal/support.h"
#include "io/table/point_attributes.h"

namespace arete {

/// Fills an empty GeoPackage.
using GeoPackageFill = std::function<Status(GDALDataset& dataset, GdalErrors& errors)>;

/// A GeoPackage that is there whole or not at all, the same bytes for the same content whatever the day: its
/// stamps are the first second of 1970.
/// Errors: those of OutputFile and of `fill`; unreadable, what GDAL says, when it cannot be written.
Status writeGeoPackage(const std::filesystem::path& path, const GeoPackageFill& fill);

/// What GDAL said first, as an error: unreadable.
tl::unexpected<Error> cannotBeWritten(const GdalErrors& errors);

/// A layer of a geometry type, with a CRS unless `crsWkt` is empty. `options`: GDAL's, of its creation.
/// Errors: usage (`crsWkt` is no CRS), unreadable.
Result<OGRLayer*> addLayer(GDALDataset& dataset, const std::string& name, const std::string& crsWkt,
                           OGRwkbGeometryType type, const GdalErrors& errors, char** options = nullptr);

/// False where GDAL cannot.
bool addField(OGRLayer& layer, const std::string& name, PointAttributes::Kind kind);

/// Fields `at` and on get the values of a row; `at` becomes the field behind them. An empty value leaves its
/// field unset.
void setFields(OGRFeature& feature, int& at, const PointAttributes& values, std::size_t row);

}  // namespace arete
