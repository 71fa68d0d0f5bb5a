// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GeoPackage is written in one transaction under a temporary name. Its contents are stamped with a fixed
// day, so that the same question gives the same bytes.
#include "io/height_table.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <vector>

#include "io/crs_reader.h"
#include "io/file_writer.h"
#include "io/gdal_support.h"
#include "io/output_file.h"
#include "io/table_text.h"
#include "io/text_scan.h"

namespace arete {
namespace {

constexpr std::array<std::string_view, 7> kOwnNames = {"x", "y", "height", "below", "above", "fid", "geom"};
constexpr std::array<const char*, 5> kOwnFields = {"x", "y", "height", "below", "above"};
constexpr std::size_t kRowsPerReport = 4096;
constexpr const char* kStamp = "2000-01-01T00:00:00.000Z";

Status writeCsv(const std::string& path, const PointTable& table,
                std::span<const std::optional<SurfaceHeight>> heights, const RunContext& context) {
  auto file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());
  context.report("writing", 0);
  forCsvLines(table, heights, [&](std::string_view line) { file->write(line); });
  if (Status finished = file->finish(); !finished) return finished;
  context.report("writing", 1);
  return {};
}

class GeoPackageWriter {
 public:
  GeoPackageWriter(const PointTable& table, std::span<const std::optional<SurfaceHeight>> heights)
      : table_(table), heights_(heights) {}

  Status write(const std::string& path, const RunContext& context) {
    const CPLConfigOptionSetter stamp("OGR_CURRENT_DATE", kStamp, false);
    GdalErrors errors;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoPackages");
    GdalDatasetPtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset)
      return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
    Status status = fill(*dataset, errors, context);
    dataset.reset();
    if (status && errors.anyFailure())
      status = failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
    return status;
  }

 private:
  Status fill(GDALDataset& dataset, const GdalErrors& errors, const RunContext& context) {
    const auto broken = [&] {
      return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
    };
    std::optional<OGRSpatialReference> crs;
    if (!table_.crsWkt.empty()) {
      auto parsed = crsFromText(table_.crsWkt);
      if (!parsed) return tl::unexpected(parsed.error());
      crs = std::move(*parsed);
    }
    OGRLayer* layer = dataset.CreateLayer("heights", crs ? &*crs : nullptr, wkbPoint, nullptr);
    if (!layer || !createFields(*layer) || dataset.StartTransaction() != OGRERR_NONE) return broken();
    for (std::size_t row = 0; row < table_.stated.size(); ++row) {
      if (row % kRowsPerReport == 0) {
        if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
        context.report("writing", double(row) / double(table_.stated.size()));
      }
      if (!addRow(*layer, row)) return broken();
    }
    if (dataset.CommitTransaction() != OGRERR_NONE) return broken();
    context.report("writing", 1);
    return {};
  }

  bool createFields(OGRLayer& layer) {
    const std::vector<std::string> names = namesBeside(table_.attributes, kOwnNames);
    for (std::size_t c = 0; c < names.size(); ++c) {
      const PointAttributes::Kind kind = table_.attributes.columns[c].kind;
      OGRFieldDefn field(names[c].c_str(), kind == PointAttributes::Kind::integer ? OFTInteger64
                                           : kind == PointAttributes::Kind::real  ? OFTReal
                                                                                  : OFTString);
      if (layer.CreateField(&field) != OGRERR_NONE) return false;
    }
    for (const char* name : kOwnFields) {
      OGRFieldDefn field(name, OFTReal);
      if (layer.CreateField(&field) != OGRERR_NONE) return false;
    }
    return true;
  }

  bool addRow(OGRLayer& layer, std::size_t row) {
    OGRFeature feature(layer.GetLayerDefn());
    int at = 0;
    for (std::size_t c = 0; c < table_.attributes.columns.size(); ++c, ++at)
      if (const std::string_view value = table_.attributes.at(row, c); !value.empty()) {
        double number = 0;
        if (table_.attributes.columns[c].kind == PointAttributes::Kind::real &&
            std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc{})
          feature.SetField(at, number);
        else
          feature.SetField(at, std::string(value).c_str());
      }
    const Vec2 p = table_.stated[row];
    if (std::isfinite(p.x) && std::isfinite(p.y)) {
      const OGRPoint point(p.x, p.y);
      feature.SetGeometry(&point);
      feature.SetField(at, p.x);
      feature.SetField(at + 1, p.y);
    }
    if (const auto& found = heights_[row]) {
      feature.SetField(at + 2, found->height);
      feature.SetField(at + 3, found->below);
      feature.SetField(at + 4, found->above);
    }
    return layer.CreateFeature(&feature) == OGRERR_NONE;
  }

  const PointTable& table_;
  std::span<const std::optional<SurfaceHeight>> heights_;
};

Status writeGeoPackage(const std::string& path, const PointTable& table,
                       std::span<const std::optional<SurfaceHeight>> heights, const RunContext& context) {
  registerGdal();
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  Status status = GeoPackageWriter(table, heights).write(file->temporaryPath().string(), context);
  if (status) status = file->commit();
  return status;
}

}  // namespace

std::string heightText(double height) {
  return fmt::format("{:.12g}", height);
}

void forCsvLines(const PointTable& table, std::span<const std::optional<SurfaceHeight>> heights,
                 const std::function<void(std::string_view)>& write) {
  std::string line;
  for (const std::string& name : namesBeside(table.attributes, kOwnNames)) {
    appendCsvField(line, name);
    line += ',';
  }
  write(line += "x,y,height,below,above\n");
  for (std::size_t row = 0; row < table.stated.size(); ++row) {
    line.clear();
    for (std::size_t c = 0; c < table.attributes.columns.size(); ++c) {
      appendCsvField(line, table.attributes.at(row, c));
      line += ',';
    }
    const Vec2 p = table.stated[row];
    if (std::isfinite(p.x) && std::isfinite(p.y))
      fmt::format_to(std::back_inserter(line), "{},{},", p.x, p.y);
    else
      line += ",,";
    if (const auto& found = heights[row])
      fmt::format_to(std::back_inserter(line), "{:.12g},{:.12g},{:.12g}\n", found->height, found->below,
                     found->above);
    else
      line += ",,\n";
    write(line);
  }
}

bool isHeightTable(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  return extension == "csv" || extension == "gpkg";
}

Status writeHeightTable(const std::string& path, const PointTable& table,
                        std::span<const std::optional<SurfaceHeight>> heights, const RunContext& context) {
  if (!isHeightTable(path))
    return failure(ErrorCode::usage, "a table of heights ends in .csv or .gpkg", path);
  Status status = text::lowerExtension(path) == "csv" ? writeCsv(path, table, heights, context)
                                                      : writeGeoPackage(path, table, heights, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  return status;
}

}  // namespace arete
