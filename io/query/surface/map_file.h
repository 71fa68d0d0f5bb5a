// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "surface/front/face_map.h"

namespace arete {

/// Which of the source a mesh is made of, by numbers from 0.
struct NumberMap {
  std::span<const std::uint32_t> vertexOf;     ///< by vertex of the result: of the source
  std::span<const std::uint32_t> triangleFor;  ///< by face of the source: of the result, or kNone
  /// The number in the file of a vertex and a face of the source; null: their own.
  std::function<std::uint64_t(std::uint32_t)> vertexOfFile = {}, faceOfFile = {};
};

/// Writes a CSV "what,output,input" with a row for every vertex of the result and for every face of the
/// source that a triangle stands for. The file appears whole or not at all. Errors: as FileWriter.
/// O(rows)
Status writeNumberMap(const std::string& path, const NumberMap& map);

/// Numbers triangles as a file has them, in another order than the mesh.
/// @param triangleOf  trianglesOfFile(); empty: the order of the mesh
void renumberForFile(std::span<std::uint32_t> triangleFor, const std::vector<std::uint32_t>& triangleOf);

}  // namespace arete
