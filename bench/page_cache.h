// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"

namespace arete::bench {

/// How much of a file lies in this system's memory, 0..1; 1 for an empty one. Errors: notFound, unreadable.
Result<double> cachedFraction(const std::string& path);

/// Asks the system to forget what it holds of a file, and says how much of it is there still, 0..1: nothing
/// where it obeyed, all of it on a file system in memory, parts where another process has it mapped. What the
/// disk and a host around this system hold is beyond reach. Precondition: this process does not map the file.
/// Errors: as cachedFraction().
Result<double> dropFromCache(const std::string& path);

/// Below it, what is read counts as cold.
constexpr double kColdFraction = 0.01;

}  // namespace arete::bench
