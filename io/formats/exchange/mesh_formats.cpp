// SPDX-License-Identifier: GPL-3.0-or-later
//
// One table lists the formats; everything else looks a format up in it.
#include "io/formats/exchange/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "io/files/no_file.h"
#include "io/files/output_file.h"
#include "io/files/text/utf8.h"
#include "io/files/text_scan.h"
#include "io/formats/2dm/2dm.h"
#include "io/formats/common/texture_set.h"
#include "io/formats/exchange/grouped_faces.h"
#include "io/formats/exchange/joined.h"
#include "io/formats/glb/glb.h"
#include "io/formats/glb/texture_transform.h"
#include "io/formats/gpkg/gpkg.h"
#include "io/formats/obj/obj.h"
#include "io/formats/off/off.h"
#include "io/formats/ply/ply.h"
#include "io/formats/stl/stl.h"

namespace arete {

namespace {

// The traits decide what is converted before a mesh is written, and what is named as lost.
constexpr MeshFormatTraits kPly = {.isExact = true,
                                   .holdsCrs = true,
                                   .holdsVerticalUnit = true,
                                   .holdsErrors = true,
                                   .holdsQualities = true,
                                   .hasOneTextureSet = true,
                                   .mayHoldPoints = true,
                                   .statesScalarType = true};
constexpr MeshFormatTraits kObj = {.isExact = true,
                                   .holdsCrs = true,
                                   .holdsVerticalUnit = true,
                                   .hasOneTextureSet = true,
                                   .holdsTextureTransforms = true,
                                   .statesPartsOnce = true,
                                   .firstIndex = 1};
constexpr MeshFormatTraits kOff = {
    .isExact = true, .holdsCrs = true, .holdsVerticalUnit = true, .hasOneTextureSet = true};
constexpr MeshFormatTraits kStl = {.statesPartsOnce = true};
constexpr MeshFormatTraits kGltf = {
    .holdsCrs = true, .holdsVerticalUnit = true, .isYUp = true, .holdsTextureTransforms = true};
constexpr MeshFormatTraits k2dm = {
    .isExact = true, .holdsCrs = true, .holdsVerticalUnit = true, .firstIndex = 1};
constexpr MeshFormatTraits kGpkg = {
    .isExact = true, .holdsCrs = true, .holdsVerticalUnit = true, .holdsErrors = true, .sharesFile = true};

constexpr std::array kFormats = {
    MeshFormat{"PLY", ".ply", &readPly, &writePly, kPly},
    MeshFormat{"OBJ", ".obj", &readObj, &writeObj, kObj},
    MeshFormat{"OFF", ".off", &readOff, &writeOff, kOff},
    MeshFormat{"STL", ".stl", &readStl, &writeStl, kStl},
    MeshFormat{"GLB", ".glb", &readGlb, &writeGlb, kGltf},
    MeshFormat{"glTF", ".gltf", &readGltf, &writeGltf, kGltf},
    MeshFormat{"2DM", ".2dm", &read2dm, &write2dm, k2dm},
    MeshFormat{"GeoPackage", ".gpkg", &readGpkg, &writeGpkg, kGpkg},
};

template <class Predicate>
std::string extensionsOf(Predicate isListed) {
  std::string list;
  for (const MeshFormat& format : kFormats)
    if (isListed(format)) list += fmt::format("{}{}", list.empty() ? "" : ", ", format.extension);
  return list;
}

/// Names that are not UTF-8 are Latin-1.
void nameInUtf8(MeshFile& file) {
  const auto change = [](std::string& name) {
    if (!text::isUtf8(name)) name = text::asUtf8(name);
  };
  SurfaceMesh& mesh = file.mesh;
  for (auto* const attributes : {&mesh.vertexAttributes, &mesh.wedgeAttributes, &mesh.triangleAttributes})
    for (Attribute& attribute : *attributes) change(attribute.name);
  for (auto* const names : {&mesh.objects, &mesh.groups})
    for (std::string& name : *names) change(name);
  for (Warning& warning : file.warnings) change(warning.sentence);
  for (Material& material : mesh.materials) {
    change(material.name);
    change(material.alphaMode);
    for (TextureUse& use : material.textures) {
      change(use.role);
      change(use.picture);
    }
    std::map<std::string, std::string> verbatim;
    for (auto& [key, text] : material.verbatim) verbatim.emplace(text::asUtf8(key), text::asUtf8(text));
    material.verbatim = std::move(verbatim);
  }
  for (EmbeddedPicture& picture : mesh.pictures) {
    change(picture.name);
    change(picture.mimeType);
  }
  change(file.crsWkt);
  change(file.verticalUnit);
}

Result<MeshFile> readAs(const std::filesystem::path& path, const RunContext& context, std::string_view name,
                        bool needsFaces) {
  ARETE_TRY(const MeshFormat format, meshFormatOf(path, name));
  if (!format.read)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be written, not read", format.name),
                   path.string());
  const bool isPointsToo = !needsFaces && format.holds.mayHoldPoints;
  Result<MeshFile> file = isPointsToo ? readPlyOfPoints(path, context) : format.read(path, context);
  if (!file) return file;
  nameInUtf8(*file);
  // A NaN, infinite or negative error is invalid; then the file counts as one without errors.
  if (!std::ranges::all_of(file->triangleErrors, [](float e) { return e >= 0 && std::isfinite(e); }))
    file->triangleErrors.clear();
  if (!file->crsWkt.empty() || file->metresAbout) file->up = MeshUp::z;
  if (!isNoFile(path)) file->folder = path.has_parent_path() ? path.parent_path() : ".";
  if (const Status joined = joinSoup(*file, context); !joined)
    return failure(joined.error().code, joined.error().message, path.string());
  return file;
}

/// Writes a mesh as the format can have it: textures where their transforms put them, one set of texture
/// coordinates, faces sorted by what they belong to.
Result<MeshWriteReport> writeFitted(const MeshFormat& format, MeshRef mesh, const std::filesystem::path& path,
                                    MeshWriteOptions options, const RunContext& context) {
  std::optional<SurfaceMesh> fitted;
  const auto current = [&] { return fitted ? MeshRef(*fitted) : mesh; };
  const auto copy = [&] {
    if (fitted) return;
    fitted.emplace(mesh.shape);
    static_cast<MeshAttributes&>(*fitted) = mesh.attributes;
  };
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  std::vector<std::string> lost;
  // OBJ's are of the material, glTF's of each texture: only glTF takes every one.
  const bool holdsSome = format.holds.holdsTextureTransforms;
  if (!format.holds.isYUp && hasTextureTransforms(mesh.attributes, !holdsSome)) {
    copy();
    if (!applyTextureTransforms(*fitted, !holdsSome).empty())
      lost.emplace_back("textures of one material that are placed in several ways");
  }
  if (format.holds.hasOneTextureSet)
    if (std::optional<SurfaceMesh> one = withOneTextureSet(current())) fitted = std::move(one);
  const std::vector<std::uint32_t> triangleOf = trianglesOfFile(current(), format);
  std::vector<float> errors;
  if (!triangleOf.empty()) {
    fitted = inOrder(current(), triangleOf);
    if (!options.triangleErrors.empty()) {
      for (const std::uint32_t t : triangleOf) errors.push_back(options.triangleErrors[t]);
      options.triangleErrors = errors;
    }
  }
  Result<MeshWriteReport> report = format.write(current(), path, options, context);
  if (!report) return report;
  report->lost.insert(report->lost.end(), lost.begin(), lost.end());
  return report;
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
  // A stated name takes the place of the extension.
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
  // A GeoPackage may hold other things than a mesh, so its content decides.
  return format && format->read && (!format->holds.sharesFile || holdsSurfaces(path));
}

namespace {
/// The file and the mesh are in memory together, and the mesh takes up to three times the bytes of the file.
/// What is in an archive or on a server is bounded as it grows.
void requireMemoryFor(const std::filesystem::path& path) {
  constexpr std::uint64_t kOfFile = 4;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (!error) requireMemory(kOfFile * bytes, "take a smaller mesh, or a part of it");
}
}  // namespace

Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context,
                          std::string_view name) try {
  requireMemoryFor(path);
  return readAs(path, context, name, true);
} catch (...) {
  return caughtFailure(path.native());
}

Result<MeshFile> readMeshOrPoints(const std::filesystem::path& path, const RunContext& context) try {
  requireMemoryFor(path);
  return readAs(path, context, {}, false);
} catch (...) {
  return caughtFailure(path.native());
}

Result<MeshWriteReport> writeMesh(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options, const RunContext& context) try {
  ARETE_TRY(const MeshFormat format, meshFormatOf(path, options.format));
  if (!format.write)
    return failure(ErrorCode::unsupported, fmt::format("{} files can be read, not written", format.name),
                   path.string());
  if (options.packing && !format.holds.isYUp)
    return failure(
        ErrorCode::usage,
        fmt::format("is for glTF (.glb, .gltf), which has compression, and not for {}", format.name),
        "packed");
  if (format.holds.sharesFile && isNoFile(path))
    return failure(ErrorCode::unsupported, "is not a file, and a GeoPackage is a database that needs one",
                   path.string());
  // The mesh and the files that it names are renamed together, or none of them is.
  OutputGroup together;
  Result<MeshWriteReport> report = writeFitted(format, mesh, path, options, context);
  if (!report) return report;
  ARETE_CHECK(together.commit());
  return report;
} catch (...) {
  return caughtFailure(path.native());
}

}  // namespace arete
