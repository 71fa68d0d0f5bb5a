// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/caught_failure.h"

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
  } catch (...) {
    return caughtFailure(culprit);
  }
}

}  // namespace arete
