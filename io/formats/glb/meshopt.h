// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// Decodes the bytes of a buffer view of EXT_meshopt_compression.
///
/// @param source The compressed bytes.
/// @param byteStride Of the decoded elements.
/// @param mode "ATTRIBUTES", "TRIANGLES" or "INDICES".
/// @param filter "NONE" or "" for none, "OCTAHEDRAL", "QUATERNION" or "EXPONENTIAL"; of attributes only.
/// @return count * byteStride bytes. Indices may be of any value.
///
/// Errors, without a culprit: corrupt: a stride, count or filter that the mode does not allow; more elements
/// than the bytes can hold; bytes that cannot be decoded. unsupported: another mode or filter, a later
/// version of the bytes. O(count * byteStride) time; memory at most 64 times the source.
Result<std::string> decodeMeshopt(std::string_view source, std::uint64_t count, std::uint64_t byteStride,
                                  std::string_view mode, std::string_view filter);

}  // namespace arete
