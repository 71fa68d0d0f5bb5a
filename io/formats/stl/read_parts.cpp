// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/stl/read_parts.h"

#include <fmt/format.h>

#include <utility>

namespace arete {

void StlTriangles::finish(MeshFile& file, const Vec3& origin) {
  if (2 * against_ > size())
    file.warnings.push_back(
        {WarningCode::completed,
         fmt::format(
             "the normals of {} of its {} facets point to the other side than the order of the corners "
             "says; the order is what counts here",
             against_, size())});
  static_cast<TriangleMesh&>(file.mesh) = std::move(mesh_);
  file.frame.rounding = {float32Rounding(largest_.x, origin.x), float32Rounding(largest_.y, origin.y),
                         float32Rounding(largest_.z, origin.z)};
}

}  // namespace arete
