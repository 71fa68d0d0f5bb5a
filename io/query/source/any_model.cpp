// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/source/any_model.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/text_scan.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"
#include "io/query/extract/model_file.h"
#include "io/query/source/build_terrain.h"
#include "io/query/surface/build_model.h"
#include "io/store/format/layout.h"

namespace arete {
namespace {

bool beginsAsModel(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, kAmtMagic.size()> front{};
  std::ifstream file(path, std::ios::binary);
  return file.read(front.data(), front.size()) && front == kAmtMagic;
}

Result<AnyModel> built(DemRead dem, const std::string& path, const SourceOptions& options,
                       const RunContext& context) {
  ARETE_TRY(TerrainModel model, buildTerrain(dem.heightfield, path, {}, context));
  model.reading = options.reading;
  return AnyModel{Model(std::move(model)), true, std::move(dem.warnings)};
}

Result<AnyModel> built(MeshInput mesh, const std::string& path, const RunContext& context) {
  Warnings warnings = std::move(mesh.file.warnings);
  if (const auto georeference = georeferenceOf(mesh.file.crsWkt, mesh.file.verticalUnit, 0);
      georeference && georeference->isGeographic && !mesh.file.crsWkt.empty() &&
      !mesh.file.frame.isLocalMetres)
    warnings.push_back(
        {WarningCode::position,
         "x and y are degrees and z is a height: a surface of them is a wall; a mesh in metres "
         "(`metric`) or in a map (`toCrs`) has the shape of the ground"});
  ARETE_TRY(BuiltSurface surface, buildSurfaceModel(std::move(mesh), path, {}, context));
  std::ranges::move(surface.warnings, std::back_inserter(warnings));
  return AnyModel{Model(std::move(surface.model)), true, std::move(warnings)};
}

}  // namespace

bool isModelFile(const std::string& path) {
  if (text::lowerExtension(path) == "amt") return true;
  if (isVirtualPath(networkPathOf(path))) return openModelFile(path).has_value();
  return beginsAsModel(path);
}

Result<AnyModel> openAnyModel(const std::string& path, const SourceOptions& options,
                              const RunContext& context) try {
  if (isModelFile(path)) {
    ARETE_TRY(Model model, openModel(path, {}, context));
    return AnyModel{std::move(model), false};
  }
  ARETE_TRY(Source source, readSource(path, options, context));
  if (auto* const mesh = std::get_if<MeshInput>(&source)) return built(std::move(*mesh), path, context);
  return built(std::move(std::get<DemRead>(source)), path, options, context);
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
