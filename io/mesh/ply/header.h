// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace arete {

enum class PlyFormat { ascii, littleEndian, bigEndian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t sizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the values
  bool isList = false;
  PlyType countType = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< what the header claims; nobody has checked it
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< without the word "comment" and the blank after it
  std::size_t dataBegin = 0;          ///< offset of the first byte behind the header
};

/// The header at the start of `file` (Turk's format 1.0; lines end as the first one does).
/// Errors: corrupt, naming `path` and the line; unsupported for another version.
Result<PlyHeader> parsePlyHeader(std::string_view file, const std::string& path);

}  // namespace arete
