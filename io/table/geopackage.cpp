// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL writes the file under its temporary name. SQLite's journal and its synchronization with the disk are
// off: an unfinished file is never renamed. GDAL reports failures on closing only through its error handler,
// so the file is renamed after it is closed and if the handler has collected no failure.
#include "io/table/geopackage.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "io/crs/reader.h"
#include "io/file/output_file.h"

namespace arete {

tl::unexpected<Error> cannotBeWritten(const GdalErrors& errors) {
  return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
}

Status writeGeoPackage(const std::filesystem::path& path, const GeoPackageFill& fill) {
  registerGdal();
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  const CPLConfigOptionSetter noWait("OGR_SQLITE_SYNCHRONOUS", "OFF", false);
  const CPLConfigOptionSetter noJournal("OGR_SQLITE_JOURNAL", "OFF", false);
  const CPLConfigOptionSetter noClock("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", false);
  GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoPackages");
  GdalDatasetPtr dataset(
      driver->Create(file->temporaryPath().string().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset)
    return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
  Status filled = fill(*dataset, errors);
  dataset.reset();
  if (!filled) return filled;
  if (errors.anyFailure()) return cannotBeWritten(errors);
  return file->commit();
}

Result<OGRLayer*> addLayer(GDALDataset& dataset, const std::string& name, const std::string& crsWkt,
                           OGRwkbGeometryType type, const GdalErrors& errors, char** options) {
  std::optional<OGRSpatialReference> crs;
  if (!crsWkt.empty()) {
    auto parsed = crsFromText(crsWkt);
    if (!parsed) return tl::unexpected(parsed.error());
    crs = std::move(*parsed);
  }
  OGRLayer* layer = dataset.CreateLayer(name.c_str(), crs ? &*crs : nullptr, type, options);
  if (!layer) return cannotBeWritten(errors);
  return layer;
}

bool addField(OGRLayer& layer, const std::string& name, PointAttributes::Kind kind) {
  OGRFieldDefn field(name.c_str(), kind == PointAttributes::Kind::integer ? OFTInteger64
                                   : kind == PointAttributes::Kind::real  ? OFTReal
                                                                          : OFTString);
  return layer.CreateField(&field) == OGRERR_NONE;
}

void setFields(OGRFeature& feature, int& at, const PointAttributes& values, std::size_t row) {
  for (std::size_t c = 0; c < values.columns.size(); ++c, ++at) {
    const std::string_view value = values.at(row, c);
    if (value.empty()) continue;
    double number = 0;
    if (values.columns[c].kind == PointAttributes::Kind::real &&
        std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc{})
      feature.SetField(at, number);
    else
      feature.SetField(at, std::string(value).c_str());
  }
}

}  // namespace arete
