// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/contour_heights.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "viewer/layers/label_placement.h"
#include "viewer/picture/ticks.h"
#include "viewer/scene/subject.h"

namespace arete {

Result<std::shared_ptr<ContourHeights>> ContourHeights::create(std::span<const ContourLabel> labels) {
  ARETE_TRY(FeaturePainter painter, FeaturePainter::create());
  std::shared_ptr<ContourHeights> made(new ContourHeights(std::move(painter)));
  // As many digits as tell the levels apart.
  std::vector<double> levels;
  for (const ContourLabel& label : labels) levels.push_back(label.height);
  std::ranges::sort(levels);
  levels.erase(std::ranges::unique(levels).begin(), levels.end());
  const std::vector<std::string> texts = tickTexts(levels);
  for (const ContourLabel& label : labels.first(std::min(labels.size(), kMost))) {
    const auto level = std::size_t(std::ranges::lower_bound(levels, label.height) - levels.begin());
    made->features_.labels.push_back({texts[level], {label.xy, label.height}});
  }
  return made;
}

FeatureStyle ContourHeights::style(const SpaceFrame& frame) const {
  return {.color = Contours::kInk, .width = 1, .opacity = frame.opacity};
}

void ContourHeights::begin(const SpaceFrame& frame) {
  MetricFrame metric;
  metric.scale.z = frame.subject.space().metresPerHeight();
  painter_.setFrame(frame.view, metric);
}

Status ContourHeights::draw(const SpaceFrame& frame) {
  const bool isCurved = frame.settings.isCurved;
  if (!buffers_ || isCurved != isCurved_ || (isCurved && stretch_ != frame.settings.stretch)) {
    buffers_ = uploadFeatures(features_, [&](Vec2 xy, double height) {
      const Vec3 metric = frame.subject.space().position(xy, height);
      return isCurved ? frame.subject.drawn(metric, frame.settings) : metric;
    });
    isCurved_ = isCurved;
    stretch_ = frame.settings.stretch;
  }
  begin(frame);
  painter_.draw(*buffers_, style(frame));
  return {};
}

Status ContourHeights::drawLabels(const SpaceFrame& frame) {
  if (!buffers_) return {};
  begin(frame);
  constexpr double kApart = 70;  // pixels
  LabelPlacement placement(int(frame.view.view.widthPixels), int(frame.view.view.heightPixels), kApart,
                           LabelPlacement::Where::on);
  return painter_.drawLabels(*buffers_, features_, style(frame), placement);
}

}  // namespace arete
