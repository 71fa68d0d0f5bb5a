// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/byte_size.h"

#include <array>
#include <charconv>
#include <utility>

namespace arete {

std::optional<std::uint64_t> parseByteSize(std::string_view text) {
  constexpr double kMost = 1e18;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const std::string_view unit(end, text.data() + text.size());
  constexpr std::array<std::pair<std::string_view, double>, 15> kUnits = {{{"", 1},
                                                                           {"B", 1},
                                                                           {"kB", 1e3},
                                                                           {"KB", 1e3},
                                                                           {"MB", 1e6},
                                                                           {"GB", 1e9},
                                                                           {"TB", 1e12},
                                                                           {"K", 0x1p10},
                                                                           {"M", 0x1p20},
                                                                           {"G", 0x1p30},
                                                                           {"T", 0x1p40},
                                                                           {"KiB", 0x1p10},
                                                                           {"MiB", 0x1p20},
                                                                           {"GiB", 0x1p30},
                                                                           {"TiB", 0x1p40}}};
  for (const auto& [name, factor] : kUnits) {
    const double bytes = number * factor;
    if (unit == name && bytes >= 0 && bytes <= kMost) return static_cast<std::uint64_t>(bytes);
  }
  return std::nullopt;
}

}  // namespace arete
