// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/base/vec.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "surface/model/displacement.h"

namespace arete {

/// What a cut promises of each of its triangles: at least the stored error, and beyond that as much as the
/// criterion allows around the triangle, but not more than the largest error of the cut. Where a budget ended
/// the refinement, the largest error. O(front)
/// @param criterion null: an error that is the same everywhere
std::vector<double> promisedErrors(const MultiTriangulation& mt, const Cut& cut,
                                   const BoundedCriterion* criterion);

/// The places of a cut's vertices, displaced so that every triangle stays within what is promised of it. The
/// scale of a vertex is the mean of the stored root mean squares of its triangles, by area, or what they
/// allow. Vertices whose triangles would turn by more than 60 degrees, or fold an edge by more than 120,
/// stay. O(front log front). Precondition: the displacement is of this MT.
/// @param promised by triangle of the cut, at least its stored error
std::vector<Vec3> displacedPlaces(const MultiTriangulation& mt, const SurfaceDisplacement& displacement,
                                  const Cut& cut, std::span<const double> promised);

}  // namespace arete
