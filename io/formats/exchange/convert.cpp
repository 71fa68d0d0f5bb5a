// SPDX-License-Identifier: GPL-3.0-or-later
//
// A format that rounds is read back, so that the report states the rounding of the file as written. Whether
// anything was rounded is seen by the positions that triangles use, each once and in order: a format may
// repeat vertices and order triangles anew.
#include "io/formats/exchange/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "io/formats/exchange/grouped_faces.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/formats/exchange/written_mesh.h"
#include "io/formats/glb/texture_transform.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/crs/names.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {

namespace {

/// Replaces the CRS of the mesh by the stated one.
Status stateCrs(MeshFile& mesh, const std::string& text, Warnings& warnings) {
  if (text.empty()) return {};
  registerGdal();
  ARETE_TRY(const auto crs, crsFromUser(text));
  Georeference described;
  if (Status ok = describeCrs(crs, described); !ok) {
    ok.error().culprit = text;
    return ok;
  }
  if (compareCrs(mesh.crsWkt, described.crsWkt) == CrsAgreement::different)
    warnings.push_back(
        {WarningCode::position, fmt::format("the CRS of the file, {}, is replaced by the one stated, {}",
                                            crsName(mesh.crsWkt), crsName(described.crsWkt))});
  mesh.crsWkt = described.crsWkt;
  mesh.up = MeshUp::z;
  if (mesh.verticalUnit.empty()) mesh.verticalUnit = described.verticalUnit;
  return {};
}

/// Turns and scales the mesh as stated, for the format.
Status place(MeshFile& mesh, const ConvertOptions& options, const MeshFormat& format) {
  MeshPlacing placing = options.placing;
  if (options.crs.empty()) return placeMesh(mesh, placing, format.holds.isYUp ? MeshUp::y : MeshUp::z);
  if (!placing.unit.empty())
    return failure(ErrorCode::usage, "`crs` states the unit", fmt::format("unit {}", placing.unit));
  if (mesh.up == MeshUp::y && placing.up == MeshUp::unknown) placing.up = MeshUp::y;
  return placeMesh(mesh, placing, MeshUp::z);
}

constexpr double kUsualTolerance = 1;  // metres, of a file that states no errors

/// Leads the mesh into the place that the options state.
Status lead(MeshFile& mesh, const ConvertOptions& options, const MeshFormat& format, ConvertedMesh& converted,
            MeshWriteOptions& writing, const RunContext& context) {
  ARETE_TRY(const Georeference georeference, georeferenceOf(mesh.crsWkt, mesh.verticalUnit));
  const double tolerance = mesh.triangleErrors.empty() ? kUsualTolerance / georeference.verticalUnitMetres
                                                       : double{std::ranges::max(mesh.triangleErrors)};
  ARETE_TRY(PlacedMesh placed,
            placeInTarget(mesh.mesh, mesh.triangleErrors, georeference, options.place, format,
                          {.tolerance = tolerance, .origin = mesh.frame.origin}, context));
  const bool isSplit = placed.mesh.triangles.size() != mesh.mesh.triangles.size() ||
                       placed.mesh.positions.size() != mesh.mesh.positions.size();
  const MeshAttributes& has = mesh.mesh;
  if (isSplit &&
      (!has.vertexAttributes.empty() || !has.wedgeAttributes.empty() || !has.triangleAttributes.empty() ||
       !has.materials.empty() || !has.objects.empty() || !has.groups.empty()))
    return failure(ErrorCode::usage,
                   "bends the mesh, whose edges are split where that matters, and splits keep no attributes; "
                   "`dropAttributes` leaves them out",
                   options.place.isMetric ? "metric" : fmt::format("toCrs {}", options.place.crs));
  mesh.mesh.positions = std::move(placed.mesh.positions);
  mesh.mesh.triangles = std::move(placed.mesh.triangles);
  if (!mesh.triangleErrors.empty()) mesh.triangleErrors = placed.errors;
  mesh.crsWkt = placed.crsWkt;
  mesh.verticalUnit = placed.verticalUnit;
  mesh.metresAbout = placed.metresAbout;
  mesh.frame = {.origin = placed.origin};
  mesh.up = MeshUp::z;
  placed.describe(writing);
  writing.triangleErrors = mesh.triangleErrors;
  converted.warnings.insert(converted.warnings.end(), placed.warnings.begin(), placed.warnings.end());
  converted.placed = std::move(placed.figures);
  return {};
}

/// Makes the normals that the options ask for.
Status makeNormalsOf(MeshFile& mesh, const NormalsOptions& options, Warnings& warnings) {
  if (options.kind == NormalsKind::keep) return {};
  if (isGeographicCrs(mesh.crsWkt))
    return failure(
        ErrorCode::usage,
        "are made of lengths, and the mesh is in degrees; `metric` or `toCrs` leads it into lengths",
        "normals");
  ARETE_TRY(const MadeNormals made, makeNormals(mesh.mesh, options));
  if (made.leavesOutTangents)
    warnings.push_back(
        {WarningCode::omitted,
         "tangents are left out: they belong to other normals, and programs make them of the new ones"});
  return {};
}

std::vector<Vec3> usedPositions(const TriangleMesh& mesh) {
  std::vector<bool> isUsed(mesh.positions.size(), false);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) isUsed[v] = true;
  std::vector<Vec3> used;
  for (std::size_t v = 0; v < isUsed.size(); ++v)
    if (isUsed[v]) used.push_back(mesh.positions[v]);
  std::ranges::sort(used, {}, [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); });
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

double boxDiagonal(const std::vector<Vec3>& positions) {
  if (positions.empty()) return 0;
  Vec3 low = positions.front(), high = low;
  for (const Vec3& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return norm(high - low);
}

}  // namespace

