// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/decimate/contractions.h"

namespace arete {

/// Gives the corners and vertices of a result the attributes of the source where it is nearest to them: each
/// triangle looks on the part of the source around its face (DecimatedMesh::faceOf) that hangs together with
/// it without crossing a line, so that it takes nothing from beyond a seam or from another sheet. Continuous
/// attributes are interpolated, labels come from the nearest corner. Corners of a vertex that find the same
/// point have one wedge. O(n log n) in practice.
void takeNearestAttributes(const FramedMesh& source, DecimatedMesh& result);

}  // namespace arete
