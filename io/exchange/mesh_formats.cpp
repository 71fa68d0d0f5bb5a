// SPDX-License-Identifier: GPL-3.0-or-later
//
// One table lists the formats; everything else looks a format up in it.
#include "io/exchange/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/caught_failure.h"
#include "io/exchange/joined.h"
#include "io/file/no_file.h"
#include "io/file/output_file.h"
#include "io/file/text_scan.h"
#include "io/mesh/2dm/2dm.h"
#include "io/mesh/glb/glb.h"
#include "io/mesh/gpkg/gpkg.h"
#include "io/mesh/obj/obj.h"
#include "io/mesh/off/off.h"
#include "io/mesh/ply/ply.h"
#include "io/mesh/stl/stl.h"

namespace arete {

namespace {

constexpr MeshFormatTraits kHoldsAll = {
    .isExact = true, .holdsCrs = true, .holdsVerticalUnit = true, .holdsErrors = true};
constexpr MeshFormatTraits kHoldsQualities = {.isExact = true,
                                              .holdsCrs = true,
                                              .holdsVerticalUnit = true,
                                              .holdsErrors = true,
                                              .holdsQualities = true};
constexpr MeshFormatTraits kHoldsNoErrors = {.isExact = true, .holdsCrs = true, .holdsVerticalUnit = true};

constexpr MeshFormatTraits kHoldsFrame = {.holdsCrs = true, .holdsVerticalUnit = true};

constexpr std::array kFormats = {
    MeshFormat{"PLY", ".ply", &readPly, &writePly, kHoldsQualities},
    MeshFormat{"OBJ", ".obj", &readObj, &writeObj, kHoldsNoErrors},
    MeshFormat{"OFF", ".off", &readOff, &writeOff, kHoldsNoErrors},
    MeshFormat{"STL", ".stl", &readStl, &writeStl, {}},
    MeshFormat{"GLB", ".glb", &readGlb, &writeGlb, kHoldsFrame},
    MeshFormat{"glTF", ".gltf", &readGltf, &writeGltf, kHoldsFrame},
    MeshFormat{"2DM", ".2dm", &read2dm, &write2dm, kHoldsNoErrors},
    MeshFormat{"GeoPackage", ".gpkg", &readGpkg, &writeGpkg, kHoldsAll},
};

template <class Predicate>
std::string extensionsOf(Predicate isListed) {
  std::string list;
  for (const MeshFormat& format : kFormats)
    if (isListed(format)) list += fmt::format("{}{}", list.empty() ? "" : ", ", format.extension);
  return list;
}

Result<MeshFile> readAs(const std::filesystem::path& path, const RunContext& context, std::string_view name,
                        bool needsFaces) {
  const Result<MeshFormat> format = meshFormatOf(path, name);
  if (!format) return tl::unexpected(format.error());
  if (!format->read)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be written, not read", format->name),
                   path.string());
  const bool isPointsToo = !needsFaces && format->read == &readPly;
  Result<MeshFile> file = isPointsToo ? readPlyOfPoints(path, context) : format->read(path, context);
  if (!file) return file;
  // A NaN, infinite or negative error is invalid; then the file counts as one without errors.
  if (!std::ranges::all_of(file->triangleErrors, [](float e) { return e >= 0 && std::isfinite(e); }))
    file->triangleErrors.clear();
  if (!file->crsWkt.empty()) file->up = MeshUp::z;
  if (!isNoFile(path)) file->folder = path.has_parent_path() ? path.parent_path() : ".";
  if (const Status joined = joinSoup(*file, context); !joined)
    return failure(joined.error().code, joined.error().message, path.string());
  return file;
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

Result<MeshFormat> meshFormatOf(const std::filesystem::path& path, std::string_view name) try {
  const std::string extension =
      text::lowered(name.empty() ? path.extension().string() : fmt::format(".{}", name));
  for (const MeshFormat& format : kFormats)
    if (extension == format.extension) return format;
  if (extension == ".amt")
    return failure(ErrorCode::unsupported,
                   "is a multitriangulation, not a mesh; arete extract takes a mesh from it", path.string());
  std::string known;
  for (const MeshFormat& format : kFormats)
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.name, format.extension);
  return failure(ErrorCode::unsupported,
                 extension.empty()
                     ? fmt::format("a mesh file needs an extension that names its format: {}", known)
                     : fmt::format("{} is no known mesh format; known are {}", extension, known),
                 path.string());
} catch (...) {
  return caughtFailure();
}

bool isMeshFile(const std::filesystem::path& path) {
  const Result<MeshFormat> format = meshFormatOf(path);
  return format && format->read && (format->read != &readGpkg || holdsSurfaces(path));
}

Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context,
                          std::string_view name) try {
  return readAs(path, context, name, true);
} catch (...) {
  return caughtFailure(path.native());
}

Result<MeshFile> readMeshOrPoints(const std::filesystem::path& path, const RunContext& context) try {
  return readAs(path, context, {}, false);
} catch (...) {
  return caughtFailure(path.native());
}

Result<MeshWriteReport> writeMesh(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options, const RunContext& context) try {
  const Result<MeshFormat> format = meshFormatOf(path, options.format);
  if (!format) return tl::unexpected(format.error());
  if (!format->write)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be read, not written", format->name),
                   path.string());
  if (format->write == &writeGpkg && isNoFile(path))
    return failure(ErrorCode::unsupported, "is not a file, and a GeoPackage is a database that needs one",
                   path.string());
  OutputGroup together;
  Result<MeshWriteReport> report = format->write(mesh, path, options, context);
  if (!report) return report;
  if (const Status named = together.commit(); !named) return tl::unexpected(named.error());
  return report;
} catch (...) {
  return caughtFailure(path.native());
}

}  // namespace arete
