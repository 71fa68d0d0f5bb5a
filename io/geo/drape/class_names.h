// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// A class of an image, as its file names and colours it.
struct DrapeClass {
  std::uint32_t number = 0;
  std::array<std::uint8_t, 4> color{};  ///< red, green, blue, opacity
  std::string name;                     ///< "class 7" where the file has none
};

/// The classes that occur in an image, in the order of their numbers: of the names of its attribute table or
/// its categories. Classes that are only in few pixels of a large image may be missing: at most about a
/// million pixels are looked at. Empty for an image of colours.
/// @param bands as openDrapeSource() takes them
/// Errors: as openDrapeSource(); unreadable.
Result<std::vector<DrapeClass>> readDrapeClasses(const std::string& path, const std::vector<int>& bands = {});

}  // namespace arete
