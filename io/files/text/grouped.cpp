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

std::string byteCount(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  // The limits are where the rounded number would have a digit more.
  if (bytes < 999'950) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  if (bytes < 999'950'000) return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  return fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace arete
