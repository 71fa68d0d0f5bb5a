// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/attribute.h"

namespace arete {

enum class PlyFormat { ascii, littleEndian, bigEndian };

/// The types of PLY are those of attributes.
using PlyType = ScalarType;

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
