// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "terrain/laws/model_rows.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Of how many triangles law 10 was checked.
struct ErrorsChecked {
  std::uint64_t triangles = 0, checked = 0;
  bool areAll() const { return checked == triangles; }
};

/// Checks law 10: the error and the bound stored with a triangle are at least the true ones over the heights
/// in the model, by exact arithmetic where doubles do not decide. Shares no code with the build.
///
/// @param everyTriangle  false: of a large model the root's triangles and a random sample of the others
/// @param finest  the finest front
/// @param rows  of a part of a raster's model: where the law is checked; nothing: everywhere
/// Errors: brokenPromise: the first triangle that fails; interrupted. O(samples covered by what is checked).
Result<ErrorsChecked> validateErrors(const TerrainModel& model, const Cut& finest, bool everyTriangle,
                                     std::uint64_t seed, const RunContext& context = {},
                                     const std::optional<ModelRows>& rows = std::nullopt);

}  // namespace arete
