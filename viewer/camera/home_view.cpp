// SPDX-License-Identifier: GPL-3.0-or-later
//
// A camera that looks in a given direction has the point (x, y, z) of its own axes in its picture when
// low (z - ez) <= x - ex <= high (z - ez), (ex, ey, ez) the eye, low and high the slopes of the sides of what
// is free of the picture. Over all points that is two bounds, A = max(x - high z) <= ex - high ez and B =
// max(low z - x) <= low ez - ex. Their sum bounds how far ahead the eye may stand, ez <= -(A + B) / (high -
// low); so do the two of y. The lesser of the two is the nearest eye, and ex and ey are taken, of what it
// leaves them, so that the picture has as much free on either side.
#include "viewer/camera/home_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <unordered_map>
#include <vector>

namespace arete {
namespace {

constexpr double kFree = 0.05;          // of the free part of the picture, on either side
constexpr double kNearest = 0.02;       // of the extent of the points, from the eye to the first of them
constexpr double kSteepest = -60;       // degrees, of an overview
constexpr std::uint32_t kFew = 20'000;  // vertices that are all taken
constexpr int kCellsOfShape = 48;       // along each axis

/// The bounds A and B above, between two slopes.
struct Sides {
  double low, high;
  double above = -std::numeric_limits<double>::infinity(), below = above;

