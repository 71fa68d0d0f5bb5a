// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh of terrain, which has no attributes, is written as it always was, byte for byte.
#include <fmt/format.h>

#include <utility>

#include "engine/base/caught_failure.h"
#include "io/formats/common/flattened.h"
#include "io/formats/glb/glb.h"
#include "io/formats/glb/writer/container.h"
#include "io/formats/glb/writer/framed.h"
#include "io/formats/glb/writer/surface.h"

namespace arete {

namespace {

Status writeTerrain(const TriangleMesh& mesh, const std::filesystem::path& path, bool asText,
                    const MeshWriteOptions& options, const RunContext& context,
                    std::vector<std::string>& lost) {
  ARETE_TRY(const FramedPositions framed, framedPositions(mesh, options));
  if (const std::uint64_t flattened =
          countFlattened(mesh, [&](std::uint32_t v) { return framed.positions[v]; });
      flattened > 0)
    lost.push_back(flattenedLoss(flattened));
  const std::vector<float> errors = vertexErrors(mesh, options.triangleErrors);
  return writeContainer(terrainContent(mesh, framed, errors), path, asText, context);
}

bool hasAttributes(const MeshAttributes& of) {
  return !of.vertexAttributes.empty() || !of.wedgeAttributes.empty() || !of.triangleAttributes.empty() ||
         !of.objects.empty() || !of.groups.empty() || !of.materials.empty() || of.hasWedges();
}

Result<MeshWriteReport> write(MeshRef mesh, const std::filesystem::path& path, bool asText,
                              const MeshWriteOptions& options, const RunContext& context) try {
  const std::size_t triangles = mesh.shape.triangles.size();
  MeshWriteReport report;
  Status status = mesh.validate();
  if (!status) status = failure(ErrorCode::invalidData, status.error().message);
  if (status && !options.triangleErrors.empty() && options.triangleErrors.size() != triangles)
    status = failure(ErrorCode::invalidData,
                     fmt::format("{} errors for {} triangles", options.triangleErrors.size(), triangles));
  if (const int bits = options.packing ? options.packing->positionBits : 1; status && (bits < 1 || bits > 16))
    status = failure(ErrorCode::usage, "must be from 1 to 16 in a glTF, which has no longer whole numbers",
                     fmt::format("positionBits {}", bits));
  if (status && options.up == MeshUp::z && !options.packing && !hasAttributes(mesh.attributes)) {
    status = writeTerrain(mesh.shape, path, asText, options, context, report.lost);
  } else if (status) {
    Result<SurfaceContent> surface = surfaceContent(mesh, options);
    if (surface) {
      report.lost = std::move(surface->lost);
      status = writeContainer(std::move(surface->content), path, asText, context);
    } else {
      status = tl::unexpected(surface.error());
    }
  }
  if (!status && status.error().culprit.empty()) status.error().culprit = path.string();
  if (!status) return tl::unexpected(status.error());
  return report;
} catch (...) {
  return caughtFailure(path.string());
}

}  // namespace

Result<MeshWriteReport> writeGlb(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  return write(mesh, path, false, options, context);
}

Result<MeshWriteReport> writeGltf(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options, const RunContext& context) {
  return write(mesh, path, true, options, context);
}

}  // namespace arete
