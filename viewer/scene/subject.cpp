// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace arete {

std::string_view toString(Coloring coloring) {
  static constexpr std::array<std::string_view, 6> kNames = {"height", "slope", "aspect",
                                                             "plain",  "error", "material"};
  return kNames[std::size_t(coloring)];
}

Status Subject::checkColoring(Coloring coloring) const {
  if (std::ranges::find(colorings(), coloring) != colorings().end()) return {};
  return failure(ErrorCode::usage, fmt::format("is for {}", isTerrain() ? "surfaces" : "terrain"),
                 fmt::format("colour by {}", toString(coloring)));
}

Status Subject::check(const Layer& layer) const {
  if (isTerrain() || std::holds_alternative<SpaceVertices>(layer.content)) return {};
  return failure(ErrorCode::usage,
                 fmt::format("{} {} for terrain", layer.kind(), layer.kind() == "contours" ? "are" : "is"),
                 layer.name);
}

Vec3 directionOfPixel(const View& view, bool isMirrored, Vec2 pixel) {
  const Frustum::Planes p = Frustum(view).planes();
  const double x = (2 * pixel.x / view.widthPixels - 1) * p.slopeX * (isMirrored ? -1 : 1);
  const double y = (1 - 2 * pixel.y / view.heightPixels) * p.slopeY;
  return p.forward + x * p.right + y * p.up;
}

std::optional<Vec2> pixelOf(const Subject& subject, const Camera& camera, const Vec3& metric,
                            const ViewSettings& settings) {
  const Result<View> view = subject.viewOf(camera, settings);
  if (!view) return std::nullopt;
  const Frustum frustum(*view);
  const Vec3 p = frustum.toView(subject.drawn(metric, settings));
  if (!(p.z > 0)) return std::nullopt;
  const Frustum::Planes planes = frustum.planes();
  const double side = subject.space().isMirrored() ? -1 : 1;
  return Vec2{(1 + side * p.x / (p.z * planes.slopeX)) / 2 * camera.widthPixels,
              (1 - p.y / (p.z * planes.slopeY)) / 2 * camera.heightPixels};
}

// Rays leave from the eye as it is drawn, stretched; the corners return to heights as they are.
SpaceVertices frustumEdges(const CameraSpace& space, const Camera& camera, double depth, double stretch) {
  SpaceVertices edges;
  Result<View> view = viewOf(camera, space);
  if (!view) return edges;
  Vec3 eye = view->eye;
  eye.z *= stretch;
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 pixel{i == 1 || i == 2 ? camera.widthPixels : 0, i >= 2 ? camera.heightPixels : 0};
    corners[i] = eye + depth * directionOfPixel(*view, space.isMirrored(), pixel);
    corners[i].z /= stretch;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    edges.addLine(view->eye, corners[i], {255, 255, 255, 255});
    edges.addLine(corners[i], corners[(i + 1) % 4], {255, 255, 255, 255});
  }
  return edges;
}

}  // namespace arete
