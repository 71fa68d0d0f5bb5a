// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures that materials name by a path are put into the file, so that it is whole without them.
#include "cli/surface/build.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>

#include "cli/arguments/arguments.h"
#include "engine/base/stopwatch.h"
#include "io/amt/surface_file.h"
#include "io/crs/names.h"
#include "io/mesh/pictures.h"
#include "surface/build/build.h"
#include "surface/displacement/find_displacement.h"

namespace arete {
namespace {

struct Seconds {
  double read = 0, build = 0, displace = 0, write = 0;
};

void embedPictures(MeshFile& file, const Session& session, const std::string& path) {
  const MeshAttributes whole = file.mesh;
  const PictureSource source(whole, file.folder);
  std::map<std::string, std::string> embedded;
  std::vector<std::string> warnings;
  for (Material& material : file.mesh.materials)
    for (TextureUse& texture : material.textures) {
      if (texture.picture.starts_with('#')) continue;
      const auto [known, isNew] = embedded.try_emplace(texture.picture, texture.picture);
      if (isNew) {
        Result<PictureBytes> picture = source.read(texture.picture);
        if (!picture) {
          warnings.push_back(
              fmt::format("the picture {} is left out: {}", texture.picture, picture.error().message));
        } else {
          known->second = fmt::format("#{}", file.mesh.pictures.size());
          file.mesh.pictures.push_back(
              {std::move(picture->path), std::move(picture->mimeType), std::move(picture->bytes)});
        }
      }
      texture.picture = known->second;
    }
  session.warn(warnings, path);
}

using Line = std::pair<std::uint64_t, const char*>;

std::vector<Line> mendedLines(const SurfaceMending& m) {
  return {{m.duplicateFaces, "duplicate faces left out"},
          {m.degenerateFaces, "faces without area left out"},
          {m.joinedVertices, "vertices joined where a face without area was between them"},
          {m.turnedFaces, "faces turned to agree with their neighbours"},
          {m.addedVertices, "vertices added, one for each further fan"},
          {m.unusedVertices, "vertices without a face left out"}};
}

void report(const SurfaceBuildArguments& arguments, const MeshInput& input, const SurfaceModel& model,
            const Seconds& seconds, Session& session) {
  const MultiTriangulation& mt = model.mt;
  std::error_code error;
  const auto size = std::filesystem::file_size(arguments.output, error);
  const std::uint64_t bytes = error ? 0 : size;
  const double perVertex = double(bytes) / double(mt.vertexCount());
  std::string text = fmt::format(
      "{}\n"
      "  surface    {} faces, {} vertices, diagonal {:.6g}\n"
      "  triangles  {} at the finest, {} in the multitriangulation\n"
      "  root       {} triangles, {} vertices, error at most {}; {} levels\n",
      arguments.output, grouped(input.fileFaces), grouped(input.fileVertices), model.diagonal,
      grouped(mt.finestTriangleCount()), grouped(mt.triangleCount()), grouped(mt.rootTriangleCount()),
      grouped(mt.rootVertexCount()), fmt::format("{:.6g}", mt.largestError()), model.levels);
  for (const auto& [count, what] : mendedLines(model.mending))
    if (count > 0) text += fmt::format("  mended     {}: {}\n", what, grouped(count));
  if (model.mending.dropsFlatNormals)
    text += "  left out   normals of corners: they are those of flat faces\n";
  text += fmt::format(
      "  built in   {:.2f} s (read {:.2f} s, {}write {:.2f} s)\n"
      "  size       {}, {:.0f} bytes a vertex\n",
      seconds.build, seconds.read,
      model.displacement.isEmpty() ? "" : fmt::format("displacement {:.2f} s, ", seconds.displace),
      seconds.write, byteCount(bytes), perVertex);
  session.say(text);
  const SurfaceMending& m = model.mending;
  session.answer({{"file", arguments.output},
                  {"kind", "surface"},
                  {"source", model.source},
                  {"crs", crsName(model.crsWkt)},
                  {"vertices", mt.vertexCount()},
                  {"diagonal", model.diagonal},
                  {"triangles", mt.triangleCount()},
                  {"finestTriangles", mt.finestTriangleCount()},
                  {"rootTriangles", mt.rootTriangleCount()},
                  {"rootVertices", mt.rootVertexCount()},
                  {"rootError", mt.largestError()},
                  {"levels", model.levels},
                  {"mended",
                   {{"duplicateFaces", m.duplicateFaces},
                    {"degenerateFaces", m.degenerateFaces},
                    {"joinedVertices", m.joinedVertices},
                    {"turnedFaces", m.turnedFaces},
                    {"addedVertices", m.addedVertices},
                    {"unusedVertices", m.unusedVertices},
                    {"dropsFlatNormals", m.dropsFlatNormals}}},
                  {"seconds",
                   {{"read", seconds.read},
                    {"build", seconds.build},
                    {"displace", seconds.displace},
                    {"write", seconds.write}}},
                  {"bytes", bytes},
                  {"bytesPerVertex", perVertex}});
}

}  // namespace

Status buildSurfaceFile(const SurfaceBuildArguments& arguments, MeshInput input, double secondsToRead,
                        Session& session) {
  Seconds seconds;
  seconds.read = secondsToRead;
  MeshFile& file = input.file;
  embedPictures(file, session, arguments.input);

  Stopwatch building;
  Result<SurfaceModel> model = buildSurface(std::move(file.mesh), arguments.options, session.context());
  if (!model) {
    Error error = model.error();
    if (error.culprit.empty()) error.culprit = arguments.input;
    return tl::unexpected(std::move(error));
  }
  seconds.build = building.seconds();
  if (arguments.isDisplaced) {
    Stopwatch displacing;
    Result<SurfaceDisplacement> displacement = findDisplacement(*model, session.context());
    if (!displacement) return tl::unexpected(displacement.error());
    model->displacement = std::move(*displacement);
    seconds.displace = displacing.seconds();
  }
  model->source = std::filesystem::path(arguments.input).filename().string();
  model->crsWkt = file.crsWkt;
  model->verticalUnit = file.verticalUnit;
  model->up = file.up == MeshUp::y ? "y" : file.up == MeshUp::z ? "z" : "";
  // In the numbers of the file.
  if (!input.numbers.vertexOf.empty())
    for (std::uint32_t& v : model->vertexOf) v = input.numbers.vertexOf[v];
  model->sourceVertices = input.fileVertices;

  Stopwatch writing;
  const SurfaceWriteOptions options{.isPacked = arguments.isPacked, .positionBits = arguments.positionBits};
  if (Status written = writeSurfaceAmt(arguments.output, *model, session.context(), options); !written)
    return written;
  seconds.write = writing.seconds();
  report(arguments, input, *model, seconds, session);
  return {};
}

}  // namespace arete
