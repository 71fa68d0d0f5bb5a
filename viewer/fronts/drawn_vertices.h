// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/model/surface_model.h"
#include "viewer/fronts/z_up_frame.h"

namespace arete {

/// The vertices of a surface as they are drawn where nothing moves them: one for each wedge, or for each
/// vertex of the MT where there are no wedges.
struct DrawnVertices {
  std::vector<float> positions;      ///< 3 a vertex, upright
  std::vector<float> normals;        ///< 3 a vertex, upright; zero: the triangle's own is to be used
  std::vector<float> smoothNormals;  ///< the same without those that the file states; empty: it states none
  std::vector<float> textureCoords;  ///< 4 a vertex: two sets, v from the upper side; empty without
  std::vector<std::uint8_t> colors;  ///< 4 a vertex, sRGB and alpha; empty without

  std::size_t size() const { return positions.size() / 3; }
};

/// O(vertices + triangles of the MT). `colors`: 4 bytes a drawn vertex, instead of the model's.
DrawnVertices drawnVertices(const SurfaceModel& model, const ZUpFrame& upright,
                            std::vector<std::uint8_t> colors = {});
/// The places of the drawn vertices in the file.
std::vector<Vec3> drawnPlaces(const SurfaceModel& model);

}  // namespace arete
