// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/displacement.h"
#include "surface/model/surface_model.h"

namespace arete {

/// Finds directions that make the mean square of the distances small in all cuts, and how far each triangle's
/// corners may follow them. Stored errors stay as they are. Vertices of borders that the build keeps are not
/// displaced.
///
/// The result does not depend on the number of threads, nor, but for rounding, on the unit.
/// O(n log n); about 300 bytes a vertex. Errors: interrupted.
Result<SurfaceDisplacement> findDisplacement(const SurfaceModel& model, const RunContext& context = {});

}  // namespace arete
