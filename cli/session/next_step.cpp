// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/session/next_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "io/files/shell_text.h"
#include "io/files/text_scan.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

/// What a file seems to be, by its name.
enum class FileKind { mesh, other };

FileKind kindByName(const std::string& path) {
  const std::string extension = "." + text::lowerExtension(path);
  // A GeoPackage may hold points or polygons as well: build finds out.
  const bool isMesh = std::ranges::any_of(meshFormats(), [&](const MeshFormat& format) {
    return format.extension == extension && extension != ".gpkg";
  });
  return isMesh ? FileKind::mesh : FileKind::other;
}

/// "arete build 'my dem.tif' -o 'my dem.amt'". The file is written to the folder of the user.
std::string buildCommand(const std::string& path) {
  std::string name = fs::path(path).filename().replace_extension(".amt").string();
  if (name.empty() || name.starts_with('-')) name = "model.amt";
  return fmt::format("arete build {} -o {}", shellQuoted(path), shellQuoted(name));
}

bool asksForSight(std::string_view command) {
  constexpr std::array<std::string_view, 4> kAskTerrain = {"height", "los", "profile", "viewshed"};
  return std::ranges::find(kAskTerrain, command) != kAskTerrain.end();
}

/// What to do with a file that is no .amt.
std::string insteadOfModel(const std::string& path, const std::string& command) {
  if (kindByName(path) != FileKind::mesh)
    return fmt::format("if it is a DEM, '{}' makes one of it", buildCommand(path));
  if (asksForSight(command))
    return fmt::format("it is a mesh, and {} asks an .amt of the DEM: arete build DEM -o DEM.amt", command);
  std::string text = fmt::format("it is a mesh: '{}' makes one of it", buildCommand(path));
  if (command == "info") text += fmt::format(", and 'arete mesh info {}' describes it", shellQuoted(path));
  if (command == "extract")
    text += fmt::format(", and 'arete convert {} OUTPUT' writes it in another format", shellQuoted(path));
  return text;
}

/// What to do with a file whose name is not that of a mesh.
std::string insteadOfMesh(const std::string& path, const std::string& command) {
  if (command == "measure") return "measure takes the mesh first, and then what it is compared with";
  return fmt::format("of a DEM '{}' makes an .amt, and arete extract takes meshes from that",
                     buildCommand(path));
}

/// What to do with a model in place of a DEM.
std::string insteadOfDem(const std::string& path) {
  return fmt::format("it is built: 'arete info {}' describes it, and arete extract takes meshes from it",
                     shellQuoted(path));
}

}  // namespace

// The readers' sentences are recognized. A name that does not exist belongs to an output.
Error withNextStep(Error error, const std::string& command) {
  std::error_code ignored;
  if (error.code != ErrorCode::unsupported || !fs::exists(error.culprit, ignored)) return error;
  const std::string_view sentence = error.message;
  const bool isModel = text::lowerExtension(error.culprit) == "amt";
  if (sentence == "is not an .amt file")
    error.message += "; " + insteadOfModel(error.culprit, command);
  else if (sentence.find("is no known mesh format") != sentence.npos && !isModel)
    error.message += "; " + insteadOfMesh(error.culprit, command);
  else if (sentence.find("is not a DEM in any format") != sentence.npos && isModel)
    error.message += "; " + insteadOfDem(error.culprit);
  return error;
}

}  // namespace arete
