// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bound adds, per triangle, the largest vertical change of a corner and the largest shift times the
// slope.
#include "io/exchange/written_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {

namespace {

/// The length of the gradient of the triangle's plane; 0 without an area.
double slopeOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double area = ux * vy - uy * vx;
  if (area == 0) return 0;
  return std::hypot((uz * vy - vz * uy) / area, (ux * vz - vx * uz) / area);
}

double largestHeightChange(const TriangleMesh& before, const TriangleMesh& after, bool onGrid) {
  double largest = 0;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    double up = 0, sideways = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = before.positions[before.triangles[t][k]];
      const Vec3& q = after.positions[after.triangles[t][k]];
      up = std::max(up, std::abs(p.z - q.z));
      sideways = std::max(sideways, std::hypot(p.x - q.x, p.y - q.y));
    }
    if (!onGrid && sideways > 0) {
      const auto& c = before.triangles[t];
      up += sideways * slopeOf(before.positions[c[0]], before.positions[c[1]], before.positions[c[2]]);
    }
    largest = std::max(largest, up);
  }
  return largest;
}

}  // namespace

Result<WrittenMesh> writeAndReadBack(TriangleMesh mesh, const std::filesystem::path& path,
                                     const MeshWriteOptions& options, bool onGrid,
                                     const RunContext& context) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return tl::unexpected(format.error());
  if (const Status written = writeMesh(mesh, path, options, context); !written)
    return tl::unexpected(written.error());
  if (format->holds.isExact) return WrittenMesh{.mesh = std::move(mesh), .frame = {}};
  Result<MeshFile> file = readMesh(path, context);
  if (!file) return tl::unexpected(file.error());
  if (file->mesh.triangles.size() != mesh.triangles.size())
    return failure(ErrorCode::corrupt, "does not hold the triangles that were written to it", path.string());
  const double change = largestHeightChange(mesh, file->mesh, onGrid);
  return WrittenMesh{
      .mesh = std::move(file->mesh), .frame = std::move(file->frame), .heightRounding = change};
}

}  // namespace arete
