// SPDX-License-Identifier: GPL-3.0-or-later
//
// CSV goes line by line through a FileWriter, a GeoPackage row by row through GDAL.
#include "io/geo/table/height_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/file_writer.h"
#include "io/files/text_scan.h"
#include "io/geo/geopackage/geopackage.h"
#include "io/geo/text/table_text.h"

namespace arete {
namespace {

constexpr std::array<std::string_view, 5> kOwnNames = {"height", "below", "above", "fid", "geom"};
constexpr std::array<const char*, 3> kOwnFields = {"height", "below", "above"};
constexpr const char* kLayer = "heights";
constexpr std::size_t kRowsPerReport = 4096;

/// The names of the input's other columns beside ours.
std::vector<std::string> namesOfInputs(const PointTable& table, bool hasZ) {
  std::vector<std::string_view> own = {table.xName, table.yName};
  own.insert(own.end(), kOwnNames.begin(), kOwnNames.end());
  if (hasZ) own.emplace_back("z");
  return namesBeside(table.attributes, own);
}

Status writeCsv(const std::string& path, const PointTable& table,
                std::span<const std::optional<GroundHeight>> heights, const RunContext& context) {
  ARETE_TRY(auto file, FileWriter::create(path));
  context.report("writing", 0);
  forCsvLines(table, heights, [&](std::string_view line) { file.write(line); });
  ARETE_CHECK(file.finish());
  context.report("writing", 1);
  return {};
}

/// Writes all rows in one transaction.
class GeoPackageRows {
 public:
  GeoPackageRows(const PointTable& table, std::span<const std::optional<GroundHeight>> heights)
      : table_(table), heights_(heights) {}

  Status fill(GDALDataset& dataset, const GdalErrors& errors, const RunContext& context) {
    ARETE_TRY(OGRLayer* const layer,
              addLayer(dataset, kLayer, table_.crsWkt, table_.z.empty() ? wkbPoint : wkbPoint25D, errors));
    if (!createFields(*layer) || dataset.StartTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
    for (std::size_t row = 0; row < table_.stated.size(); ++row) {
      if (row % kRowsPerReport == 0) {
        if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
        context.report("writing", double(row) / double(table_.stated.size()));
      }
      if (!addRow(*layer, row)) return cannotBeWritten(errors);
    }
    if (dataset.CommitTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
    context.report("writing", 1);
    return {};
  }

 private:
  bool createFields(OGRLayer& layer) {
    const std::vector<std::string> names = namesOfInputs(table_, false);
    for (std::size_t c = 0; c < names.size(); ++c)
      if (!addField(layer, names[c], table_.attributes.columns[c].kind)) return false;
    for (const std::string& name : {table_.xName, table_.yName})
      if (!addField(layer, name, PointAttributes::Kind::real)) return false;
    for (const char* name : kOwnFields)
      if (!addField(layer, name, PointAttributes::Kind::real)) return false;
    return true;
  }

  bool addRow(OGRLayer& layer, std::size_t row) {
    OGRFeature feature(layer.GetLayerDefn());
    int at = 0;
    setFields(feature, at, table_.attributes, row);
    const Vec2 p = table_.stated[row];
    if (std::isfinite(p.x) && std::isfinite(p.y)) {
      OGRPoint point(p.x, p.y);
      if (!table_.z.empty() && std::isfinite(table_.z[row])) point.setZ(table_.z[row]);
      feature.SetGeometry(&point);
    }
    if (std::isfinite(p.x)) feature.SetField(at, p.x);
    if (std::isfinite(p.y)) feature.SetField(at + 1, p.y);
    if (const auto& found = heights_[row]) {
      feature.SetField(at + 2, found->height);
      feature.SetField(at + 3, found->below);
      feature.SetField(at + 4, found->above);
    }
    return layer.CreateFeature(&feature) == OGRERR_NONE;
  }

  const PointTable& table_;
  std::span<const std::optional<GroundHeight>> heights_;
};

}  // namespace

std::string heightText(double height) {
  return fmt::format("{:.12g}", height);
}

void forCsvLines(const PointTable& table, std::span<const std::optional<GroundHeight>> heights,
                 const std::function<void(std::string_view)>& write) {
  std::string line;
  const bool hasZ = !table.z.empty();
  std::vector<std::string> names = namesOfInputs(table, hasZ);
  names.insert(names.end(), {table.xName, table.yName});
  for (const std::string& name : names) {
    appendCsvField(line, name);
    line += ',';
  }
  write(line += hasZ ? "z,height,below,above\n" : "height,below,above\n");
  for (std::size_t row = 0; row < table.stated.size(); ++row) {
    line.clear();
    for (std::size_t c = 0; c < table.attributes.columns.size(); ++c) {
      appendCsvField(line, table.attributes.at(row, c));
      line += ',';
    }
    const auto add = [&](double value) {
      if (std::isfinite(value)) fmt::format_to(std::back_inserter(line), "{}", value);
      line += ',';
    };
    add(table.stated[row].x);
    add(table.stated[row].y);
    if (hasZ) add(table.z[row]);
    if (const auto& found = heights[row])
      fmt::format_to(std::back_inserter(line), "{:.12g},{:.12g},{:.12g}\n", found->height, found->below,
                     found->above);
    else
      line += ",,\n";
    write(line);
  }
}

std::vector<std::array<std::string, 2>> renamedColumns(const PointTable& table, const std::string& path) {
  const bool isCsv = text::lowerExtension(path) != "gpkg";
  const std::vector<std::string> names = namesOfInputs(table, isCsv && !table.z.empty());
  std::vector<std::array<std::string, 2>> renamed;
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] != table.attributes.columns[c].name)
      renamed.push_back({table.attributes.columns[c].name, names[c]});
  return renamed;
}

bool isHeightTable(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  return extension == "csv" || extension == "gpkg";
}

Status writeHeightTable(const std::string& path, const PointTable& table,
                        std::span<const std::optional<GroundHeight>> heights, const RunContext& context,
                        ExistingFile existing) try {
  if (!isHeightTable(path))
    return failure(ErrorCode::usage, "a table of heights ends in .csv or .gpkg", path);
  const auto fill = [&](GDALDataset& dataset, const GdalErrors& errors) {
    return GeoPackageRows(table, heights).fill(dataset, errors, context);
  };
  const OwnLayer layer{kLayer, {kOwnFields.begin(), kOwnFields.end()}};
  Status status = text::lowerExtension(path) == "csv" ? writeCsv(path, table, heights, context)
                                                      : writeGeoPackage(path, existing, layer, fill, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  return status;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
