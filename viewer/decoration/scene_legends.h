// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/decoration/legend.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/subject.h"
#include "viewer/scene/triangle_ink.h"

namespace arete {

/// What the colours of a scene mean.
class SceneLegends {
 public:
  /// Precondition: the subject outlives this.
  explicit SceneLegends(const Subject& subject) : subject_(&subject) {}

  /// Of the visible layers that have a legend, the highest first, and of what the model is coloured by, as
  /// the painters colour it. Level ground has these colours in sunlight too. The first call is O(vertices)
  /// for a terrain whose colours are not stated.
  std::vector<ColorLegend> of(const ViewSettings& settings, std::span<const Layer> layers) const;

 private:
  const Subject* subject_;
  mutable std::optional<TerrainColors> usual_;
};

/// The legend of an ink.
ColorLegend legendOf(const TriangleInk& ink);

/// The legend of one colouring. @param heatPixels of errors without a stated largest one
ColorLegend legendOf(Coloring coloring, const TerrainColors& colors, const std::string& unit,
                     double heatError, double heatPixels);

}  // namespace arete
