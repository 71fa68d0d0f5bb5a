// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/grouped.h"

#include <fmt/format.h>

#include "engine/base/counted.h"

namespace arete {

/// Digits stand in groups of three, with a blank between them.
std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3;) text.insert(i -= 3, 1, ' ');
  return text;
}

std::string grouped(std::uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(count), agreeing(count, one, many));
}

}  // namespace arete
