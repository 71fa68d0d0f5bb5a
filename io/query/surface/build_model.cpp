// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/build_model.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>

#include "engine/base/stopwatch.h"
#include "io/formats/common/pictures.h"
#include "io/query/surface/local_metres.h"
#include "surface/builder/build.h"
#include "surface/displacement/find_displacement.h"
#include "surface/edit/drop_attributes.h"

namespace arete {
namespace {

/// @return what is left out.
Warnings embedPictures(MeshFile& file) {
  const MeshAttributes whole = file.mesh;
  const PictureSource source(whole, file.folder);
  std::map<std::string, std::string> embedded;
  Warnings warnings;
  for (Material& material : file.mesh.materials)
    for (TextureUse& texture : material.textures) {
      if (texture.picture.starts_with('#')) continue;
      const auto [known, isNew] = embedded.try_emplace(texture.picture, texture.picture);
      if (isNew) {
        Result<PictureBytes> picture = source.read(texture.picture);
        if (!picture) {
          warnings.push_back({WarningCode::omitted, fmt::format("the picture {} is left out: {}",
                                                                texture.picture, picture.error().message)});
        } else {
          known->second = fmt::format("#{}", file.mesh.pictures.size());
          file.mesh.pictures.push_back(
              {std::move(picture->path), std::move(picture->mimeType), std::move(picture->bytes)});
        }
      }
      texture.picture = known->second;
    }
  return warnings;
}

}  // namespace

Result<BuiltSurface> buildSurfaceModel(MeshInput input, const std::string& source,
                                       const SurfaceFileOptions& options, const RunContext& context) {
  BuiltSurface built;
  MeshFile& file = input.file;
  ARETE_CHECK(dropAttributes(file.mesh, options.dropAttributes));
  built.warnings = embedPictures(file);
  ARETE_TRY(const auto place, returnToLocalMetres(file));
  if (place) built.warnings.push_back(*place);

  Stopwatch building;
  Result<SurfaceModel> model = buildSurface(std::move(file.mesh), options.build, context);
  if (!model) {
    Error error = model.error();
    if (error.culprit.empty()) error.culprit = source;
    return tl::unexpected(std::move(error));
  }
  built.secondsToBuild = building.seconds();
  if (options.isDisplaced) {
    Stopwatch displacing;
    ARETE_TRY(SurfaceDisplacement displacement, findDisplacement(*model, context));
    model->displacement = std::move(displacement);
    built.secondsToDisplace = displacing.seconds();
  }
  model->source = std::filesystem::path(source).filename().string();
  model->crsWkt = file.crsWkt;
  model->verticalUnit = file.verticalUnit;
  model->up = file.up == MeshUp::y ? "y" : file.up == MeshUp::z ? "z" : "";
  // In the numbers of the file.
  if (!input.numbers.vertexOf.empty())
    for (std::uint32_t& v : model->vertexOf) v = input.numbers.vertexOf[v];
  model->sourceVertices = input.fileVertices;
  model->fileFaces = input.fileFaces;
  built.model = std::move(*model);
  return built;
}

}  // namespace arete
