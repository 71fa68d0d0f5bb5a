// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/region.h"

#include "io/formats/exchange/mesh_formats.h"
#include "surface/region/closed_mesh_region.h"

namespace arete {

Result<std::shared_ptr<const SpaceRegion>> regionOfNumbers(std::span<const double> n) {
  if (n.size() != 4 && n.size() != 6)
    return failure(ErrorCode::usage, "a region is a box x0,y0,z0,x1,y1,z1 or a ball x,y,z,r");
  if (n.size() == 4) {
    if (!(n[3] >= 0)) return failure(ErrorCode::usage, "the radius is negative");
    return std::make_shared<BallRegion>(Vec3{n[0], n[1], n[2]}, n[3]);
  }
  if (!(n[0] <= n[3] && n[1] <= n[4] && n[2] <= n[5]))
    return failure(ErrorCode::usage, "the lowest coordinates come first, then the highest");
  return std::make_shared<BoxRegion>(Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]});
}

Result<std::shared_ptr<const SpaceRegion>> readRegionMesh(const std::string& path,
                                                          const RunContext& context) {
  ARETE_TRY(const MeshFile file, readMesh(path, context));
  const auto region = ClosedMeshRegion::create(file.mesh);
  if (!region) return failure(region.error().code, region.error().message, path);
  return std::shared_ptr<const SpaceRegion>(*region);
}

}  // namespace arete
