// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/session/session.h"
#include "cli/view/arguments.h"
#include "cli/view/layer_argument.h"
#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/scene.h"

namespace arete {

/// The drapes and vector layers of a terrain, as the arguments state them: read before anything is drawn, as
/// far as no OpenGL is needed.
class StatedLayers {
 public:
  /// Warns of what is left out or assumed. Errors: usage, and as readFeatures() and layOnGround() have them.
  static Result<StatedLayers> read(const AppearanceArguments& arguments,
                                   const std::shared_ptr<const TerrainModel>& model, Session& session);

  /// Lays them into a scene: the drapes, then the vector layers, in the order in which they are stated.
  /// Errors: as DrapeOnGpu::load() has them; unsupported, by the driver.
  Status addTo(Scene& scene, const TerrainModel& model, Session& session) const;

  /// Describes each as an element of the JSON answer's "layers"; "drape" is the first one's.
  /// About a picture that was drawn: labels that had no room in it.
  void warnOfLabels(const Scene& scene, Session& session) const;
  void describe(const Scene& scene, Json& json) const;

 private:
  struct Drape {
    std::string name, file;
    double opacity = 1;
  };
  struct Vector {
    std::string name;
    LayerArgument stated;
    std::shared_ptr<const GroundFeatures> features;
    std::shared_ptr<const PlanPicture> fill;  ///< null: none
  };
  std::vector<Drape> drapes_;
  std::vector<Vector> vectors_;
  DrapeOptions drapeOptions_;
};

/// The names of files that the layers are read from.
std::vector<std::string> layerFiles(const AppearanceArguments& arguments);

}  // namespace arete
