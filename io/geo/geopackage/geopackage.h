// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/existing_file.h"
#include "io/geo/gdal/support.h"
#include "io/geo/geopackage/geopackage_copy.h"
#include "io/geo/text/point_attributes.h"

namespace arete {

/// Adds a layer to a GeoPackage, by addLayer().
using GeoPackageFill = std::function<Status(GDALDataset& dataset, GdalErrors& errors)>;

/// Writes a GeoPackage, complete or not at all. The same content gives the same bytes: its timestamps are the
/// first second of 1970. A file that exists keeps everything but the layer that is written, unless it is to
/// be replaced; other programs cannot write to it meanwhile.
///
/// Errors: those of OutputFile, GeoPackageCopy::make() and `fill`. unreadable: it cannot be written; quotes
/// GDAL. O(size of the file that exists), besides `fill`.
Status writeGeoPackage(const std::filesystem::path& path, ExistingFile existing, const OwnLayer& layer,
                       const GeoPackageFill& fill, const RunContext& context);

/// @return GDAL's first failure, as an error with the code unreadable.
tl::unexpected<Error> cannotBeWritten(const GdalErrors& errors);

/// Creates a layer.
///
/// @param crsWkt Empty: no CRS.
/// @param options GDAL's layer creation options; may be null.
/// @return Owned by the dataset.
///
/// Errors: invalidData: `crsWkt` is not a CRS. unreadable.
Result<OGRLayer*> addLayer(GDALDataset& dataset, const std::string& name, const std::string& crsWkt,
                           OGRwkbGeometryType type, const GdalErrors& errors, char** options = nullptr);

/// Creates a field. @return False if GDAL cannot.
bool addField(OGRLayer& layer, const std::string& name, PointAttributes::Kind kind);

/// Sets the fields from `at` on to the values of a row. An empty value leaves its field unset.
///
/// @param at Index of the first field; on return, of the field behind the last one.
void setFields(OGRFeature& feature, int& at, const PointAttributes& values, std::size_t row);

}  // namespace arete
