// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// The parts of a multitriangulation that are in graphics memory, written once.
struct TerrainOnGpu {
  /// Of every vertex: x, y, z in metric space; and its rise, which moves while it is geomorphed.
  GlBuffer positions, rises;
  GlBuffer
      places;  ///< on a curved Earth: x, y, z in the flat metric space; else empty, as positions are these
  GlBuffer triangleErrors;  ///< codes of OutwardScale, two a word; empty until they are needed

  /// Input of the compute shaders; empty if the device cannot run them (see refusal).
  GlBuffer roots, nodes, nodeBalls, blockBalls, blockErrors, links, removers, morphs;
  /// Why the device cannot compute cuts, or empty.
  std::string refusal;

  std::uint32_t vertices = 0, nodeCount = 0, rootTriangles = 0, rootVertices = 0, blocks = 0, pages = 0;
};

/// `flat`: the MT that a curved one (engine/mt/curved_mt.h) was made of. The vertices are always
/// uploaded. O(size of the MT).
TerrainOnGpu uploadTerrain(const MultiTriangulation& mt, const MultiTriangulation* flat = nullptr,
                           const RunContext& context = {});

/// Of all triangles: 2 bytes each.
void uploadErrors(TerrainOnGpu& terrain, const MultiTriangulation& mt);

}  // namespace arete
