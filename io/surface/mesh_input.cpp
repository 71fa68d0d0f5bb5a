// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/surface/mesh_input.h"

#include <algorithm>
#include <utility>

#include "io/exchange/mesh_formats.h"
#include "surface/edit/joined_surface.h"

namespace arete {

Result<MeshInput> readMeshInput(const std::string& path, const RunContext& context) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return tl::unexpected(format.error());
  Result<MeshFile> file = readMesh(path, context);
  if (!file) return tl::unexpected(file.error());
  MeshInput input{.file = std::move(*file), .format = format->name, .numbers = {}};
  SurfaceMesh& mesh = input.file.mesh;
  input.fileVertices = mesh.positions.size() + input.file.joinedVertices;
  input.fileFaces =
      mesh.faceOf.empty() ? mesh.triangles.size() : std::uint64_t{*std::ranges::max_element(mesh.faceOf)} + 1;
  input.numbers.first = format->extension == ".obj" || format->extension == ".2dm" ? 1 : 0;
  input.numbers.faceOf = mesh.faceOf;
  input.numbers.vertexOf = input.file.vertexOf;
  const bool isGltf = format->extension == ".glb" || format->extension == ".gltf";
  if (!isGltf && mesh.vertexAttributes.empty()) return input;
  const Result<JoinedSurface> joined = joinSurface(mesh, {.partOf = mesh.objectOf}, context);
  if (!joined) return tl::unexpected(joined.error());
  input.joinedAtSeams = joined->joinedVertices;
  if (joined->joinedVertices == 0) return input;
  std::vector<std::uint32_t> numbers = joined->vertexOf;
  if (!input.numbers.vertexOf.empty())
    for (std::uint32_t& v : numbers) v = input.numbers.vertexOf[v];
  input.numbers.vertexOf = std::move(numbers);
  return input;
}

}  // namespace arete
