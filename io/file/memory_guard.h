// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// Calls a function that returns a Result or a Status, and turns a failed allocation into an error.
///
/// @param culprit The path or text that the work is about.
///
/// Errors: those of the function. outOfMemory: an allocation failed, or a container would exceed its largest
/// size.
template <class Function>
auto guardMemory(const std::string& culprit, const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::outOfMemory, "needs more memory than is free", culprit);
  } catch (const std::length_error&) {
    return failure(ErrorCode::outOfMemory, "needs more memory than is free", culprit);
  }
}

}  // namespace arete
