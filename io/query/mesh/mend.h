// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/surface/mesh_input.h"
#include "surface/repair/repair.h"

namespace arete {

struct MendOptions {
  /// Border vertices within this distance are joined, in the unit of the file. Empty: within the distance
  /// that the rounding of the file explains, if there are any.
  std::optional<double> weld = {};
  RepairOptions repair = {};  ///< its rounding and partOf come from the file
};

/// How border vertices were joined.
struct WeldOutcome {
  double distance = 0;
  bool isOfRounding = false;  ///< not stated: what rounding has moved apart
  double diagonal = 0;        ///< of the box of the mesh
  std::uint64_t vertices = 0, edges = 0;
  double farthestMove = 0;
};

struct MendedMesh {
  std::optional<WeldOutcome> welded;
  RepairedMesh repaired;
};

/// Welds and mends the mesh in the input, with its attributes, and the errors of its triangles as far as they
/// hold. The warnings of the file give way to what the mending warns of. Errors: as joinSurface(),
/// repair() and diagnose(); invalidData: no face is left. O(n log n).
Result<MendedMesh> mendMesh(MeshInput& input, const MendOptions& options, const RunContext& context = {});

/// What was done, as `arete mesh repair --json` prints it: welded, mended, rounding, openHoles,
/// crossingParts. Every count is there, zeros included, so that programs need no defaults.
nlohmann::ordered_json mendJson(const MendedMesh& mended, double rounding);

}  // namespace arete
