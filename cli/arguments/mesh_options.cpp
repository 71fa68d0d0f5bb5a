// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/mesh_options.h"

#include <fmt/format.h>

#include <utility>

#include "cli/arguments/arguments.h"

namespace arete {

Result<MeshTarget> meshTarget(const MeshOutput& output, const std::string& input, Session& session) {
  const Result<MeshFormat> format = meshFormatOf(output.path, output.format);
  if (!format)
    return failure(ErrorCode::usage, format.error().message, fmt::format("--output {}", output.path));
  ARETE_CHECK(output.checkPacking());
  const std::string path = output.open(session);
  ARETE_CHECK(checkOutput("--output", path, {input}));
  return MeshTarget{*format, path};
}

std::optional<MeshPacking> packingOf(const MeshOutput& output) {
  const std::optional<int> bits = output.packedBits();
  return bits ? std::optional(MeshPacking{.positionBits = *bits}) : std::nullopt;
}

void addMeshFilesTo(CLI::App& command, std::string& input, MeshOutput& output, ExistingFile& existing) {
  command.add_option("MESH", input, "Triangle mesh: " + readableMeshExtensions())->required()->type_name("");
  output.addTo(command, "File to write", "");
  addOverwriteTo(command, existing);
}

void addPlacingTo(CLI::App& command, MeshPlacing& placing) {
  command
      .add_option_function<std::string>(
          "--up", [&placing](const std::string& axis) { placing.up = axis == "y" ? MeshUp::y : MeshUp::z; },
          "Axis of the input that points up, y or z: the output has the axis up that its format has,\n"
          "y in glTF, z in all others (default: nothing is turned)")
      ->check(oneOf({"y", "z"}))
      ->type_name("AXIS");
  command
      .add_option(
          "--unit", placing.unit,
          fmt::format("Length of 1 in the input, {}: the output is in metres (default: nothing is scaled)",
                      fmt::join(meshUnitNames(), ", ")))
      ->check(oneOf(meshUnitNames()))
      ->type_name("UNIT");
}

PlaceOptions addPlaceTo(CLI::App& command, PlaceTarget& place) {
  PlaceOptions options;
  options.toCrs =
      command
          .add_option(
              "--to-crs", place.crs,
              "Lead the mesh into this CRS: EPSG:..., WKT, or utm, the zone of its middle. x is easting "
              "or longitude, heights stay. Edges are split where bending adds more than a tenth of the "
              "tolerance, and the error is stated anew")
          ->type_name("CRS");
  options.metric = command.add_flag("--metric", place.isMetric,
                                    "Lead the mesh into metres to the east, north and up from an origin, as "
                                    "a GLB is; split as with --to-crs");
  return options;
}

std::string placedText(const PlacedFigures& placed) {
  return fmt::format("; led into {}: {} and {} more, at most {} of error", placed.target,
                     grouped(placed.addedVertices, "vertex", "vertices"),
                     grouped(placed.addedTriangles, "triangle", "triangles"),
                     withUnit(placed.added, placed.unit));
}

Json placedJsonOf(const PlacedFigures& placed) {
  return {{"target", placed.target},
          {"addedVertices", placed.addedVertices},
          {"addedTriangles", placed.addedTriangles},
          {"addedError", placed.added}};
}

}  // namespace arete
