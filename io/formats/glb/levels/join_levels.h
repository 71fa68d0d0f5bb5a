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
  double unit = 1;  ///< of the error, in the unit of the file's places
};

/// Writes one glTF with the levels of detail of MSFT_lod: the scene shows the level of most triangles, whose
/// node names the others, from fine to coarse. A program without the extension so draws the finest. Each
/// level is a node of its own, with "error" and "triangles" in extras.arete. Pictures and materials that
/// levels have in common are written once. "MSFT_screencoverage" in the extras of the finest has a number for
/// each level: of the part of a picture of 1920 x 1080 pixels that a ball around everything covers, the least
/// at which the level is needed, as the error of the next one is a pixel there; the last is 0. The asset
/// comes from the finest.
///
/// Errors: as FileBytes::read() and writeContainer(). corrupt: a level was not written by Arete as a GLB, or
/// shows nothing. O(size).
Status joinGltfLevels(std::vector<GltfLevel> levels, const std::filesystem::path& path, bool asText,
                      const RunContext& context = {});

}  // namespace arete
