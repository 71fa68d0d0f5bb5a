// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/session/session.h"
#include "cli/view/arguments.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/scene/open_scene.h"
#include "viewer/gl/scene.h"

namespace arete {

/// The two files of `view A --beside B` as a scene in their own coordinates. Errors: usage, naming the
/// option: keys, scenes, distances of terrain; as openScene(), also for files of two kinds.
Result<OpenScene> openBeside(const ViewArguments& arguments, const RunContext& context);

/// How far two surfaces are from each other.
struct ColoredDistances {
  std::array<std::vector<std::uint8_t>, 2> colors;  ///< of the drawn vertices of each
  Json json;                                        ///< by object: the largest and the mean
  Legend legend;
};
/// Of both surfaces of openBeside(). Errors: interrupted. O(n log n).
Result<ColoredDistances> distancesOf(const OpenScene& scene, const RunContext& context);

}  // namespace arete
