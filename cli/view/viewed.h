// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/session/session.h"
#include "cli/view/arguments.h"
#include "cli/view/layers.h"
#include "engine/base/result.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/query/extract/model.h"
#include "io/query/pages/resident_pages.h"
#include "io/query/scene/open_scene.h"
#include "viewer/gl/scene.h"
#include "viewer/scene/heights_of_contours.h"
#include "viewer/scene/subject.h"

namespace arete {

/// A model of either kind or a scene, as the window and the pictures take it.
struct Viewed {
  std::shared_ptr<const Subject> subject;
  std::uint64_t finestTriangles = 0;
  Georeference georeference = {};
  LongitudeTurns turns = {};
  std::optional<Camera> camera = {};                 ///< that is stated
  std::string source = {};                           ///< that is not to be overwritten
  std::vector<std::string> files = {};               ///< by object; empty of a terrain
  std::shared_ptr<const TerrainColors> colors = {};  ///< that are stated
  std::shared_ptr<const StatedLayers> layers = {};   ///< over a terrain
  bool isOfPages = false;                            ///< a model that is read as the camera needs it
  FillScene addModel;                                ///< keeps the model
  WriteHeights heightsOfContours = {};               ///< as addModel; empty of a surface
  /// Of the heights on the device; null until the model is added, and of a surface.
  std::shared_ptr<Json> ground = std::make_shared<Json>();
  /// Of two surfaces beside each other; null until they are added, and where none were asked for.
  std::shared_ptr<Json> distances = std::make_shared<Json>();
};

/// What `arete view` opens.
using Opened = std::variant<TerrainModel, SurfaceModel, OpenScene, std::unique_ptr<TerrainPages>,
                            std::unique_ptr<SurfacePages>>;

/// Reads what the arguments name for it: the camera, colours, layers. Errors: usage and of the files, by
/// option.
Result<Viewed> viewedOf(const ViewArguments& a, Opened opened, Session& session);

}  // namespace arete
