// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/mt/multitriangulation.h"

namespace arete {

/// The same multitriangulation in a metric space with vertical exaggeration. Heights, errors and tolerances
/// in the unit of heights do not change. The z scale of its MetricFrame, the spheres and everything derived
/// from them do, so that a ViewError counts pixels of the exaggerated terrain and law 6 holds. Keeps the
/// given one alive. Memory: 17 bytes per node. O(N). Precondition: the factor is finite and > 0.
MultiTriangulation exaggerated(const MultiTriangulation& mt, double factor);

}  // namespace arete
