// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace arete {

/// What kind of thing went wrong. The command line maps each to an exit code (README, "Exit codes").
enum class ErrorCode {
  usage,          ///< an argument that makes no sense
  notFound,       ///< a file or layer that is not there
  unreadable,     ///< a file that cannot be read or written: permissions, disk, truncated
  unsupported,    ///< a format or feature this build does not know
  corrupt,        ///< a file that is damaged, altered or hostile
  invalidData,    ///< data that parses and makes no sense
  degenerate,     ///< geometry without area: one row, all collinear, no valid sample
  brokenPromise,  ///< a stated bound or a law does not hold
  interrupted,    ///< the caller has cancelled the work
  outOfMemory,    ///< an allocation failed
};

std::string_view toString(ErrorCode code);

/// A sentence for a person, and the thing that is to blame: a path, an option, a line, an id.
struct Error {
  ErrorCode code = ErrorCode::invalidData;
  std::string message;
  std::string culprit;

  /// "culprit: message", or the message alone.
  std::string describe() const;
};

/// A value, or the reason there is none. Bad data never throws; assertions are for our own bugs.
template <class T>
using Result = tl::expected<T, Error>;

using Status = tl::expected<void, Error>;

inline tl::unexpected<Error> failure(ErrorCode code, std::string message, std::string culprit = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(culprit)});
}

}  // namespace arete
