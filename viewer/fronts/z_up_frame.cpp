// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/z_up_frame.h"

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

HomeShape uprightShape(const SurfaceModel& model, const ZUpFrame& upright) {
  return homeShape(model.mt.vertexCount(),
                   [&](std::uint32_t v) { return upright.fromFile(model.mt.position(VertexId(v))); });
}

}  // namespace arete
