// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every edge is drawn once, thin and dark over a washed-out relief. What decides the ink is the length of a
// typical edge in pixels: from a dozen pixels up the lines stand by themselves; below, they get lighter with
// their length, so that dense ground turns into a tone instead of a black patch. Then a detail is cut out
// where the heights vary most within its size, and put into the corner of the map farthest from it.
#include "viewer/map/tin_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "viewer/map/map_page.h"
#include "viewer/picture/hillshade.h"
#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr double kDetailZoom = 4;
constexpr double kReadableEdge = 12;  // pixels
constexpr double kDetailBelowEdge = 9;
constexpr Rgb kEdgeColor = {24, 34, 58};
constexpr Rgb kDetailColor = {168, 44, 30};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> uniqueEdges(const TriangleMesh& tin) {
  std::vector<Edge> edges;
  edges.reserve(tin.triangles.size() * 3);
  for (const auto& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Side of an equilateral triangle as large as the TIN's mean one, in pixels.
double typicalEdge(const MapView& view, std::size_t triangles) {
  const double area = double(view.width) * view.height / std::max<double>(1, double(triangles));
  return std::sqrt(area * 4 / std::sqrt(3.0));
}

Stroke edgeStroke(double edgeLength) {
  const double readable = std::clamp(edgeLength / kReadableEdge, 0.0, 1.0);
  return {.color = kEdgeColor, .width = 0.55 + 0.35 * readable, .alpha = 0.10 + 0.72 * readable};
}

/// Draws the edges that can be seen in `view`, which stands at `area` of the canvas.
void drawEdges(Canvas& canvas, const std::vector<Vec2>& grid, const std::vector<Edge>& edges,
               const MapView& view, const Rect& area, const Stroke& stroke) {
  std::vector<Vec2> ends;
  for (const auto& [a, b] : edges) {
    const Vec2 p = view.toPixel(grid[a].x, grid[a].y), q = view.toPixel(grid[b].x, grid[b].y);
    if (std::max(p.x, q.x) < 0 || std::max(p.y, q.y) < 0) continue;
    if (std::min(p.x, q.x) > view.width || std::min(p.y, q.y) > view.height) continue;
    ends.push_back({area.left + p.x, area.top + p.y});
    ends.push_back({area.left + q.x, area.top + q.y});
  }
  canvas.clip(area);
  canvas.segments(ends, stroke);
  canvas.unclip();
}

/// Of the windows of the given size, in view pixels, the one with the most vertices.
Rect busiestWindow(const std::vector<Vec2>& grid, const MapView& view, double width, double height) {
  // Vertices are counted in cells of a quarter of the window; the window slides by cells.
  constexpr int kParts = 4;
  const double cellWidth = width / kParts, cellHeight = height / kParts;
  const int across = std::max(kParts, int(view.width / cellWidth)),
            down = std::max(kParts, int(view.height / cellHeight));
  std::vector<std::size_t> counts(std::size_t(across) * std::size_t(down));
  for (const Vec2& g : grid) {
    const Vec2 p = view.toPixel(g.x, g.y);
    const int column = int(std::floor(p.x / cellWidth)), row = int(std::floor(p.y / cellHeight));
    if (column < 0 || row < 0 || column >= across || row >= down) continue;
    ++counts[std::size_t(row) * std::size_t(across) + std::size_t(column)];
  }
  Rect best = {0, 0, width, height};
  std::size_t most = 0;
  for (int row = 0; row + kParts <= down; ++row) {
    for (int column = 0; column + kParts <= across; ++column) {
      std::size_t count = 0;
      for (int i = 0; i < kParts * kParts; ++i) {
        count +=
            counts[std::size_t(row + i / kParts) * std::size_t(across) + std::size_t(column + i % kParts)];
      }
      if (count > most) {
        most = count;
        best = {std::round(column * cellWidth), std::round(row * cellHeight), width, height};
      }
    }
  }
  return best;
}

void drawDetail(MapPage& page, const RasterHeightfield& ground, const std::vector<Vec2>& grid,
                const std::vector<Edge>& edges, double edgeLength) {
  constexpr double kInset = 14;
  const double width = std::floor(std::min(page.map.width, page.map.height * 1.6) * 0.36 / kDetailZoom);
  const double height = std::floor(width * 0.75);
  const Rect window = busiestWindow(grid, page.view, width, height);
  const MapView view = page.view.crop(window, kDetailZoom);
  // The corner farthest from the window, so that neither hides the other.
  const bool right = window.left + width / 2 < page.map.width / 2,
             low = window.top + height / 2 < page.map.height / 2;
  const Rect area = {right ? page.map.right() - view.width - kInset : page.map.left + kInset,
                     low ? page.map.bottom() - view.height - kInset : page.map.top + kInset,
                     double(view.width), double(view.height)};
  const Rect source = {page.map.left + window.left, page.map.top + window.top, width, height};

  page.canvas.frame({area.left - 4, area.top - 4, area.width + 8, area.height + 8},
                    {.color = {255, 255, 255}, .width = 5});
  page.canvas.image(drawHillshade(ground, view, {.tint = 0.75, .wash = 0.22}), int(area.left), int(area.top));
  drawEdges(page.canvas, grid, edges, view, area, edgeStroke(edgeLength * kDetailZoom));
  page.canvas.frame(area, {.color = kDetailColor, .width = 2});
  page.canvas.frame(source, {.color = {255, 255, 255}, .width = 4});
  page.canvas.frame(source, {.color = kDetailColor, .width = 2});
  const Rect label = {area.left + 1, area.top + 1, 46, 25};
  page.canvas.fill(label, kDetailColor);
  page.canvas.text(fmt::format("{:.0f} \u00d7", kDetailZoom),
                   {label.left + label.width / 2, label.top + label.height / 2},
                   {.size = 14,
                    .color = {255, 255, 255},
                    .bold = true,
                    .horizontal = Align::center,
                    .vertical = Align::center});
}

/// Two digits are enough for a share.
std::string percentText(double percent) {
  return percent >= 10 ? fmt::format("{:.0f}", percent) : fmt::format("{:.2g}", percent);
}

std::vector<std::string> captionOf(const RasterHeightfield& ground, const TriangleMesh& tin,
                                   const TinPictureOptions& options) {
  const std::string& name = ground.georeference.verticalUnit;
  const std::string unit = name.empty() ? "" : (name == "metre" ? " m" : " " + name);
  std::string first;
  const auto add = [&](const std::string& part) { first += (first.empty() ? "" : "   \u00b7   ") + part; };
  if (!tin.triangles.empty()) {
    std::string count =
        countText(tin.triangles.size()) + (tin.triangles.size() == 1 ? " triangle" : " triangles");
    if (options.finestTriangles && *options.finestTriangles > 0) {
      count +=
          fmt::format(" ({} % of {})",
                      percentText(100.0 * double(tin.triangles.size()) / double(*options.finestTriangles)),
                      countText(*options.finestTriangles));
    }
    add(count);
  }
  if (options.tolerance) add("tolerance " + numberText(*options.tolerance) + unit);
  if (options.measuredError) add("measured error " + numberText(*options.measuredError) + unit);
  std::vector<std::string> lines;
  if (!first.empty()) lines.push_back(first);
  lines.push_back(fmt::format("{} \u00d7 {} samples", countText(ground.columns), countText(ground.rows)));
  return lines;
}

/// The colours of level ground, and the lines.
ColorLegend legendFor(const RasterHeightfield& ground, const TriangleMesh& tin,
                      const HillshadeOptions& relief) {
  ColorLegend legend = legendOf(hillshadeTints(ground), "height", ground.georeference.verticalUnit);
  if (legend.scale) legend.scale->shade = [relief](Rgb tint, double) { return onLevelGround(tint, relief); };
  if (!tin.triangles.empty())
    legend.classes.push_back({{kEdgeColor}, "edges of triangles", Legend::Mark::line});
  return legend;
}

}  // namespace

Result<Canvas> drawTin(const RasterHeightfield& ground, const TriangleMesh& tin,
                       const TinPictureOptions& options) {
  ARETE_CHECK(tin.validate());
  const HillshadeOptions relief = {.tint = 0.85, .wash = tin.triangles.empty() ? 0.0 : 0.15};
  ARETE_TRY(auto page, makeMapPage(ground.columns, ground.rows, ground.georeference,
                                   {.width = options.width,
                                    .title = options.title,
                                    .caption = captionOf(ground, tin, options),
                                    .legends = {legendFor(ground, tin, relief)},
                                    .isDecorated = options.isDecorated}));

  page.canvas.image(drawHillshade(ground, page.view, relief), int(page.map.left), int(page.map.top));
  std::vector<Vec2> grid;
  grid.reserve(tin.positions.size());
  for (const Vec3& p : tin.positions) grid.push_back(ground.georeference.toGrid(p.x, p.y));
  const auto edges = uniqueEdges(tin);
  const double edgeLength = typicalEdge(page.view, tin.triangles.size());
  drawEdges(page.canvas, grid, edges, page.view, page.map, edgeStroke(edgeLength));
  page.finish();
  if (options.detail && !tin.triangles.empty() && edgeLength < kDetailBelowEdge)
    drawDetail(page, ground, grid, edges, edgeLength);
  return std::move(page.canvas);
}

}  // namespace arete
