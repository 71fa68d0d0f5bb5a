// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four lines of each row of pixels cross the rings of a polygon, and the spans between the crossings cover
// pixels to the exact part of their width.
#include "viewer/layers/polygon_fill.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

constexpr int kLinesOfRow = 4;
constexpr int kMargin = 1;  // free pixels around the picture, which smooth its rim

class PolygonRaster {
 public:
  PolygonRaster(int width, int height)
      : width_(width), height_(height), covered_(std::size_t(width) * std::size_t(height), 0.f) {}

  /// An edge of the polygon at hand, in pixels.
  void edge(Vec2 a, Vec2 b) {
    if (a.y > b.y) std::swap(a, b);
    const double first = std::ceil(a.y * kLinesOfRow - 0.5), end = std::ceil(b.y * kLinesOfRow - 0.5);
    for (double line = std::max(first, 0.0); line < std::min(end, double(height_) * kLinesOfRow); ++line) {
      const double y = (line + 0.5) / kLinesOfRow;
      crossings_[std::uint32_t(line)].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }

  void endPolygon() {
    for (auto& [line, at] : crossings_) {
      std::ranges::sort(at);
      for (std::size_t i = 0; i + 1 < at.size(); i += 2) span(int(line) / kLinesOfRow, at[i], at[i + 1]);
    }
    crossings_.clear();
  }

  const std::vector<float>& covered() const { return covered_; }

 private:
  void span(int row, double from, double to) {
    from = std::clamp(from, 0.0, double(width_));
    to = std::clamp(to, 0.0, double(width_));
    float* pixels = &covered_[std::size_t(row) * std::size_t(width_)];
    for (int x = int(from); x < width_ && x < to; ++x)
      pixels[x] += float((std::min(to, x + 1.0) - std::max(from, double(x))) / kLinesOfRow);
  }

  int width_, height_;
  std::vector<float> covered_;  // 1: whole; more where polygons overlap
  std::map<std::uint32_t, std::vector<double>> crossings_;
};

}  // namespace

std::optional<PlanPicture> fillOf(const FeatureLayer& layer, const TerrainModel& model, Rgb color,
                                  int mostSide) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box2 box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const auto& line : layer.lines)
    if (line.polygon != FeatureLayer::kNoPolygon)
      for (std::uint64_t i = line.first; i < line.first + line.count; ++i) {
        const Vec2 p = model.toPlan(layer.vertices[i]);
        box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
               std::max(box.yMax, p.y)};
      }
  const Box2 terrain = planBox(model);
  box = {std::max(box.xMin, terrain.xMin), std::max(box.yMin, terrain.yMin), std::min(box.xMax, terrain.xMax),
         std::min(box.yMax, terrain.yMax)};
  if (!(box.xMax > box.xMin && box.yMax > box.yMin)) return std::nullopt;

  const double step = std::max(box.xMax - box.xMin, box.yMax - box.yMin) / (mostSide - 2 * kMargin);
  PlanPicture picture;
  picture.isArea = true;
  picture.width = std::max(1, int(std::ceil((box.xMax - box.xMin) / step))) + 2 * kMargin;
  picture.height = std::max(1, int(std::ceil((box.yMax - box.yMin) / step))) + 2 * kMargin;
  const auto pixel = [&](Vec2 xy) {
    const Vec2 p = model.toPlan(xy);
    return Vec2{(p.x - box.xMin) / step + kMargin, (p.y - box.yMin) / step + kMargin};
  };
  PolygonRaster raster(picture.width, picture.height);
  std::uint64_t polygon = FeatureLayer::kNoPolygon;
  for (const auto& line : layer.lines) {
    if (line.polygon != polygon) raster.endPolygon();
    polygon = line.polygon;
    if (polygon == FeatureLayer::kNoPolygon) continue;
    for (std::uint64_t i = line.first + 1; i < line.first + line.count; ++i)
      raster.edge(pixel(layer.vertices[i - 1]), pixel(layer.vertices[i]));
  }
  raster.endPolygon();
  picture.rgba.reserve(raster.covered().size());
  for (std::size_t i = 0; i < raster.covered().size(); ++i) {
    const auto column = int(i) % picture.width, row = int(i) / picture.width;
    const bool isMargin = column == 0 || row == 0 || column + 1 == picture.width || row + 1 == picture.height;
    const float part = isMargin ? 0.f : std::min(raster.covered()[i], 1.f);
    picture.rgba.push_back({color.r, color.g, color.b, std::uint8_t(std::lround(255 * part))});
  }
  picture.scale = {1 / (step * picture.width), 1 / (step * picture.height)};
  picture.shift = {(kMargin - box.xMin / step) / picture.width, (kMargin - box.yMin / step) / picture.height};
  return picture;
}

}  // namespace arete
