// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"
#include "io/formats/off/keyword.h"

namespace arete {

/// The first line of a binary OFF: the keyword, "BINARY" and a line feed.
struct OffBinaryBegin {
  OffKeyword keyword;
  std::size_t size = 0;  ///< of the line, with its end
};

/// Nothing where the file is not a binary OFF.
std::optional<OffBinaryBegin> binaryOffBegin(std::string_view file);

/// Reads Geomview's binary OFF: behind the first line whole numbers and floats of 32 bits, big-endian. The
/// counts of vertices, faces and edges; of each vertex its coordinates and what the keyword says, in
/// Geomview's order, colors as four floats; of each face the number of its corners, the corners, the number
/// of the parts of its color (0 to 4) and these as floats.
///
/// Errors, with `path` as culprit: corrupt: the file ends before or after what its counts say, a number that
/// is out of range. unsupported: no face of three or more corners. interrupted. O(file size).
Result<MeshFile> readBinaryOff(std::string_view file, const OffBinaryBegin& begin, const std::string& path,
                               const RunContext& context);

}  // namespace arete
