// SPDX-License-Identifier: GPL-3.0-or-later
//
// A camera that looks in a given direction has the point (x, y, z) of its own axes in its picture when
// |x - ex| <= sx (z - ez) and |y - ey| <= sy (z - ez), (ex, ey, ez) the eye. Over all corners the first is
// two bounds, A = max(x - sx z) <= ex - sx ez and B = max(-x - sx z) <= -ex - sx ez. Their sum bounds how far
// ahead the eye may stand, ez <= -(A + B) / 2 sx; so does the second. The lesser of the two is the nearest
// eye, and ex and ey are taken, of what it leaves them, so that the picture has as much free on either side.
#include "viewer/camera/home_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace arete {
namespace {

constexpr double kFree = 0.05;  // of the picture, on either side

/// The bounds A and B above.
struct Sides {
  double slope;
  double above = -std::numeric_limits<double>::infinity(), below = above;

  void take(double across, double ahead) {
    above = std::max(above, across - slope * ahead);
    below = std::max(below, -across - slope * ahead);
  }
  double mostAhead() const { return -(above + below) / (2 * slope); }
  /// Of what an eye so far ahead leaves, the place from which the corners reach as far to either side.
  double balanced(double eyeAhead, std::span<const Vec2> acrossAndAhead) const {
    double low = above + slope * eyeAhead, high = -below - slope * eyeAhead;
    for (int halving = 0; halving < 60; ++halving) {
      const double eye = (low + high) / 2;
      double most = -std::numeric_limits<double>::infinity(), least = -most;
      for (const Vec2& p : acrossAndAhead) {
        const double side = (p.x - eye) / (p.y - eyeAhead);
        most = std::max(most, side);
        least = std::min(least, side);
      }
      (most + least > 0 ? low : high) = eye;
    }
    return (low + high) / 2;
  }
};

}  // namespace

std::array<Vec3, 8> MetricBox::corners() const {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
  return corners;
}

double MetricBox::diagonal() const {
  return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
}

// The box is taken in the units of the model and transformed by its two corners, since the metric scales and
// shifts each axis alone.
MetricBox metricBox(const TerrainModel& model) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Vec3 low{kNone, kNone, kNone}, high{-kNone, -kNone, -kNone};
  const std::uint32_t count = model.mt.vertexCount();
  for (std::uint32_t v = 0; v < count; ++v) {
    const Vec3 p = model.mt.vertices().position(VertexId{v});
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const MetricFrame& metric = model.mt.metric();
  return {metric.toMetric(low), metric.toMetric(high)};
}

PictureAxes axesOf(const CameraSpace& space, Look look) {
  return {space.right(look.azimuthDegrees), space.up(look), space.forward(look)};
}

std::string_view toString(HomeView view) {
  switch (view) {
    case HomeView::overview:
      return "overview";
    case HomeView::fromAbove:
      return "above";
    case HomeView::fromSouth:
      return "south";
    case HomeView::fromWest:
      return "west";
    case HomeView::fromNorth:
      return "north";
    case HomeView::fromEast:
      return "east";
  }
  return "unknown";
}

// The slopes are the tangents of half the angles of view, less what is kept free on either side. Pixels are
// square, so the horizontal slope follows from the picture's shape.
Vec3 eyeOnAll(std::span<const Vec3> points, const PictureAxes& axes, const Camera& picture) {
  const double slope =
      std::tan(picture.verticalFieldOfViewDegrees * std::numbers::pi / 360) * (1 - 2 * kFree);
  Sides across{.slope = slope * picture.widthPixels / picture.heightPixels}, upwards{.slope = slope};
  std::vector<Vec2> acrossAndAhead, upAndAhead;
  for (const Vec3& p : points) {
    const Vec3 there{dot(p, axes.right), dot(p, axes.up), dot(p, axes.ahead)};
    across.take(there.x, there.z);
    upwards.take(there.y, there.z);
    acrossAndAhead.push_back({there.x, there.z});
    upAndAhead.push_back({there.y, there.z});
  }
  const double z = std::min(across.mostAhead(), upwards.mostAhead());
  const double x = across.balanced(z, acrossAndAhead), y = upwards.balanced(z, upAndAhead);
  return {x * axes.right.x + y * axes.up.x + z * axes.ahead.x,
          x * axes.right.y + y * axes.up.y + z * axes.ahead.y,
          x * axes.right.z + y * axes.up.z + z * axes.ahead.z};
}

// Coordinates are taken from the middle of the box, where they have most digits left.
Camera cameraOnAll(const CameraSpace& space, const MetricBox& box, Look look, const Camera& picture) {
  const Vec3 centre = box.centre();
  std::array<Vec3, 8> corners = box.corners();
  for (Vec3& corner : corners) corner = {corner.x - centre.x, corner.y - centre.y, corner.z - centre.z};
  const Vec3 eye = eyeOnAll(corners, axesOf(space, look), picture);
  Camera camera = space.at(picture, {centre.x + eye.x, centre.y + eye.y, centre.z + eye.z});
  camera.azimuthDegrees = wrappedAzimuth(look.azimuthDegrees);
  camera.pitchDegrees = look.pitchDegrees;
  return camera;
}

// Azimuths count clockwise from north: fromWest looks to the east. The overview looks from the south, 30
// degrees downwards.
Look homeLook(HomeView view) {
  switch (view) {
    case HomeView::overview:
      return {0, -30};
    case HomeView::fromAbove:
      return {0, -90};
    case HomeView::fromSouth:
      return {0, 0};
    case HomeView::fromWest:
      return {90, 0};
    case HomeView::fromNorth:
      return {180, 0};
    case HomeView::fromEast:
      return {270, 0};
  }
  return {};
}

// The view is found over the exaggerated box; the camera is stored in heights of the terrain, which the
// viewer exaggerates again.
Camera homeCamera(HomeView view, const CameraSpace& space, const MetricBox& box, const Camera& picture,
                  double stretch) {
  MetricBox drawn = box;
  drawn.low.z *= stretch;
  drawn.high.z *= stretch;
  const Camera camera = cameraOnAll(space, drawn, homeLook(view), picture);
  const Vec3 place = space.position(camera);
  return space.at(camera, {place.x, place.y, place.z / stretch});
}

}  // namespace arete
