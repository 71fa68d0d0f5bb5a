// SPDX-License-Identifier: GPL-3.0-or-later
//
// CSV goes line by line through a FileWriter, a GeoPackage row by row through GDAL.
#include "io/geo/table/line_table.h"

#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/file_writer.h"
#include "io/files/text_scan.h"
#include "io/geo/geopackage/geopackage.h"
#include "io/geo/text/table_text.h"

namespace arete {
namespace {

constexpr std::size_t kLinesPerReport = 4096;
/// Results that tables of one layer always have; which others depends on the question.
constexpr std::size_t kFieldsOfAll = 7;

std::vector<std::string> inputNames(const LineTable& table) {
  std::vector<std::string_view> ours = {"fid", "geom"};
  for (const auto& column : table.results->columns) ours.push_back(column.name);
  return namesBeside(*table.inputs, ours);
}

Status writeCsv(const std::string& path, const LineTable& table, const RunContext& context) {
  ARETE_TRY(auto file, FileWriter::create(path));
  context.report("writing", 0);
  forCsvLines(table, [&](std::string_view line) { file.write(line); });
  ARETE_CHECK(file.finish());
  context.report("writing", 1);
  return {};
}

/// Writes all rows in one transaction.
Status fill(GDALDataset& dataset, const LineTable& table, const GdalErrors& errors,
            const RunContext& context) {
  ARETE_TRY(OGRLayer* const added, addLayer(dataset, table.layer, table.crsWkt, wkbLineString, errors));
  OGRLayer& layer = *added;
  const std::vector<std::string> names = inputNames(table);
  for (std::size_t c = 0; c < names.size(); ++c)
    if (!addField(layer, names[c], table.inputs->columns[c].kind)) return cannotBeWritten(errors);
  for (const auto& column : table.results->columns)
    if (!addField(layer, column.name, column.kind)) return cannotBeWritten(errors);
  if (dataset.StartTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  for (std::size_t row = 0; row < table.ends.size(); ++row) {
    if (row % kLinesPerReport == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
      context.report("writing", double(row) / double(table.ends.size()));
    }
    OGRFeature feature(layer.GetLayerDefn());
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
    if (layer.CreateFeature(&feature) != OGRERR_NONE) return cannotBeWritten(errors);
  }
  if (dataset.CommitTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  context.report("writing", 1);
  return {};
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

Status writeLineTable(const std::string& path, const LineTable& table, const RunContext& context) try {
  if (!isLineTable(path)) return failure(ErrorCode::usage, "a table of lines ends in .csv or .gpkg", path);
  const auto insert = [&](GDALDataset& dataset, const GdalErrors& errors) {
    return fill(dataset, table, errors, context);
  };
  OwnLayer layer{table.layer, {}};
  for (const auto& column : table.results->columns)
    if (layer.fields.size() < kFieldsOfAll) layer.fields.push_back(column.name);
  Status status = text::lowerExtension(path) == "csv"
                      ? writeCsv(path, table, context)
                      : writeGeoPackage(path, table.existing, layer, insert, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  return status;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
