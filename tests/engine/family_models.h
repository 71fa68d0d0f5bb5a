// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "terrain/builder/build.h"

namespace arete {

/// A model of every raster family and shape, made once.
struct FamilyModel {
  std::string name;
  TerrainModel model;
};

inline const std::vector<FamilyModel>& familyModels() {
  static const std::vector<FamilyModel> all = [] {
    std::vector<FamilyModel> made;
    for (const RasterFamily& family : rasterFamilies())
      for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
        BuildOptions options;
        options.shape = shape;
        Result<TerrainModel> model = build(family.make(30, 25, 3), options);
        if (!model) {
          ADD_FAILURE() << family.name << ": " << model.error().describe();
          continue;
        }
        made.push_back({std::string(family.name) + (shape == HoleShape::delaunay ? "" : " fidelity"),
                        std::move(*model)});
      }
    return made;
  }();
  return all;
}

}  // namespace arete
