// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/cut/cut.h"
#include "surface/model/surface_model.h"

namespace arete {

/// For every face of the source the triangle of a cut that stands for its middle, by their numbers. A face
/// that the build left out has that of the face in which it lies; kNone if it touches none (leftOutFaces).
/// From the finest triangle a face climbs, where a node of the cut's complement put it, to the nearest
/// triangle of what the node replaced. O(faces * depth).
/// @throw std::bad_alloc where the source's faces, which are only stated, are more than the memory holds.
std::vector<std::uint32_t> facesOf(const SurfaceModel& model, const Cut& cut);

/// A triangle of the finest front, and the one of a cut which stands for its middle.
struct FaceInCut {
  std::uint32_t finest = 0;  ///< of the MT
  Vec3 middle;
  std::uint32_t triangle = 0;  ///< its number in the cut
};

/// Some finest triangles, spread evenly over their numbers, each with one on its side of every seam; those
/// that have none are left out. O(triangle ids + most * depth)
std::vector<FaceInCut> someFacesOf(const SurfaceModel& model, const Cut& cut, std::uint32_t most);

}  // namespace arete
