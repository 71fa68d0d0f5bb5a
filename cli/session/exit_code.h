// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// The exit codes of `arete`. exitCodeTable() is their table in `arete --help` and the README.
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

/// One line per code, for the help.
std::string_view exitCodeTable();

}  // namespace arete
