// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contours of a raster's finest triangulation as a camera sees them, marched triangle by triangle and
// projected here, and how far the ink of a picture is from them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/criteria/view.h"
#include "terrain/model/camera.h"
#include "terrain/model/raster_cells.h"
#include "viewer/picture/picture.h"

namespace arete::test {

/// From metric space to pixels.
class ScreenOfModel {
 public:
  ScreenOfModel(const Camera& camera, const TerrainModel& model)
      : view_(*viewOf(camera, model)), width_(camera.widthPixels), height_(camera.heightPixels) {
    const Vec3 &f = view_.forward, &u = view_.up;
    const double side = model.isFlipped() ? -1 : 1;
    right_ = {side * (f.y * u.z - f.z * u.y), side * (f.z * u.x - f.x * u.z), side * (f.x * u.y - f.y * u.x)};
    focal_ = height_ / 2 / std::tan(view_.verticalFieldOfView / 2);
  }
  /// Pixels to the right and down, depth.
  Vec3 project(const Vec3& p) const {
    const Vec3 d = p - view_.eye;
    const double depth = dot(d, view_.forward);
    return {width_ / 2 + focal_ * dot(d, right_) / depth, height_ / 2 - focal_ * dot(d, view_.up) / depth,
            depth};
  }
  Vec3 unproject(double x, double y, double depth) const {
    return view_.eye + depth * (view_.forward + ((x - width_ / 2) / focal_) * right_ +
                                ((height_ / 2 - y) / focal_) * view_.up);
  }

 private:
  View view_;
  Vec3 right_;
  double width_, height_, focal_ = 1;
};

/// The contours of one cell: visit(level, from, to) with ends in plan coordinates and the level's number.
/// Ground exactly at a level counts as below it.
template <class Visit>
void contoursOfCell(const RasterHeightfield& field, std::uint32_t column, std::uint32_t row, double interval,
                    const Visit& visit) {
  const RasterCells cells(field);
  cells.forTriangles(column, row, cells.valid(column, row), [&](const RasterCells::Corners& t) {
    std::array<double, 3> z;
    std::array<Vec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      z[i] = field.heights[t[i]] / interval;
      p[i] = {double(t[i] % field.columns), double(t[i] / field.columns)};
    }
    for (auto level = std::int64_t(std::ceil(std::min({z[0], z[1], z[2]})));
         double(level) < std::max({z[0], z[1], z[2]}); ++level) {
      std::vector<Vec2> ends;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((z[i] > double(level)) == (z[j] > double(level))) continue;
        const double part = (double(level) - z[i]) / (z[j] - z[i]);
        ends.push_back({p[i].x + part * (p[j].x - p[i].x), p[i].y + part * (p[j].y - p[i].y)});
      }
      if (ends.size() == 2) visit(level, ends[0], ends[1]);
    }
  });
}

struct InkReport {
  std::int64_t ink = 0, inkAstray = 0;           ///< pixels with ink; of these too far from every contour
  std::int64_t index = 0, indexWithout = 0;      ///< pixels of visible index lines; of these without ink
  std::int64_t contour = 0, contourWithout = 0;  ///< the same of all lines
  double astray() const { return ink > 0 ? double(inkAstray) / double(ink) : 0; }
  double without() const { return contour > 0 ? double(contourWithout) / double(contour) : 0; }
  double indexAway() const { return index > 0 ? double(indexWithout) / double(index) : 0; }
  std::vector<std::array<int, 2>> missing, astrayAt;
  std::vector<double> metres;  ///< of pixels with ink, how far they are from a contour in plan (metric units)
};

