// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "io/files/shell_text.h"
#include "io/files/text_scan.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/raster_writer.h"

namespace arete {
namespace {

/// The options that the build read the source with; without them the same file may be another terrain.
std::string readingOptions(const SourceReading& reading) {
  std::string options;
  if (reading.band) options += fmt::format(" --band {}", *reading.band);
  if (!reading.layer.empty()) options += " --layer " + shellQuoted(reading.layer);
  if (!reading.zField.empty()) options += " --z-field " + shellQuoted(reading.zField);
  if (!reading.samePlace.empty()) options += " --same-place " + shellQuoted(reading.samePlace);
  if (reading.nodata) options += fmt::format(" --nodata {}", *reading.nodata);
  if (!reading.verticalUnit.empty()) options += " --vertical-unit " + shellQuoted(reading.verticalUnit);
  if (reading.isDepth) options += fmt::format(" --positive {}", *reading.isDepth ? "down" : "up");
  if (!reading.crs.empty()) options += " --crs " + shellQuoted(reading.crs);
  return options;
}

/// The same text may be read as a raster where its points fill a grid.
bool isTextOfPoints(const TerrainModel& model) {
  constexpr std::array<std::string_view, 4> kTexts = {"csv", "tsv", "txt", "xyz"};
  return !model.isRaster && std::ranges::count(kTexts, text::lowerExtension(model.source)) > 0;
}

}  // namespace

std::string optionsOf(const CutRequest& c) {
  std::string options;
  const auto add = [&](const char* name, const auto& value) {
    options += fmt::format(" --{} {}", name, value);
  };
  if (c.maxError) add("max-error", *c.maxError);
  if (c.maxTriangles) add("max-triangles", *c.maxTriangles);
  if (!c.region.empty()) add("region", shellQuoted(c.region));
  if (!c.regionCrs.empty()) add("region-crs", shellQuoted(c.regionCrs));
  if (c.distance > 0) add("distance", c.distance);
  if (c.focus) {
    add("focus", shellQuoted(c.focus->text));
    add("error-growth", c.focus->growth);
  }
  if (c.camera) {
    const Camera& camera = *c.camera;
    add("camera", shellQuoted(c.cameraText));
    add("look", fmt::format("{},{}", camera.azimuthDegrees, camera.pitchDegrees));
    if (camera.parallelHeight > 0)
      add("parallel-height", camera.parallelHeight);
    else
      add("fov", camera.verticalFieldOfViewDegrees);
    add("viewport", fmt::format("{}x{}", camera.widthPixels, camera.heightPixels));
    if (c.pixelError) add("pixel-error", *c.pixelError);
  }
  if (c.isLonLat) options += " --lonlat";
  if (std::isfinite(c.outsideError)) add("outside-error", c.outsideError);
  if (c.method == CutMethod::saturated) add("method", "saturated");
  if (c.deadlineMilliseconds) add("deadline", *c.deadlineMilliseconds);
  if (c.order != CutOrder::usual && c.order != CutOrder::worst) add("order", orderName(c.order));
  if (c.fit != CutFit::none) add("fit", fitName(c.fit));
  return options;
}

std::string checkCommand(const ExtractRequest& request, const TerrainModel& model,
                         const std::string& modelPath, double promisedError) {
  const CutRequest& c = request.criterion;
  std::string command, tin = request.output;
  if (isGeoTiffName(request.output)) {
    tin = std::filesystem::path(request.output).replace_extension(".ply").string();
    command = fmt::format("arete extract {} -o {}", shellQuoted(modelPath), shellQuoted(tin));
    command += optionsOf(c);
    command += " && ";
  }
  command += fmt::format("arete measure {} {}", shellQuoted(tin), shellQuoted(model.source));
  for (const std::string& file : model.reading.otherFiles) command += " " + shellQuoted(file);
  command += fmt::format(" --expect {}", promisedError);
  command += readingOptions(model.reading);
  if (isTextOfPoints(model)) command += " --as points";
  if (!c.region.empty()) command += fmt::format(" --region {}", shellQuoted(c.region));
  if (!c.regionCrs.empty()) command += fmt::format(" --region-crs {}", shellQuoted(c.regionCrs));
  if (c.distance > 0) command += fmt::format(" --distance {}", c.distance);
  // An STL has no place for a CRS.
  if (const auto format = meshFormatOf(request.output, request.format);
      !request.place.crs.empty() && format && !format->holds.holdsCrs)
    command += fmt::format(" --tin-crs {}", shellQuoted(request.place.crs));
  if (model.options.rimTolerance > 0) command += " --allow-covered-nodata";
  return command;
}

}  // namespace arete
