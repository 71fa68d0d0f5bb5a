// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "viewer/gl/frame_block.h"
#include "viewer/layers/feature_buffers.h"
#include "viewer/layers/label_placement.h"
#include "viewer/picture/picture.h"

namespace arete {

/// How features look.
struct FeatureStyle {
  Rgb color = {214, 40, 40};
  double width = 2;    ///< of lines, in pixels, > 0
  double opacity = 1;  ///< 0 to 1
};

/// Draws features over the terrain that the bound framebuffer shows, behind which they are hidden. They are
/// raised by the tolerance of what is drawn, so that a coarse cut does not hide them: on the screen, by no
/// more pixels than that. Shared by all layers of a context.
class FeaturePainter {
 public:
  /// Errors: unsupported, by the driver.
  static Result<FeaturePainter> create();
  FeaturePainter(FeaturePainter&&) noexcept;
  FeaturePainter& operator=(FeaturePainter&&) noexcept;
  ~FeaturePainter();

  /// The frame of the next calls, with which the terrain in the framebuffer was drawn.
  /// @param metric of the flat space of its model.
  void setFrame(const FrameView& frame, const MetricFrame& metric);

  /// Everything but the labels; finds out which of these are seen.
  void draw(FeatureBuffers& features, const FeatureStyle& style);
  /// Keeps labels off the points that are seen. Precondition: draw() of the same features in this frame.
  /// Waits for the drawing.
  void keepPointsFree(const FeatureBuffers& features, const FeatureStyle& style, LabelPlacement& placement);
  /// As many labels as there is room for, of those whose places are seen; first come, first served.
  /// Precondition: draw() of the same features in this frame. Waits for the drawing.
  Status drawLabels(const FeatureBuffers& features, const GroundFeatures& texts, const FeatureStyle& style,
                    LabelPlacement& placement);

 private:
  struct State;
  explicit FeaturePainter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