/// @param hasInk  of a pixel
/// @param depths  by pixel, infinite where there is sky
/// @param reach  pixels that ink and contours may be apart
inline InkReport compareInk(const RasterHeightfield& field, const TerrainModel& model, const Camera& camera,
                            double interval, double reach, std::span<const float> depths,
                            const std::function<bool(int, int)>& hasInk, bool measuresMetres = false) {
  const ScreenOfModel screen(camera, model);
  const int width = int(camera.widthPixels), height = int(camera.heightPixels);
  const MetricFrame& metric = model.mt.metric();
  struct Point {
    float x, y, depth;
    bool isIndex;
  };
  const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); };
  std::vector<std::vector<Point>> points(std::size_t(width) * std::size_t(height));
  for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < field.columns; ++column)
      contoursOfCell(field, column, row, interval, [&](std::int64_t level, const Vec2& from, const Vec2& to) {
        const double z = double(level) * interval;
        const Vec3 a = metric.toMetric({from.x, from.y, z}), b = metric.toMetric({to.x, to.y, z});
        const Vec3 p = screen.project(a), q = screen.project(b);
        if (!(p.z > 0.1 && q.z > 0.1)) return;
        const int steps = int(std::clamp(std::hypot(q.x - p.x, q.y - p.y) / 0.2, 1.0, 4000.0)) + 1;
        for (int i = 0; i <= steps; ++i) {
          const Vec3 s = screen.project(a + (double(i) / steps) * (b - a));
          const double x = std::floor(s.x), y = std::floor(s.y);
          if (!(x >= 0 && y >= 0 && x < width && y < height)) continue;
          points[at(int(x), int(y))].push_back({float(s.x), float(s.y), float(s.z), level % 5 == 0});
        }
      });

  InkReport report;
  const int around = int(std::ceil(reach)) + 1;
  // 1 / depth is linear on the screen where the ground is a plane. Nothing beside the sky and at silhouettes.
  struct Near {
    double here, alongX, alongY;
    double at(double dx, double dy) const { return here + dx * alongX + dy * alongY; }
    double slack() const { return 0.5 * (std::abs(alongX) + std::abs(alongY)) + 1e-5 * here; }
  };
  const auto nearAt = [&](int x, int y) -> std::optional<Near> {
    const auto w = [&](int dx, int dy) { return 1 / double(depths[at(x + dx, y + dy)]); };
    const Near near{w(0, 0), (w(1, 0) - w(-1, 0)) / 2, (w(0, 1) - w(0, -1)) / 2};
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (!(w(dx, dy) > 0) || std::abs(w(dx, dy) - near.at(dx, dy)) > near.slack() + 1e-3 * near.here)
          return std::nullopt;
    return near;
  };
  const auto nearestMetres = [&](int x, int y) {
    const Vec3 place = screen.unproject(x + 0.5, y + 0.5, double(depths[at(x, y)]));
    const Vec2 plan{place.x / metric.scale.x + metric.origin.x, place.y / metric.scale.y + metric.origin.y};
    double nearest = INFINITY;
    const int rings = measuresMetres ? 12 : 1;
    for (int dy = -rings; dy <= rings; ++dy)
      for (int dx = -rings; dx <= rings; ++dx) {
        const double column = std::floor(plan.x) + dx, row = std::floor(plan.y) + dy;
        if (!(column >= 0 && row >= 0 && column < field.columns - 1.0 && row < field.rows - 1.0)) continue;
        contoursOfCell(field, std::uint32_t(column), std::uint32_t(row), interval,
                       [&](std::int64_t, const Vec2& a, const Vec2& b) {
                         const Vec2 along{(b.x - a.x) * metric.scale.x, (b.y - a.y) * metric.scale.y},
                             to{(plan.x - a.x) * metric.scale.x, (plan.y - a.y) * metric.scale.y};
                         const double length = along.x * along.x + along.y * along.y;
                         const double t =
                             length > 0 ? std::clamp((along.x * to.x + along.y * to.y) / length, 0.0, 1.0)
                                        : 0;
                         nearest = std::min(nearest, std::hypot(to.x - t * along.x, to.y - t * along.y));
                       });
      }
    return nearest;
  };
  const double tenth = 0.1 * std::min(std::abs(metric.scale.x), std::abs(metric.scale.y));
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const auto seen = nearAt(x, y);
      if (!seen) continue;
      if (hasInk(x, y)) {
        ++report.ink;
        double nearest = INFINITY;
        for (int j = std::max(y - around, 0); j <= std::min(y + around, height - 1); ++j)
          for (int i = std::max(x - around, 0); i <= std::min(x + around, width - 1); ++i)
            for (const Point& p : points[at(i, j)])
              if (const double w = double(p.depth) * seen->here; w > 0.8 && w < 1.25)
                nearest = std::min(nearest, std::hypot(double(p.x) - x - 0.5, double(p.y) - y - 0.5));
        if (measuresMetres) report.metres.push_back(nearestMetres(x, y));
        if (nearest > reach && nearestMetres(x, y) > tenth) {
          ++report.inkAstray;
          report.astrayAt.push_back({x, y});
        }
      }
      // A pixel of the contours: one whose middle is within half a pixel of a visible point.
      bool isContour = false, isIndex = false;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
          for (const Point& p : points[at(i, j)]) {
            const double dx = double(p.x) - x - 0.5, dy = double(p.y) - y - 0.5, w = seen->at(dx, dy);
            if (dx * dx + dy * dy > 0.25 || double(p.depth) * seen->here < 0.8 ||
                1 / double(p.depth) < w - (0.5 + reach) * seen->slack())
              continue;
            isContour = true;
            isIndex = isIndex || p.isIndex;
          }
      if (!isContour) continue;
      bool isInked = false;
      const int near = int(reach);
      for (int j = std::max(y - near, 0); j <= std::min(y + near, height - 1); ++j)
        for (int i = std::max(x - near, 0); i <= std::min(x + near, width - 1); ++i)
          isInked = isInked || (std::hypot(i - x, j - y) <= reach && hasInk(i, j));
      ++report.contour;
      report.contourWithout += isInked ? 0 : 1;
      if (isIndex) {
        ++report.index;
        report.indexWithout += isInked ? 0 : 1;
        if (!isInked) report.missing.push_back({x, y});
      }
    }
  return report;
}

}  // namespace arete::test
