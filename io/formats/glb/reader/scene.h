// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/formats/glb/document.h"
#include "io/formats/glb/reader/left_out.h"
#include "io/formats/glb/reader/transform.h"

namespace arete {

/// A mesh where a node of the scene puts it. A node with instances (EXT_mesh_gpu_instancing) puts it to
/// several places, which follow each other.
struct GltfPlacement {
  std::uint64_t node = 0, mesh = 0;
  Affine placed;
};

/// The meshes of the default scene; without a scene, of all nodes. In the order of a walk that visits a node
/// before its children. A node with a skin counts as one without; `leftOut` counts it.
///
/// Errors, without a culprit: corrupt: a node that does not exist or has two parents, a damaged transform.
/// unsupported: more than `most` places.
Result<std::vector<GltfPlacement>> placedMeshes(const GltfDocument& document, std::uint64_t most,
                                                GltfLeftOut& leftOut);

}  // namespace arete
