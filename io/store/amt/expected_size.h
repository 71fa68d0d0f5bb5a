// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/model/surface_mesh.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// About how large the .amt of a heightfield will be, in bytes.
struct ExpectedAmtSize {
  double plain = 0, packed = 0;
};

/// Foretells the size of a file before the model is built.
///
/// Of rasters of 10 000 samples and more, the plain form is within a tenth, and the packed one of terrain
/// within a third; of smaller ones, and of generated surfaces that repeat themselves, within a factor of 2.
/// So is the packed form of scattered points, whose coordinates may have any number of digits. Measured on 13
/// public DEMs of 14 641 to 1 442 401 samples, in the shapes delaunay and fidelity. O(heights).
ExpectedAmtSize expectedAmtSize(const RasterHeightfield& field);
ExpectedAmtSize expectedAmtSize(const PointHeightfield& field);

/// The same of a surface: within a quarter without attributes of corners, within a factor of 2.5 with them,
/// where seams and the kinds of attributes decide. Pictures are left out. Measured on seven meshes.
/// O(vertices).
ExpectedAmtSize expectedAmtSize(const SurfaceMesh& mesh);

}  // namespace arete
