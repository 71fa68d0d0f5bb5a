// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/result.h"

namespace arete {

std::string_view toString(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return "usage";
    case ErrorCode::notFound:
      return "not found";
    case ErrorCode::unreadable:
      return "unreadable";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::corrupt:
      return "corrupt";
    case ErrorCode::invalidData:
      return "invalid data";
    case ErrorCode::degenerate:
      return "degenerate";
    case ErrorCode::brokenPromise:
      return "broken promise";
    case ErrorCode::interrupted:
      return "interrupted";
    case ErrorCode::outOfMemory:
      return "out of memory";
    case ErrorCode::internal:
      return "internal";
  }
  return "unknown";
}

std::string Error::describe() const {
  return culprit.empty() ? message : culprit + ": " + message;
}

}  // namespace arete
