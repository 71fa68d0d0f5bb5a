// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace arete {

/// 769671 as "769 671".
std::string grouped(std::uint64_t count);
/// "769 671 triangles", "1 triangle": with the words of engine/base/counted.h.
std::string grouped(std::uint64_t count, std::string_view one, std::string_view many);

/// "140.3 MB", "12 bytes".
std::string byteCount(std::uint64_t bytes);

}  // namespace arete
