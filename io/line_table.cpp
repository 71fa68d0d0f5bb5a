// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GeoPackage is written in one transaction under a temporary name. Its contents are stamped with a fixed
// day, so that the same question gives the same bytes.
#include "io/line_table.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "io/crs_reader.h"
#include "io/file_writer.h"
#include "io/gdal_support.h"
#include "io/output_file.h"
#include "io/table_text.h"
#include "io/text_scan.h"

namespace arete {
namespace {

constexpr std::size_t kRowsPerReport = 4096;
constexpr const char* kStamp = "2000-01-01T00:00:00.000Z";

std::vector<std::string> inputNames(const LineTable& table) {
  std::vector<std::string_view> ours = {"fid", "geom"};
  for (const auto& column : table.results->columns) ours.push_back(column.name);
  return namesBeside(*table.inputs, ours);
}

Status writeCsv(const std::string& path, const LineTable& table, const RunContext& context) {
  auto file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());
  context.report("writing", 0);
  forCsvLines(table, [&](std::string_view line) { file->write(line); });
  if (Status finished = file->finish(); !finished) return finished;
  context.report("writing", 1);
  return {};
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

Status fill(GDALDataset& dataset, const LineTable& table, const GdalErrors& errors,
            const RunContext& context) {
  const auto broken = [&] {
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  };
  std::optional<OGRSpatialReference> crs;
  if (!table.crsWkt.empty()) {
    auto parsed = crsFromText(table.crsWkt);
    if (!parsed) return tl::unexpected(parsed.error());
    crs = std::move(*parsed);
  }
  OGRLayer* layer = dataset.CreateLayer(table.layer.c_str(), crs ? &*crs : nullptr, wkbLineString, nullptr);
  if (!layer) return broken();
  const std::vector<std::string> names = inputNames(table);
  for (std::size_t c = 0; c < names.size(); ++c)
    if (!addField(*layer, names[c], table.inputs->columns[c].kind)) return broken();
  for (const auto& column : table.results->columns)
    if (!addField(*layer, column.name, column.kind)) return broken();
  if (dataset.StartTransaction() != OGRERR_NONE) return broken();
  for (std::size_t row = 0; row < table.ends.size(); ++row) {
    if (row % kRowsPerReport == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
      context.report("writing", double(row) / double(table.ends.size()));
    }
    OGRFeature feature(layer->GetLayerDefn());
    int at = 0;
    setFields(feature, at, *table.inputs, row);
    setFields(feature, at, *table.results, row);
    const auto& [a, b] = table.ends[row];
    if (std::isfinite(a.x + a.y + b.x + b.y)) {
      OGRLineString line;
      line.addPoint(a.x, a.y);
      line.addPoint(b.x, b.y);
      feature.SetGeometry(&line);
    }
    if (layer->CreateFeature(&feature) != OGRERR_NONE) return broken();
  }
  if (dataset.CommitTransaction() != OGRERR_NONE) return broken();
  context.report("writing", 1);
  return {};
}

Status writeGeoPackage(const std::string& path, const LineTable& table, const RunContext& context) {
  registerGdal();
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  const CPLConfigOptionSetter stamp("OGR_CURRENT_DATE", kStamp, false);
  GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoPackages");
  GdalDatasetPtr dataset(
      driver->Create(file->temporaryPath().string().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset)
    return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
  Status status = fill(*dataset, table, errors, context);
  dataset.reset();
  if (status && errors.anyFailure())
    status = failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  return status ? file->commit() : status;
}

}  // namespace

void forCsvLines(const LineTable& table, const std::function<void(std::string_view)>& write) {
  std::string line;
  const auto add = [&](std::string_view value) {
    if (!line.empty()) line += ',';
    appendCsvField(line, value);
  };
  bool isFirst = true;
  const auto addAll = [&](const PointAttributes& values, std::size_t row) {
    for (std::size_t c = 0; c < values.columns.size(); ++c) {
      if (!std::exchange(isFirst, false)) line += ',';
      appendCsvField(line, values.at(row, c));
    }
  };
  for (const std::string& name : inputNames(table)) add(name);
  for (const auto& column : table.results->columns) add(column.name);
  write(line += '\n');
  for (std::size_t row = 0; row < table.ends.size(); ++row) {
    line.clear();
    isFirst = true;
    addAll(*table.inputs, row);
    addAll(*table.results, row);
    write(line += '\n');
  }
}

bool isLineTable(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  return extension == "csv" || extension == "gpkg";
}

Status writeLineTable(const std::string& path, const LineTable& table, const RunContext& context) {
  if (!isLineTable(path)) return failure(ErrorCode::usage, "a table of lines ends in .csv or .gpkg", path);
  Status status = text::lowerExtension(path) == "csv" ? writeCsv(path, table, context)
                                                      : writeGeoPackage(path, table, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  return status;
}

}  // namespace arete
