// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "viewer/heights/contour_labels.h"
#include "viewer/layers/feature_painter.h"
#include "viewer/scene/space_content.h"

namespace arete {

/// The heights of contour lines, written on the lines that are drawn heavier: as many as a picture has
/// room for, far apart from each other.
class ContourHeights final : public SpaceContent {
 public:
  /// @param labels  the first ones come first (contourLabels()); those beyond kMost are left out
  static Result<std::shared_ptr<ContourHeights>> create(std::span<const ContourLabel> labels);
  static constexpr std::size_t kMost = 4096;

  std::string_view kind() const override { return "heights of contours"; }
  Status draw(const SpaceFrame& frame) override;
  Status drawLabels(const SpaceFrame& frame) override;

 private:
  explicit ContourHeights(FeaturePainter painter) : painter_(std::move(painter)) {}
  void begin(const SpaceFrame& frame);
  FeatureStyle style(const SpaceFrame& frame) const;

  FeaturePainter painter_;
  GroundFeatures features_;
  std::optional<FeatureBuffers> buffers_;
  bool isCurved_ = false;  // the space of the buffers
  double stretch_ = 1;     // where they are curved
};

}  // namespace arete
