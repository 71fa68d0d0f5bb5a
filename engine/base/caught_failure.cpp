// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/caught_failure.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "engine/base/memory_refusal.h"

namespace arete {
namespace {

/// With the culprit where there is memory for it. The message alone is short enough for std::string to hold
/// it without an allocation.
tl::unexpected<Error> outOfMemory(std::string_view culprit) noexcept {
  try {
    return failure(ErrorCode::outOfMemory, "out of memory", std::string(culprit));
  } catch (...) {
    return failure(ErrorCode::outOfMemory, "out of memory");
  }
}

tl::unexpected<Error> refused(const char* sentence, std::string_view culprit) noexcept {
  try {
    return failure(ErrorCode::outOfMemory, sentence, std::string(culprit));
  } catch (...) {
    return outOfMemory(culprit);
  }
}

tl::unexpected<Error> noThread(std::string_view culprit) noexcept {
  try {
    return failure(ErrorCode::outOfMemory,
                   "no thread can be started: memory or the number of threads is limited",
                   std::string(culprit));
  } catch (...) {
    return outOfMemory(culprit);
  }
}

}  // namespace

tl::unexpected<Error> caughtFailure(std::string_view culprit) noexcept {
  try {
    throw;
  } catch (const MemoryRefusal& refusal) {
    return refused(refusal.what(), culprit);
  } catch (const std::bad_alloc&) {
    return outOfMemory(culprit);
  } catch (const std::length_error&) {
    return outOfMemory(culprit);
  } catch (const std::exception& error) {
    // A thread that cannot be started is an exception of std::thread or of TBB.
    if (std::string_view(error.what()).find("Resource temporarily unavailable") != std::string_view::npos)
      return noThread(culprit);
    try {
      return failure(ErrorCode::internal, error.what(), std::string(culprit));
    } catch (...) {
      return outOfMemory(culprit);
    }
  } catch (...) {
    return failure(ErrorCode::internal, "a bug");
  }
}

}  // namespace arete
