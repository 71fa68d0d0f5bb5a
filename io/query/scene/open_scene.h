// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/query/scene/scene_file.h"
#include "io/query/source/any_model.h"

namespace arete {

/// A position of a surface's file, turned so that what is up in the file is along z.
inline Vec3 uprightPosition(const Vec3& p, bool isYUp) {
  return isYUp ? Vec3{p.x, -p.z, p.y} : p;
}

/// An object of a scene that is open.
struct PlacedObject {
  std::size_t model = 0;  ///< of OpenScene::models
  /// A surface has one: from the file's coordinates turned z up (uprightPosition()) to the scene's space.
  Similarity placement;
  Turn turn = {};  ///< of the placement: its heading is from the y of the scene's space
  bool isYUp = false;
};

/// A scene whose files are open. The scene's space is in metres and right-handed, z up. With terrain it is
/// the metric space of the first terrain's multitriangulation (metricPosition()), whose y is turned round
/// where that is left-handed, as it is where rows lead south (metricOf()). Without terrain x is east
/// and y north of the first object, or of 0,0 where there is no CRS, and z is the height.
struct OpenScene {
  SceneFile file;
  std::vector<std::shared_ptr<const Model>> models;  ///< each file once
  std::vector<std::string> paths;                    ///< by model: as first stated
  std::vector<PlacedObject> objects;                 ///< by object of the file
  std::optional<std::size_t> terrain;                ///< the first terrain's object
  bool isMirrored = false;                           ///< the first terrain's metric space is left-handed
  Warnings warnings;                                 ///< each names the file or the object

  const TerrainModel* terrainModel() const {
    return terrain ? std::get_if<TerrainModel>(models[objects[*terrain].model].get()) : nullptr;
  }
  const SurfaceModel* surfaceOf(std::size_t object) const {
    return std::get_if<SurfaceModel>(models[objects[object].model].get());
  }
  /// From the scene's space to the metric space of the first terrain, and back.
  Vec3 metricOf(const Vec3& p) const { return isMirrored ? Vec3{p.x, -p.y, p.z} : p; }
};

/// Opens the files of a scene, each once (openAnyModel()), and places its objects.
///
/// Errors, naming the object and the key: as openAnyModel(); invalidData: terrain with a placement or in
/// another CRS than the first, no terrain below a place whose ground is asked for, a place without
/// coordinates in the terrain's CRS, a place that is missing where there is terrain, lonlat without a CRS.
/// O(builds + objects + vertices of objects that stand on their base).
Result<OpenScene> openScene(SceneFile file, const RunContext& context = {});

}  // namespace arete
