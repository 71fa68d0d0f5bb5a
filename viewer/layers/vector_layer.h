// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/base/result.h"
#include "viewer/layers/feature_painter.h"
#include "viewer/layers/label_placement.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/space_content.h"

namespace arete {

/// What the vector layers of a scene share: the programs, and the room that labels have taken in a picture.
struct VectorLayerTools {
  FeaturePainter painter;
  std::optional<LabelPlacement> placement = {};
  std::uint64_t frame = 0;  ///< the picture of `placement`
  bool hasLabels = false;   ///< any of the layers

  /// Errors: unsupported, by the driver.
  static Result<std::shared_ptr<VectorLayerTools>> create();
};

/// The content of a layer of features on a terrain.
class VectorLayer final : public SpaceContent {
 public:
  VectorLayer(std::shared_ptr<const GroundFeatures> features, const FeatureStyle& style,
              std::shared_ptr<VectorLayerTools> tools)
      : features_(std::move(features)), style_(style), tools_(std::move(tools)) {
    tools_->hasLabels = tools_->hasLabels || !features_->labels.empty();
  }

  std::string_view kind() const override { return "a vector layer"; }
  Status draw(const SpaceFrame& frame) override;
  Status drawLabels(const SpaceFrame& frame) override;

  const GroundFeatures& features() const { return *features_; }
  /// Of the picture that was drawn last: labels whose places are seen and that other labels, or points, leave
  /// no room.
  std::uint64_t labelsWithoutRoom() const { return labelsWithoutRoom_; }
  /// `name`, and the colour of its points and of its lines.
  Legend legend(const std::string& name) const;

 private:
  FeatureStyle styleOf(const SpaceFrame& frame) const;
  void begin(const SpaceFrame& frame);

  std::shared_ptr<const GroundFeatures> features_;
  FeatureStyle style_;
  std::shared_ptr<VectorLayerTools> tools_;
  std::optional<FeatureBuffers> buffers_;
  bool isCurved_ = false;  // the space of the buffers
  double stretch_ = 1;     // where they are curved
  std::uint64_t labelsWithoutRoom_ = 0;
};

}  // namespace arete
