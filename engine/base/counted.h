// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace arete {

/// Chooses the words that agree with a number: `one` for 1, `many` for 0 and for all others. Both may hold
/// the verb: agreeing(n, "face is left out", "faces are left out").
inline std::string_view agreeing(std::size_t n, std::string_view one, std::string_view many) {
  return n == 1 ? one : many;
}

/// A number and the words that agree with it: "1 triangle", "2 triangles", "0 triangles".
inline std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, agreeing(n, one, many));
}

}  // namespace arete
