// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/formats/common/file.h"
#include "io/formats/glb/writer/container.h"

namespace arete {

/// A glTF of a mesh with everything that the format holds.
struct SurfaceContent {
  GltfContent content;
  std::vector<std::string> lost;  ///< as in MeshWriteReport
};

/// Corners with values of their own make vertices of their own; each object becomes a node, each of its
/// materials a primitive. With options.up z the positions are those of framedPositions(), and triangle errors
/// are written by vertex; else they are as they are, if 32-bit floats hold them, or relative to the
/// translation of the nodes.
///
/// Errors: those of framedPositions(). invalidData: a position beyond 32-bit floats; 2^32 vertices.
/// O(size) memory and time; O(n log n) with wedges.
Result<SurfaceContent> surfaceContent(MeshRef mesh, const MeshWriteOptions& options);

}  // namespace arete
