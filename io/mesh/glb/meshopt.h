// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// Stands in for the decoder of EXT_meshopt_compression.
Result<std::string> decodeMeshopt(std::string_view source, std::uint64_t count, std::uint64_t byteStride,
                                  std::string_view mode, std::string_view filter);

}  // namespace arete
