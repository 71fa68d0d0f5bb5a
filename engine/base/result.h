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

/// ARETE_TRY(const Mesh mesh, readMesh(path)); declares `mesh` as the value of the result, or returns its
/// error from the function, whose own result may be of another type. The expression is evaluated once.
#define ARETE_TRY(value, ...) ARETE_TRY_NAMED(ARETE_NAME_OF_LINE(result, __LINE__), value, __VA_ARGS__)

/// ARETE_CHECK(file.finish()); returns the error of a status, or of a result whose value is not used.
#define ARETE_CHECK(...) ARETE_CHECK_NAMED(ARETE_NAME_OF_LINE(status, __LINE__), __VA_ARGS__)

#define ARETE_CHECK_NAMED(status, ...)                                                          \
  do {                                                                                          \
    if (auto&& status = __VA_ARGS__; !status) return tl::unexpected(std::move(status).error()); \
  } while (false)

#define ARETE_TRY_NAMED(result, value, ...)                      \
  auto result = __VA_ARGS__;                                     \
  if (!result) return tl::unexpected(std::move(result).error()); \
  value = *std::move(result)
#define ARETE_NAME_OF_LINE(name, line) ARETE_JOINED(name, line)
#define ARETE_JOINED(name, line) name##_of_line_##line
