// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Runs task(i) for 0 .. count - 1 on the context's threads, each for itself; reports progress under `stage`.
/// Errors: interrupted.
Status forEachTask(std::size_t count, const RunContext& context, const char* stage,
                   const std::function<void(std::size_t task)>& task);

}  // namespace arete
