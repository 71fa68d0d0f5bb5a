// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/criteria/space_region.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A region of space by its numbers: a box x0,y0,z0,x1,y1,z1 or a ball x,y,z,r. Errors: usage, without a
/// culprit: neither four nor six numbers, a negative radius, a box that is turned.
Result<std::shared_ptr<const SpaceRegion>> regionOfNumbers(std::span<const double> numbers);

/// What the closed mesh in a file holds. Errors: those of readMesh(); invalidData: it is not closed.
Result<std::shared_ptr<const SpaceRegion>> readRegionMesh(const std::string& path, const RunContext& context);

}  // namespace arete
