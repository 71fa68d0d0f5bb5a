// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "terrain/locate/ground_height.h"
#include "terrain/model/terrain_model.h"

namespace arete::python {

/// A model with its point location.
class Terrain {
 public:
  explicit Terrain(TerrainModel model)
      : model_(std::make_shared<const TerrainModel>(std::move(model))), heights_(*model_) {}

  const TerrainModel& model() const { return *model_; }
  std::shared_ptr<const TerrainModel> shared() const { return model_; }
  const GroundHeights& heights() const { return heights_; }
  /// The highest minus the lowest sample: what a percentage of an error is of. O(samples).
  double relief() const;

 private:
  std::shared_ptr<const TerrainModel> model_;  // heights_ refers to it
  GroundHeights heights_;
};

/// Builds, reads, writes and asks models of terrain.
void defineTerrain(pybind11::module_& module);

}  // namespace arete::python