double movedByFloats(const TriangleMesh& mesh) {
  double farthest = 0;
  for (const Vec3& p : mesh.positions)
    for (const double number : {p.x, p.y, p.z})
      farthest = std::max(farthest, std::abs(number - double{static_cast<float>(number)}));
  return farthest;
}

bool flipTextures(MeshAttributes& mesh) {
  bool has = false;
  for (auto* const attributes : {&mesh.vertexAttributes, &mesh.wedgeAttributes})
    for (Attribute& attribute : *attributes)
      if (attribute.meaning == AttributeMeaning::textureCoords) {
        attribute.isFromTop = !attribute.isFromTop;
        has = true;
      }
  return has;
}

Result<ConvertedMesh> convertMesh(MeshFile mesh, const std::filesystem::path& path,
                                  const ConvertOptions& options, const RunContext& context) {
  ARETE_TRY(const MeshFormat format, meshFormatOf(path, options.format));
  ConvertedMesh converted;
  converted.warnings = std::move(mesh.warnings);
  if (options.flipsV && !flipTextures(mesh.mesh))
    return failure(ErrorCode::usage, "the mesh has no texture coordinates", "flipV");
  const bool ofFloats = options.isOfFloats ? *options.isOfFloats : movedByFloats(mesh.mesh) == 0;
  ARETE_CHECK(place(mesh, options, format));
  ARETE_CHECK(stateCrs(mesh, options.crs, converted.warnings));
  if (!format.holds.isYUp)
    for (std::string& sentence : applyTextureTransforms(mesh.mesh, !format.holds.holdsTextureTransforms))
      converted.warnings.push_back({WarningCode::omitted, std::move(sentence)});
  MeshWriteOptions writing;
  if (options.place.isStated()) {
    ARETE_CHECK(lead(mesh, options, format, converted, writing, context));
  } else if (auto degrees = warningOfDegrees(format, mesh.crsWkt, mesh.verticalUnit)) {
    converted.warnings.push_back(std::move(*degrees));
  }
  ARETE_CHECK(makeNormalsOf(mesh, options.normals, converted.warnings));
  converted.triangles = mesh.mesh.triangles.size();
  converted.vertices = mesh.mesh.positions.size();
  converted.joinedVertices = mesh.joinedVertices;
  writing = MeshWriteOptions{.crsWkt = mesh.crsWkt,
                             .verticalUnit = mesh.verticalUnit,
                             .verticalUnitMetres = writing.verticalUnitMetres,
                             .triangleErrors = mesh.triangleErrors,
                             .origin = mesh.frame.origin,
                             .metresAbout = mesh.metresAbout,
                             .format = options.format,
                             .notes = std::move(writing.notes),
                             .existing = options.existing,
                             .up = mesh.up,
                             .pictureFolder = mesh.folder,
                             .packing = options.packing};
  std::vector<std::uint32_t> triangleOf = trianglesOfFile(mesh.mesh, format);
  const Result<WrittenMesh> written = writeAndReadBack(mesh.mesh, path, writing, true, context);
  // A CRS that this format needs and GDAL does not understand is a fault of the mesh, not of the output.
  if (!written && written.error().code == ErrorCode::invalidData && !mesh.crsWkt.empty())
    ARETE_CHECK(crsFromText(mesh.crsWkt));
  if (!written) return tl::unexpected(written.error());
  converted.frame = written->frame;
  converted.triangleOf = std::move(triangleOf);
  converted.lost = written->report.lost;
  converted.filesBeside = written->report.filesBeside;
  const auto lose = [&](bool isHeld, bool isThere, std::string what) {
    if (!isHeld && isThere) converted.lost.push_back(std::move(what));
  };
  lose(format.holds.holdsCrs, !mesh.crsWkt.empty(), "the CRS");
  lose(format.holds.holdsVerticalUnit, !mesh.verticalUnit.empty(), "the unit of the heights");
  lose(format.holds.holdsErrors, !mesh.triangleErrors.empty(), "the error of each triangle");
  if (ofFloats && format.holds.statesScalarType && mesh.up != MeshUp::z)
    converted.movedByFloats = movedByFloats(mesh.mesh);
  const Vec3& r = converted.frame.rounding;
  const bool wasExact = mesh.frame.rounding == Vec3{};
  // Of terrain, whose numbers were rounded before; any other mesh is what its file says.
  const bool isTerrain = mesh.frame.origin || mesh.up == MeshUp::z;
  if (!isTerrain) converted.diagonal = boxDiagonal(mesh.mesh.positions);
  const bool isNamed = std::ranges::any_of(
      converted.lost, [](const std::string& lost) { return lost.starts_with("coordinates finer"); });
  const bool isRounded =
      (wasExact || !isTerrain) && written->mesh && usedPositions(mesh.mesh) != usedPositions(*written->mesh);
  lose(isNamed, isRounded,
       fmt::format("coordinates finer than {:.2g}, {:.2g}, {:.2g} (x, y, height)", r.x, r.y, r.z));
  if (const Vec3& off = mesh.frame.rounding; format.holds.isExact && !wasExact && isTerrain)
    converted.warnings.push_back(
        {WarningCode::completed,
         fmt::format(
             "its coordinates are rounded, by up to {:.2g}, {:.2g}, {:.2g} (x, y, height), which {} cannot "
             "record: arete measure takes them as exact and may find samples in no triangle",
             off.x, off.y, off.z, format.name)});
  converted.crsWkt = std::move(mesh.crsWkt);
  converted.verticalUnit = std::move(mesh.verticalUnit);
  return converted;
}

}  // namespace arete
