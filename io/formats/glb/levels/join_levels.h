// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A GLB of Arete, and what is known of it.
struct GltfLevel {
  std::filesystem::path file;
  double error = 0;  ///< stated in the extras of its node
  std::uint64_t triangles = 0;
};

/// Writes one glTF with the levels of detail of MSFT_lod: the scene shows the level of most triangles, whose
/// node names the others, from fine to coarse. A program without the extension so draws the finest. Each
/// level is a node of its own, with "error" and "triangles" in extras.arete. Pictures and materials that
/// levels have in common are written once. The asset comes from the finest.
///
/// Errors: as FileBytes::read() and writeContainer(). corrupt: a level was not written by Arete as a GLB, or
/// shows nothing. O(size).
Status joinGltfLevels(std::vector<GltfLevel> levels, const std::filesystem::path& path, bool asText,
                      const RunContext& context = {});

}  // namespace arete
