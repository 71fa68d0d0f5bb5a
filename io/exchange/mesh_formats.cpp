// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/exchange/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/mesh/2dm/2dm.h"
#include "io/mesh/glb/glb.h"
#include "io/mesh/gpkg/gpkg.h"
#include "io/mesh/obj/obj.h"
#include "io/mesh/ply/ply.h"
#include "io/mesh/stl/stl.h"

namespace arete {

namespace {

constexpr MeshFormatTraits kSaysAll = {
    .isExact = true, .holdsCrs = true, .holdsVerticalUnit = true, .holdsErrors = true};
constexpr MeshFormatTraits kSaysDistances = {.isExact = true,
                                             .holdsCrs = true,
                                             .holdsVerticalUnit = true,
                                             .holdsErrors = true,
                                             .holdsQualities = true};
constexpr MeshFormatTraits kSaysNoErrors = {.isExact = true, .holdsCrs = true, .holdsVerticalUnit = true};

constexpr MeshFormatTraits kSaysFrame = {.holdsCrs = true, .holdsVerticalUnit = true};

constexpr std::array kFormats = {
    MeshFormat{"PLY", ".ply", &readPly, &writePly, kSaysDistances},
    MeshFormat{"OBJ", ".obj", &readObj, &writeObj, kSaysNoErrors},
    MeshFormat{"STL", ".stl", &readStl, &writeStl, {}},
    MeshFormat{"GLB", ".glb", &readGlb, &writeGlb, kSaysFrame},
    MeshFormat{"2DM", ".2dm", &read2dm, &write2dm, kSaysNoErrors},
    MeshFormat{"GeoPackage", ".gpkg", &readGpkg, &writeGpkg, kSaysAll},
};

template <class Wanted>
std::string extensionsOf(Wanted wanted) {
  std::string list;
  for (const MeshFormat& format : kFormats)
    if (wanted(format)) list += fmt::format("{}{}", list.empty() ? "" : ", ", format.extension);
  return list;
}

}  // namespace

std::span<const MeshFormat> meshFormats() {
  return kFormats;
}

std::string readableMeshExtensions() {
  return extensionsOf([](const MeshFormat& format) { return format.read != nullptr; });
}

std::string writableMeshExtensions() {
  return extensionsOf([](const MeshFormat& format) { return format.write != nullptr; });
}

Result<MeshFormat> meshFormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const MeshFormat& format : kFormats)
    if (extension == format.extension) return format;
  if (extension == ".amt")
    return failure(ErrorCode::unsupported,
                   "is a multitriangulation, which is many meshes in one: take one with arete extract",
                   path.string());
  std::string known;
  for (const MeshFormat& format : kFormats)
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.name, format.extension);
  return failure(ErrorCode::unsupported,
                 extension.empty()
                     ? fmt::format("a mesh file needs an extension that names its format: {}", known)
                     : fmt::format("{} is no known mesh format; known are {}", extension, known),
                 path.string());
}

bool isMeshFile(const std::filesystem::path& path) {
  const Result<MeshFormat> format = meshFormatOf(path);
  return format && format->read && (format->read != &readGpkg || holdsSurfaces(path));
}

Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return tl::unexpected(format.error());
  if (!format->read)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be written, not read", format->name),
                   path.string());
  Result<MeshFile> file = format->read(path, context);
  // Nobody's triangles are wrong by "not a number": such errors are as good as none.
  if (file && !std::ranges::all_of(file->triangleErrors, [](float e) { return e >= 0 && std::isfinite(e); }))
    file->triangleErrors.clear();
  return file;
}

Status writeMesh(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                 const RunContext& context) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return tl::unexpected(format.error());
  if (!format->write)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be read, not written", format->name),
                   path.string());
  return format->write(mesh, path, options, context);
}

}  // namespace arete