  void take(double across, double ahead) {
    above = std::max(above, across - high * ahead);
    below = std::max(below, low * ahead - across);
  }
  double mostAhead() const { return -(above + below) / (high - low); }
  /// Of what an eye so far ahead leaves, the place from which the points reach as far to either side of the
  /// middle.
  double balanced(double eyeAhead, std::span<const Vec2> acrossAndAhead) const {
    double least = above + high * eyeAhead, most = low * eyeAhead - below;
    for (int halving = 0; halving < 60; ++halving) {
      const double eye = (least + most) / 2;
      double farthest = -std::numeric_limits<double>::infinity(), nearest = -farthest;
      for (const Vec2& p : acrossAndAhead) {
        const double side = (p.x - eye) / (p.y - eyeAhead);
        farthest = std::max(farthest, side);
        nearest = std::min(nearest, side);
      }
      (farthest + nearest > low + high ? least : most) = eye;
    }
    return (least + most) / 2;
  }
};

/// The sides of what is free of a picture, in its width and in its height.
struct Frame {
  Sides across, upwards;
};

// The slopes reach to the edges of the free part, less what is kept free of it on either side. Pixels are
// square, so the horizontal slopes follow from the picture's shape.
Frame frameOf(const Camera& picture, const CoveredEdges& covered) {
  const double slope = std::tan(picture.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  const auto sides = [](double half, double atLow, double atHigh) {
    const double free = 1 - atLow - atHigh;
    return Sides{.low = half * (2 * (atLow + kFree * free) - 1),
                 .high = half * (1 - 2 * (atHigh + kFree * free))};
  };
  return {sides(slope * picture.widthPixels / picture.heightPixels, covered.left, covered.right),
          sides(slope, covered.bottom, covered.top)};
}

Vec3 inAxes(const Vec3& p, const PictureAxes& axes) {
  return {dot(p, axes.right), dot(p, axes.up), dot(p, axes.ahead)};
}

/// The vertices that lie farthest in the directions from the middle of a cube to its corners and to the
/// middles of its edges and faces: 13 axes, both ways.
struct Farthest {
  std::array<float, 13> low, high;
  std::array<std::uint32_t, 13> lowest, highest;

  Farthest() {
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
  }
  void take(float x, float y, float z, std::uint32_t v) {
    const std::array<float, 13> along{x,     y,     z,         x + y,     x - y,     x + z,    x - z,
                                      y + z, y - z, x + y + z, x + y - z, x - y + z, x - y - z};
    for (std::size_t i = 0; i < along.size(); ++i) {
      if (along[i] > high[i]) {
        high[i] = along[i];
        highest[i] = v;
      }
      if (along[i] < low[i]) {
        low[i] = along[i];
        lowest[i] = v;
      }
    }
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

// A cell is found by where a vertex lies in the box, each axis from 0 to 1. An axis on which the box has no
// length has one cell.
HomeShape homeShape(std::uint32_t vertices, const std::function<Vec3(std::uint32_t)>& at) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  HomeShape shape{.box = {{kNone, kNone, kNone}, {-kNone, -kNone, -kNone}}, .points = {}};
  Vec3 &low = shape.box.low, &high = shape.box.high;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const Vec3 p = at(v);
    if (!isFinite(p)) continue;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    if (vertices <= kFew) shape.points.push_back(p);
  }
  if (vertices <= kFew) return shape;
  const auto part = [](double value, double from, double to) {
    return to > from ? (value - from) / (to - from) : 0.0;
  };
  std::unordered_map<std::uint32_t, Farthest> cells;
  // Vertices that follow each other often lie in one cell.
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  Farthest* inLast = nullptr;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const Vec3 p = at(v);
    if (!isFinite(p)) continue;
    const Vec3 q{part(p.x, low.x, high.x), part(p.y, low.y, high.y), part(p.z, low.z, high.z)};
    std::uint32_t cell = 0;
    for (const double along : {q.x, q.y, q.z})
      cell = cell * kCellsOfShape + std::uint32_t(std::min(int(along * kCellsOfShape), kCellsOfShape - 1));
    if (cell != last) inLast = &cells[cell];
    last = cell;
    inLast->take(float(q.x), float(q.y), float(q.z), v);
  }
  std::vector<std::uint32_t> taken;
  for (const auto& [cell, farthest] : cells) {
    taken.insert(taken.end(), farthest.lowest.begin(), farthest.lowest.end());
    taken.insert(taken.end(), farthest.highest.begin(), farthest.highest.end());
  }
  std::ranges::sort(taken);
  const auto repeated = std::ranges::unique(taken);
  taken.erase(repeated.begin(), repeated.end());
  for (const std::uint32_t v : taken) shape.points.push_back(at(v));
  return shape;
}

HomeShape homeShape(const TerrainModel& model) {
  const MetricFrame& metric = model.mt.metric();
  return homeShape(model.mt.vertexCount(), [&](std::uint32_t v) {
    return metric.toMetric(model.mt.vertices().position(VertexId{v}));
  });
}

HomeShape homeShape(const MetricBox& box) {
  const auto corners = box.corners();
  return {box, {corners.begin(), corners.end()}};
}

Vec3 eyeOnAll(std::span<const Vec3> points, const PictureAxes& axes, const Camera& picture,
              const CoveredEdges& covered) {
  auto [across, upwards] = frameOf(picture, covered);
  std::vector<Vec2> acrossAndAhead, upAndAhead;
  acrossAndAhead.reserve(points.size());
  upAndAhead.reserve(points.size());
  Vec3 least = inAxes(points.front(), axes), most = least;
  for (const Vec3& p : points) {
    const Vec3 there = inAxes(p, axes);
    least = {std::min(least.x, there.x), std::min(least.y, there.y), std::min(least.z, there.z)};
    most = {std::max(most.x, there.x), std::max(most.y, there.y), std::max(most.z, there.z)};
    across.take(there.x, there.z);
    upwards.take(there.y, there.z);
    acrossAndAhead.push_back({there.x, there.z});
    upAndAhead.push_back({there.y, there.z});
  }
  // The tip of a needle fills any picture from as near as one likes.
  const double size = std::max({most.x - least.x, most.y - least.y, most.z - least.z});
  const double z =
      std::min({across.mostAhead(), upwards.mostAhead(), least.z - (size > 0 ? kNearest * size : 1)});
  const double x = across.balanced(z, acrossAndAhead), y = upwards.balanced(z, upAndAhead);
  return {x * axes.right.x + y * axes.up.x + z * axes.ahead.x,
          x * axes.right.y + y * axes.up.y + z * axes.ahead.y,
          x * axes.right.z + y * axes.up.z + z * axes.ahead.z};
}

// The height is filled where it, and not the width, bounds how near the eye may come.
Look filling(Look look, std::span<const Vec3> points, const std::function<PictureAxes(Look)>& axesOfLook,
             const Camera& picture, const CoveredEdges& covered) {
  const auto isFilled = [&](double pitch) {
    const PictureAxes axes = axesOfLook({look.azimuthDegrees, pitch});
    auto [across, upwards] = frameOf(picture, covered);
    for (const Vec3& p : points) {
      const Vec3 there = inAxes(p, axes);
      across.take(there.x, there.z);
      upwards.take(there.y, there.z);
    }
    return upwards.mostAhead() <= across.mostAhead();
  };
  if (look.pitchDegrees <= kSteepest || isFilled(look.pitchDegrees)) return look;
  double flat = look.pitchDegrees, steep = kSteepest;
  while (flat - steep > 0.5) {
    const double pitch = (flat + steep) / 2;
    (isFilled(pitch) ? steep : flat) = pitch;
  }
  look.pitchDegrees = steep;
  return look;
}

namespace {

/// In parallel projection: sets the height of the picture. The eye stands before all points.
Vec3 parallelEyeOnAll(std::span<const Vec3> points, const PictureAxes& axes, Camera& picture,
                      const CoveredEdges& covered) {
  Vec3 least = inAxes(points.front(), axes), most = least;
  for (const Vec3& p : points) {
    const Vec3 there = inAxes(p, axes);
    least = {std::min(least.x, there.x), std::min(least.y, there.y), std::min(least.z, there.z)};
    most = {std::max(most.x, there.x), std::max(most.y, there.y), std::max(most.z, there.z)};
  }
  const Vec3 size = most - least;
  const double freeAcross = (1 - covered.left - covered.right) * (1 - 2 * kFree),
               freeUpwards = (1 - covered.bottom - covered.top) * (1 - 2 * kFree);
  const double aspect = picture.widthPixels / picture.heightPixels;
  double high = std::max(size.y / freeUpwards, size.x / (freeAcross * aspect));
  if (!(high > 0)) high = size.z > 0 ? size.z : 1;
  picture.parallelHeight = high;
  // The middle of the points is in the middle of the free part.
  const double x = (least.x + most.x) / 2 - (covered.left - covered.right) / 2 * high * aspect,
               y = (least.y + most.y) / 2 - (covered.bottom - covered.top) / 2 * high,
               z = least.z - std::max(high, size.z);
  return x * axes.right + y * axes.up + z * axes.ahead;
}

}  // namespace

// Coordinates are taken from the middle of the box, where they have most digits left.
Camera cameraOnAll(const CameraSpace& space, const HomeShape& shape, Look look, const Camera& picture,
                   const CoveredEdges& covered) {
  const Vec3 centre = shape.box.centre();
  std::vector<Vec3> points;
  points.reserve(shape.points.size());
  for (const Vec3& p : shape.points) points.push_back(p - centre);
  const PictureAxes axes = axesOf(space, look);
  Vec3 eye = eyeOnAll(points, axes, picture, covered);
  Camera held = picture;
  if (picture.parallelHeight > 0) eye = parallelEyeOnAll(points, axes, held, covered);
  Camera camera = space.at(held, centre + eye);
  camera.azimuthDegrees = wrappedAzimuth(look.azimuthDegrees);
  camera.pitchDegrees = look.pitchDegrees;
  return camera;
}

// Azimuths count clockwise from north: fromWest looks to the east.
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

// The view is found over the exaggerated shape; the camera is stored in heights of the terrain, which the
// viewer exaggerates again.
Camera homeCamera(HomeView view, const CameraSpace& space, const HomeShape& shape, const Camera& picture,
                  double stretch, const CoveredEdges& covered) {
  HomeShape drawn = shape;
  drawn.box.low.z *= stretch;
  drawn.box.high.z *= stretch;
  for (Vec3& p : drawn.points) p.z *= stretch;
  Look look = homeLook(view);
  if (view == HomeView::overview)
    look = filling(
        look, drawn.points, [&](Look at) { return axesOf(space, at); }, picture, covered);
  const Camera camera = cameraOnAll(space, drawn, look, picture, covered);
  const Vec3 place = space.position(camera);
  return space.at(camera, {place.x, place.y, place.z / stretch});
}

Camera homeCamera(HomeView view, const CameraSpace& space, const MetricBox& box, const Camera& picture,
                  double stretch) {
  return homeCamera(view, space, homeShape(box), picture, stretch);
}

}  // namespace arete
