// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/picture_length.h"

#include <array>
#include <cmath>
#include <vector>

#include "surface/attributes/attribute_distance.h"

namespace arete {

double lengthOfPictureUnit(const SurfaceMesh& mesh, const Attribute& coordinates, bool ofWedges) {
  if (coordinates.components < 2) return 0;
  const AttributeDistance distance(coordinates);
  double inSpace = 0, inPicture = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    std::array<Vec3, 3> places, drawn;
    for (std::size_t c = 0; c < 3; ++c) {
      places[c] = mesh.positions[mesh.triangles[f][c]];
      const std::vector<double> uv =
          distance.values(coordinates, ofWedges ? mesh.wedges[f][c] : mesh.triangles[f][c]);
      drawn[c] = {uv[0], uv[1], 0};
    }
    const auto areaOf = [](const std::array<Vec3, 3>& t) {
      return norm(cross(t[1] - t[0], t[2] - t[0])) / 2;
    };
    const double covered = areaOf(drawn);
    if (!std::isfinite(covered) || !(covered > 0)) continue;
    inPicture += covered;
    inSpace += areaOf(places);
  }
  return inPicture > 0 ? std::sqrt(inSpace / inPicture) : 0;
}

}  // namespace arete
