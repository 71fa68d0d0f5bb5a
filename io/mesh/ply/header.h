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

/// @return Bytes of a value in a binary file.
std::size_t sizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the values
  bool isList = false;
  PlyType countType = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the header states it, not checked against the file's size
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< without the word "comment" and one space after it
  std::size_t dataBegin = 0;          ///< offset of the first byte behind the header
};

/// Parses the header at the start of a file (Turk's format 1.0). All lines end like the first one.
///
/// @param file The bytes of the file, from its first.
/// @param path The culprit of errors.
///
/// Errors: corrupt: a line that does not parse, with its number. unsupported: another version.
Result<PlyHeader> parsePlyHeader(std::string_view file, const std::string& path);

}  // namespace arete
