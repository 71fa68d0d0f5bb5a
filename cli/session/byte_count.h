// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace arete {

/// "140.3 MB".
inline std::string byteCount(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  // The limits are where the rounded number would have a digit more.
  if (bytes < 999'950) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  if (bytes < 999'950'000) return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  return fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace arete
