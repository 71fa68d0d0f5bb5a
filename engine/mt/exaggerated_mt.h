// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/mt/multitriangulation.h"

namespace arete {

/// The same multitriangulation in a metric space whose heights are multiplied: vertical exaggeration. Its
/// heights, errors and tolerances in the unit of heights are as they were; the scale of the z axis of its
/// MetricFrame, the spheres and what is derived from them are others, so that a ViewError counts pixels of
/// the exaggerated terrain and law 6 holds. Keeps the given one alive. 17 bytes per node. Precondition: the
/// factor is finite and > 0. O(N), children before parents.
MultiTriangulation exaggerated(const MultiTriangulation& mt, double factor);

}  // namespace arete
