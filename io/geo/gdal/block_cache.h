// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Sets how many bytes of rasters GDAL keeps at most. Without it that is a twentieth of the machine's memory.
void boundGdalCache(std::uint64_t bytes);

}  // namespace arete
