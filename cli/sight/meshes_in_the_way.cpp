// SPDX-License-Identifier: GPL-3.0-or-later
//
// Terrain and meshes are asked apart; what is nearer to the first end is the obstruction.
#include "cli/sight/meshes_in_the_way.h"

#include <cmath>

#include "io/query/sight/scene_sight.h"

namespace arete {

Result<std::vector<std::string>> addMeshesInTheWay(const OpenScene& scene, const TerrainModel& model,
                                                   std::span<const SightPath> paths, const SightEarth& earth,
                                                   std::vector<Result<SightPathAnswer>>& answers,
                                                   const RunContext& context) {
  const SceneSight sight(scene, model);
  ARETE_TRY(const auto meshes, sight.first(paths, earth, context));
  std::vector<std::string> blockedBy(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!answers[i]) continue;
    SightAnswer& answer = answers[i]->sight;
    const bool isBlocked = answer.verdict == SightVerdict::blocked;
    const auto& mesh = meshes[i];
    if (mesh && !(isBlocked && answer.obstruction && answer.obstruction->distance <= mesh->distance)) {
      answer.verdict = SightVerdict::blocked;
      answer.isTouching = false;
      answer.obstruction = SightPlace{mesh->distance, mesh->plan, mesh->height, mesh->height};
      blockedBy[i] = scene.file.objects[mesh->object].name;
    } else if (isBlocked) {
      const bool isVoid = answer.obstruction && std::isnan(answer.obstruction->terrainHeight);
      blockedBy[i] = isVoid ? "nodata" : "terrain";
    }
  }
  return blockedBy;
}

}  // namespace arete
