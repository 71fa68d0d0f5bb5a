// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/query/extract/model.h"
#include "io/query/scene/scene_file.h"

namespace arete {

/// One object of an opened scene.
struct PlacedObject {
  StatedObject stated;
  std::size_t model = 0;  ///< of OpenScene::models
  /// Where it stands. With a terrain: source coordinates of it, and a height in its vertical unit; else
  /// numbers of the scene. Of a terrain: unused.
  Vec2 xy = {};
  double height = 0;
};

/// A scene whose files are read, each once. The first terrain is its ground.
struct OpenScene {
  std::vector<std::shared_ptr<const Model>> models;
  std::vector<std::string> files;  ///< of each model
  std::vector<PlacedObject> objects;
  std::optional<std::size_t> ground;  ///< object; nothing: the scene has no terrain

  /// Null where the scene has none.
  const TerrainModel* terrain() const;
};

struct SceneRead {
  OpenScene scene;
  Warnings warnings;  ///< each names its file
};

/// Opens the models of a scene (openAnyModel()), each file once, also where two paths lead to it, and finds
/// the heights of the ground. Errors, naming the object: as openAnyModel(); invalidData: a terrain with a
/// place; a surface without one beside other models; a place on the ground where there is no terrain; a
/// terrain in another CRS than the first; usage: longitudes without a CRS; interrupted. O(size of the files).
Result<SceneRead> openScene(const SceneFile& file, const RunContext& context = {});

}  // namespace arete
