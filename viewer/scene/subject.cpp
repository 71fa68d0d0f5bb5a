// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {

std::string_view toString(Coloring coloring) {
  static constexpr std::array<std::string_view, 7> kNames = {"height", "slope",    "aspect", "plain",
                                                             "error",  "material", "ink"};
  return kNames[std::size_t(coloring)];
}

Box3 Subject::fileBox() const {
  Box3 all = Box3::empty();
  for (const Vec3& corner : box().corners()) all.include(inFile(corner));
  return all;
}

Result<std::shared_ptr<const TriangleInk>> Subject::ink(const std::string& name) const {
  return failure(ErrorCode::usage, isTerrain() ? "is for surfaces" : "is for one surface", name);
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

Vec3 originOfPixel(const View& view, bool isMirrored, Vec2 pixel, double behind) {
  if (!view.isParallel()) return view.eye;
  const Frustum::Planes p = Frustum(view).planes();
  const double x = (2 * pixel.x / view.widthPixels - 1) * p.halfX * (isMirrored ? -1 : 1);
  const double y = (1 - 2 * pixel.y / view.heightPixels) * p.halfY;
  return view.eye + x * p.right + y * p.up - behind * p.forward;
}

std::optional<Vec2> pixelOfPoint(const View& view, bool isMirrored, const Vec3& inView) {
  if (!view.isParallel() && !(inView.z > 0)) return std::nullopt;
  const Frustum::Planes planes = Frustum(view).planes();
  return Vec2{(1 + (isMirrored ? -1 : 1) * inView.x / planes.halfWidth(inView.z)) / 2 * view.widthPixels,
              (1 - inView.y / planes.halfHeight(inView.z)) / 2 * view.heightPixels};
}

// A curved Earth bends a box by less than its size.
Sphere ballAbout(const Subject& subject, const ViewSettings& settings) {
  const MetricBox& box = subject.box();
  const Vec3 middle = subject.drawn(box.centre(), settings);
  double radius = 0;
  for (const Vec3& corner : box.corners()) {
    const Vec3 there = subject.drawn(corner, settings);
    if (isFinite(there)) radius = std::max(radius, norm(there - middle));
  }
  return {float(middle.x), float(middle.y), float(middle.z), float(radius)};
}

double depthReach(const View& view, const Subject& subject, const ViewSettings& settings) {
  Sphere ball{float(settings.contentsMiddle.x), float(settings.contentsMiddle.y),
              float(settings.contentsMiddle.z), float(settings.contentsRadius)};
  if (!(ball.radius > 0)) ball = ballAbout(subject, settings);
  const double far = norm(Vec3{ball.x, ball.y, ball.z} - view.eye) + 2 * double(ball.radius);
  return far > 0 && std::isfinite(far) ? far : 1;
}

std::optional<Vec2> pixelOf(const Subject& subject, const Camera& camera, const Vec3& metric,
                            const ViewSettings& settings) {
  const Result<View> view = subject.viewOf(camera, settings);
  if (!view) return std::nullopt;
  return pixelOfPoint(*view, subject.space().isMirrored(),
                      Frustum(*view).toView(subject.drawn(metric, settings)));
}

// Rays leave from the eye as it is drawn, stretched; the corners return to heights as they are.
SpaceVertices frustumEdges(const CameraSpace& space, const Camera& camera, double depth, double stretch) {
  SpaceVertices edges;
  Result<View> view = viewOf(camera, space);
  if (!view) return edges;
  Vec3 eye = view->eye;
  eye.z *= stretch;
  View drawn = *view;
  drawn.eye = eye;
  std::array<Vec3, 4> origins, corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 pixel{i == 1 || i == 2 ? camera.widthPixels : 0, i >= 2 ? camera.heightPixels : 0};
    origins[i] = originOfPixel(drawn, space.isMirrored(), pixel, 0);
    corners[i] = origins[i] + depth * directionOfPixel(*view, space.isMirrored(), pixel);
    origins[i].z /= stretch;
    corners[i].z /= stretch;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    edges.addLine(origins[i], corners[i], {255, 255, 255, 255});
    edges.addLine(corners[i], corners[(i + 1) % 4], {255, 255, 255, 255});
  }
  return edges;
}

}  // namespace arete
