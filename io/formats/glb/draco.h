// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/attribute.h"

namespace arete {

/// An attribute of a mesh that Draco compressed.
struct DracoAttribute {
  int uniqueId = 0;  ///< by which a glTF names it
  int components = 0;
  ScalarType type = ScalarType::float32;  ///< as it was before compression
  bool normalized = false;
  std::string bytes;  ///< point by point, component by component
};

struct DracoMesh {
  std::uint64_t points = 0;
  std::vector<std::uint32_t> indices;  ///< three for each triangle, each below `points`
  std::vector<DracoAttribute> attributes;
};

/// Decodes the bytes of KHR_draco_mesh_compression. libdraco checks little of what it reads, so it decodes in
/// a process of its own, in limited memory (io/files/isolated.h).
///
/// Attributes of 64-bit integers or of bool, which glTF has not, are left out.
///
/// @param mostBytes That the indices, at four bytes each, and the attributes together may take.
///
/// Errors, without a culprit: corrupt: libdraco refuses it, crashes or needs too much; more than mostBytes.
/// unsupported: no triangle mesh, or a bitstream that libdraco does not know. outOfMemory, interrupted.
Result<DracoMesh> decodeDraco(std::string_view bytes, std::uint64_t mostBytes,
                              const RunContext& context = {});

}  // namespace arete
