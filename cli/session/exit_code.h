// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// What `arete` tells the shell. The table of `arete --help` and of the README is exitCodeTable().
enum class ExitCode : int {
  ok = 0,
  internal = 1,
  usage = 2,
  file = 3,
  data = 4,
  promise = 5,
  interrupted = 130,  ///< 128 + SIGINT, as shells have it
};

ExitCode exitCodeOf(ErrorCode code);

/// One line per code, for people.
std::string_view exitCodeTable();

}  // namespace arete
