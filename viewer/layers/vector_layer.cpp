// SPDX-License-Identifier: GPL-3.0-or-later
//
// On a flat Earth the device multiplies heights, so the buffers stay; on a curved one they are made anew when
// the exaggeration changes.
#include "viewer/layers/vector_layer.h"

#include <utility>

#include "viewer/scene/subject.h"

namespace arete {

Result<std::shared_ptr<VectorLayerTools>> VectorLayerTools::create() {
  ARETE_TRY(FeaturePainter painter, FeaturePainter::create());
  return std::make_shared<VectorLayerTools>(VectorLayerTools{.painter = std::move(painter)});
}

FeatureStyle VectorLayer::styleOf(const SpaceFrame& frame) const {
  FeatureStyle style = style_;
  style.opacity = frame.opacity;
  return style;
}

void VectorLayer::begin(const SpaceFrame& frame) {
  MetricFrame metric;
  metric.scale.z = frame.subject.space().metresPerHeight();
  tools_->painter.setFrame(frame.view, metric);
  if (tools_->placement && tools_->frame == frame.number) return;
  tools_->placement.emplace(int(frame.view.view.widthPixels), int(frame.view.view.heightPixels));
  tools_->frame = frame.number;
}

Status VectorLayer::draw(const SpaceFrame& frame) {
  const bool isCurved = frame.settings.isCurved;
  if (!buffers_ || isCurved != isCurved_ || (isCurved && stretch_ != frame.settings.stretch)) {
    buffers_ = uploadFeatures(*features_, [&](Vec2 xy, double height) {
      const Vec3 metric = frame.subject.space().position(xy, height);
      return isCurved ? frame.subject.drawn(metric, frame.settings) : metric;
    });
    isCurved_ = isCurved;
    stretch_ = frame.settings.stretch;
  }
  begin(frame);
  tools_->painter.draw(*buffers_, styleOf(frame));
  // All layers are drawn before the first label is placed.
  if (tools_->hasLabels) tools_->painter.keepPointsFree(*buffers_, styleOf(frame), *tools_->placement);
  return {};
}

Status VectorLayer::drawLabels(const SpaceFrame& frame) {
  if (!buffers_) return {};
  begin(frame);
  const std::uint64_t before = tools_->placement->refused();
  ARETE_CHECK(tools_->painter.drawLabels(*buffers_, *features_, styleOf(frame), *tools_->placement));
  labelsWithoutRoom_ = tools_->placement->refused() - before;
  return {};
}

Legend VectorLayer::legend(const std::string& name) const {
  const Rgba color{style_.color.r, style_.color.g, style_.color.b, 255};
  Legend legend{.title = name, .entries = {}};
  if (!features_->points.empty()) legend.entries.push_back({color, "points", Legend::Mark::point});
  if (features_->lines() > 0) legend.entries.push_back({color, "lines", Legend::Mark::line});
  return legend;
}

}  // namespace arete
