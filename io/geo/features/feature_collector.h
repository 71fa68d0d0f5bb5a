// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "io/geo/features/chain_placer.h"
#include "io/geo/features/feature_layer.h"

namespace arete {

/// Gathers the geometries and labels of features in a layer.
class FeatureCollector {
 public:
  /// @param field the one with the labels; -1: none.
  FeatureCollector(ChainPlacer placer, int field, std::uint64_t mostVertices, FeatureLayer& layer)
      : placer_(std::move(placer)), field_(field), most_(mostVertices), layer_(layer) {}

  /// Errors: unsupported: more vertices than allowed.
  Status add(OGRFeature& feature);
  /// A point of a text.
  Status addPoint(Vec2 xy, double z, std::string_view label);

  /// Adds the warnings about what was left out. Errors: invalidData: there is nothing in the layer, and the
  /// message says why.
  Status finish();

 private:
  void collect(const OGRGeometry& geometry);
  /// @param polygon its number where the line is a ring of one
  void collectLine(const OGRSimpleCurve& line, std::uint64_t polygon = FeatureLayer::kNoPolygon);
  void place(Vec2 xy, double z);
  void addLabels(std::string text);
  Status checkSize() const;

  ChainPlacer placer_;
  int field_;
  std::uint64_t most_;
  FeatureLayer& layer_;

  // Of the feature that is being added.
  std::vector<FeatureLayer::Place> labelPlaces_;  // of its points
  std::optional<std::uint64_t> labelLine_;
  std::optional<std::uint64_t> labelPolygon_;  // its largest one with a closed ring
  double largestArea_ = -1;
  std::uint64_t firstPolygon_ = 0;
  std::vector<Vec2> xy_;
  std::vector<double> z_;

  bool hasZ_ = false;
  std::uint64_t without_ = 0, others_ = 0, unlike_ = 0, shortened_ = 0;
};

}  // namespace arete
