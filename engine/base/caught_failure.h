// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// Turns the exception that is being handled into an error. Every public function that returns a Result or a
/// Status ends in `catch (...) { return caughtFailure(); }`, so that no exception leaves it. Errors:
/// outOfMemory: the exception is std::bad_alloc or std::length_error, or says that no thread can be started;
/// internal: it is any other one.
/// Precondition: called within a catch block.
/// @param culprit The path or text that the work is about; left out where there is no memory even for it.
tl::unexpected<Error> caughtFailure(std::string_view culprit = {}) noexcept;

}  // namespace arete
