// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/session/exit_code.h"

namespace arete {

ExitCode exitCodeOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return ExitCode::usage;
    case ErrorCode::notFound:
    case ErrorCode::unreadable:
    case ErrorCode::unsupported:
      return ExitCode::file;
    case ErrorCode::corrupt:
    case ErrorCode::invalidData:
    case ErrorCode::degenerate:
      return ExitCode::data;
    case ErrorCode::brokenPromise:
      return ExitCode::promise;
    case ErrorCode::interrupted:
      return ExitCode::interrupted;
    case ErrorCode::outOfMemory:
    case ErrorCode::internal:
      return ExitCode::internal;
  }
  return ExitCode::internal;
}

std::string_view exitCodeTable() {
  return "Exit codes:\n"
         "    0  done\n"
         "    1  an unexpected failure: out of memory, or a bug\n"
         "    2  the command line is invalid\n"
         "    3  a file is missing, cannot be read or written, or has an unknown format\n"
         "    4  the data is invalid, degenerate or corrupt\n"
         "    5  a promise is broken: an error above --expect, a law that does not hold\n"
         "  130  interrupted (Ctrl-C); no partial file is left";
}

}  // namespace arete
