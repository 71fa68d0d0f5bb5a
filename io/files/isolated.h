// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// What work in a process of its own may take.
struct IsolationLimits {
  std::uint64_t memoryBytes = 0;  ///< that it may add to the memory of this process
  std::uint64_t answerBytes = 0;
  unsigned seconds = 60;  ///< of processor time
};

/// Runs work on hostile bytes in a process of its own, for libraries that do not check their input: whatever
/// they read or write beyond their arrays, this process and its memory stay as they are.
///
/// The process is a fork() of this one: the work sees all memory, and must not start threads, take locks
/// that another thread may hold, or write files. It prints nothing.
///
/// Errors, without a culprit: those that the work returns. corrupt: the process ended by a crash or a limit.
/// outOfMemory: it could not be started. interrupted.
Result<std::string> runIsolated(const std::function<Result<std::string>()>& work,
                                const IsolationLimits& limits, const RunContext& context = {});

}  // namespace arete
