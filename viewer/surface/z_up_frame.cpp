// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/z_up_frame.h"

#include <algorithm>
#include <limits>

namespace arete {

ZUpFrame::ZUpFrame(const SurfaceModel& model, std::string_view up)
    : metric_(model.mt.metric()), isYUp_((up.empty() ? std::string_view(model.up) : up) == "y") {}

Vec3 ZUpFrame::toFile(const Vec3& upright) const {
  const Vec3 p = turnedBack(upright);
  return {p.x / metric_.scale.x + metric_.origin.x, p.y / metric_.scale.y + metric_.origin.y,
          p.z / metric_.scale.z + metric_.origin.z};
}

View ZUpFrame::turnedBack(View view) const {
  view.eye = turnedBack(view.eye);
  view.forward = turnedBack(view.forward);
  view.up = turnedBack(view.up);
  return view;
}

ZUpShape uprightShape(const SurfaceModel& model, const ZUpFrame& upright) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  constexpr std::uint32_t kMostPoints = 20'000;
  ZUpShape shape{.box = {{kNone, kNone, kNone}, {-kNone, -kNone, -kNone}}, .points = {}};
  MetricBox& box = shape.box;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const Vec3 p = upright.fromFile(model.mt.position(VertexId(v)));
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    if (v < kMostPoints) shape.points.push_back(p);
  }
  return shape;
}

}  // namespace arete
