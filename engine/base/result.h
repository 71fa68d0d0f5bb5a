// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace arete {

/// The kind of an error. The command line maps each to an exit code (README, "Exit codes").
enum class ErrorCode {
  usage,          ///< an invalid argument
  notFound,       ///< a file or layer does not exist
  unreadable,     ///< a file cannot be read or written: permissions, disk, truncated
  unsupported,    ///< a format or feature that this build does not have
  corrupt,        ///< a file is damaged, altered or hostile
  invalidData,    ///< data can be parsed but are invalid
  degenerate,     ///< geometry without area: one row, all collinear, no valid sample
  brokenPromise,  ///< a stated bound or a law does not hold
  interrupted,    ///< the caller has cancelled the work
  outOfMemory,    ///< an allocation failed
  internal,       ///< an exception that no code expects: a bug
};

std::string_view toString(ErrorCode code);

/// A sentence for a person, and its cause: a path, a field, a line or an id.
struct Error {
  ErrorCode code = ErrorCode::invalidData;
  std::string message;
  std::string culprit;

  /// "culprit: message", or the message alone.
  std::string describe() const;
};

/// A value, or the error that prevented it. Bad data never throws; assertions are for our own bugs.
template <class T>
using Result = tl::expected<T, Error>;

using Status = tl::expected<void, Error>;

inline tl::unexpected<Error> failure(ErrorCode code, std::string message, std::string culprit = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(culprit)});
}

}  // namespace arete
