// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL writes the file under its temporary name. A file that exists is copied to that name first, and what is
// written replaces the layer of that name in the copy. SQLite's journal and its synchronization with the disk
// are off: an unfinished file is never renamed. GDAL reports failures on closing only through its error
// handler, so the file is renamed after it is closed and if the handler has collected no failure.
#include "io/geo/geopackage/geopackage.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "io/files/output_file.h"
#include "io/geo/crs/reader.h"
#include "io/geo/geopackage/geopackage_copy.h"

namespace arete {

tl::unexpected<Error> cannotBeWritten(const GdalErrors& errors) {
  return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
}

namespace {

/// Whether there is a file that may hold other layers. An empty one, as mktemp makes it, holds none.
bool mayHoldLayers(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && std::filesystem::file_size(path, ignored) > 0;
}

GdalDatasetPtr openToAdd(const std::string& path) {
  constexpr std::array<const char*, 2> kDrivers = {"GPKG", nullptr};
  return GdalDatasetPtr(GDALDataset::Open(
      path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR, kDrivers.data()));
}

/// Reads the whole database once, by SQLite's own check of its pages.
Status checkDatabase(const std::string& path, const GdalErrors& errors) {
  constexpr std::array<const char*, 2> kDrivers = {"GPKG", nullptr};
  const GdalDatasetPtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR, kDrivers.data()));
  std::string found;
  if (dataset) {
    OGRLayer* const answer = dataset->ExecuteSQL("PRAGMA quick_check(1)", nullptr, nullptr);
    if (answer) {
      const std::unique_ptr<OGRFeature> row(answer->GetNextFeature());
      if (row && row->GetFieldCount() > 0) found = row->GetFieldAsString(0);
      dataset->ReleaseResultSet(answer);
    }
  }
  if (found == "ok" && !errors.anyFailure()) return {};
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot be read after it was written: {}",
                             errors.anyFailure() ? errors.firstFailure() : "its database is damaged"));
}

}  // namespace

Status writeGeoPackage(const std::filesystem::path& path, ExistingFile existing, const OwnLayer& layer,
                       const GeoPackageFill& fill, const RunContext& context) {
  registerGdal();
  ARETE_TRY(OutputFile file, OutputFile::create(path));
  std::optional<GeoPackageCopy> copy;
  if (existing == ExistingFile::keepsOtherLayers && mayHoldLayers(path)) {
    auto made = GeoPackageCopy::make(path, file.temporaryPath(), layer, context);
    if (!made) return failure(made.error().code, made.error().message, path.string());
    copy = std::move(*made);
    if (copy->isMade()) file.addsToOlder();
  }
  const CPLConfigOptionSetter noWait("OGR_SQLITE_SYNCHRONOUS", "OFF", false);
  const CPLConfigOptionSetter noJournal("OGR_SQLITE_JOURNAL", "OFF", false);
  // The date of a change is fixed, so that equal input gives equal files.
  const CPLConfigOptionSetter noClock("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", false);
  GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoPackages");
  const std::string temporary = file.temporaryPath().string();
  GdalDatasetPtr dataset =
      copy && copy->isMade()
          ? openToAdd(temporary)
          : GdalDatasetPtr(driver->Create(temporary.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  // A file that cannot be opened as a GeoPackage is refused rather than replaced, since its other layers were
  // to be kept.
  if (!dataset && copy)
    return failure(ErrorCode::invalidData,
                   fmt::format("exists and cannot be added to: {}", errors.firstFailure()));
  if (!dataset)
    return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
  // Closing writes the last pages, and its failure is seen in the collected messages alone. The database is
  // checked before the file gets its name.
  Status filled = fill(*dataset, errors);
  dataset.reset();
  if (!filled) return filled;
  if (errors.anyFailure()) return cannotBeWritten(errors);
  ARETE_CHECK(checkDatabase(temporary, errors));
  return file.commit();
}

Result<OGRLayer*> addLayer(GDALDataset& dataset, const std::string& name, const std::string& crsWkt,
                           OGRwkbGeometryType type, const GdalErrors& errors, char** options) {
  std::optional<OGRSpatialReference> crs;
  if (!crsWkt.empty()) {
    ARETE_TRY(auto parsed, crsFromText(crsWkt));
    crs = std::move(parsed);
  }
  OGRLayer* layer = dataset.CreateLayer(name.c_str(), crs ? &*crs : nullptr, type, options);
  if (!layer) return cannotBeWritten(errors);
  return layer;
}

// Types of the source are kept where a GeoPackage has them; what it has not becomes text.
bool addField(OGRLayer& layer, const std::string& name, PointAttributes::Kind kind) {
  using Kind = PointAttributes::Kind;
  struct Type {
    OGRFieldType type;
    OGRFieldSubType subtype = OFSTNone;
  };
  const Type type = [&]() -> Type {
    switch (kind) {
      case Kind::integer:
        return {OFTInteger64};
      case Kind::integer32:
        return {OFTInteger};
      case Kind::integer16:
        return {OFTInteger, OFSTInt16};
      case Kind::boolean:
        return {OFTInteger, OFSTBoolean};
      case Kind::real:
        return {OFTReal};
      case Kind::real32:
        return {OFTReal, OFSTFloat32};
      case Kind::date:
        return {OFTDate};
      case Kind::dateTime:
        return {OFTDateTime};
      case Kind::bytes:
        return {OFTBinary};
      case Kind::json:
        return {OFTString, OFSTJSON};
      default:  // a GeoPackage has no times of day
        return {OFTString};
    }
  }();
  OGRFieldDefn field(name.c_str(), type.type);
  field.SetSubType(type.subtype);
  return layer.CreateField(&field) == OGRERR_NONE;
}

void setFields(OGRFeature& feature, int& at, const PointAttributes& values, std::size_t row) {
  using Kind = PointAttributes::Kind;
  for (std::size_t c = 0; c < values.columns.size(); ++c, ++at) {
    const std::string_view value = values.at(row, c);
    if (value.empty()) continue;
    const Kind kind = values.columns[c].kind;
    double number = 0;
    if ((kind == Kind::real || kind == Kind::real32) &&
        std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc{}) {
      feature.SetField(at, number);
    } else if (kind == Kind::bytes) {
      int count = 0;
      GByte* bytes = CPLHexToBinary(std::string(value).c_str(), &count);
      feature.SetField(at, count, bytes);
      CPLFree(bytes);
    } else {
      feature.SetField(at, std::string(value).c_str());
    }
  }
}

}  // namespace arete
