// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

namespace arete {

/// Thrown in place of an allocation that would exceed the memory budget (engine/memory/required_memory.h).
/// caughtFailure() makes of it an error of outOfMemory with its sentence.
class MemoryRefusal : public std::bad_alloc {
 public:
  /// @param sentence  Kept in the object, so that it is there without an allocation; cut after 383 bytes.
  explicit MemoryRefusal(std::string_view sentence) noexcept {
    std::ranges::copy(sentence.substr(0, text_.size() - 1), text_.begin());
  }
  const char* what() const noexcept override { return text_.data(); }

 private:
  std::array<char, 384> text_{};
};

}  // namespace arete
