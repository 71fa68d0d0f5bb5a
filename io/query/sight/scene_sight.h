// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/scene/open_scene.h"
#include "terrain/sight/paths.h"

namespace arete {

/// The first place at which a mesh is in the way of a line.
struct MeshObstruction {
  std::size_t object = 0;  ///< of the scene
  double distance = 0;     ///< metres along the ground from the first end
  Vec2 plan;               ///< plan coordinates
  double height = 0;       ///< of the line there, in the terrain's vertical unit
};

/// The meshes of a scene as obstacles of lines of sight, at full resolution.
///
/// A mesh is in the way of a line if it meets both the line raised and the line lowered by
/// SightLine::tolerance(): touching from above or below does not block, as with terrain, and a line through
/// an edge or a vertex inside a mesh is blocked. Nothing within kSightEndMetres of an end blocks. Open meshes
/// block from both sides; a line inside an upright face passes along it. Objects that are not visible in
/// the scene are not in the way. Thread-safe.
class SceneSight {
 public:
  /// O(triangles log triangles) of each model, once.
  /// @param plan whose plan coordinates and unit of heights the lines have: the scene's first terrain; of a
  /// scene without terrain an empty model, whose plan is the scene's space. Both outlive this.
  SceneSight(const OpenScene& scene, const TerrainModel& plan);
  ~SceneSight();

  /// @return nothing where no mesh is in the way. O(legs + boxes near the line).
  std::optional<MeshObstruction> first(const SightLine& line) const;
  /// Of many paths over the terrain, in parallel; one that has no line (sightLine()) has no answer. Errors:
  /// interrupted.
  Result<std::vector<std::optional<MeshObstruction>>> first(std::span<const SightPath> paths,
                                                            const SightEarth& earth,
                                                            const RunContext& context = {}) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace arete
