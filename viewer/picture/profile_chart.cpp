// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distance and height have separate linear scales. The line of sight is drawn as a curve through points of
// its height above the map.
#include "viewer/picture/profile_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr Rgb kGridLine = {229, 232, 236}, kGround = {196, 186, 168}, kGroundEdge = {96, 82, 60};
constexpr Rgb kClear = {0, 140, 90}, kBlocked = {205, 50, 30}, kZone = {60, 130, 210}, kGap = {238, 238, 240};
constexpr int kLineSteps = 600;

struct Frame {
  Rect plot;
  double length = 1, low = 0, high = 1;

  Vec2 at(double s, double z) const {
    return {plot.left + plot.width * s / length, plot.bottom() - plot.height * (z - low) / (high - low)};
  }
};

/// The heights that have to be seen.
void include(double& low, double& high, double z) {
  if (!std::isfinite(z)) return;
  low = std::min(low, z);
  high = std::max(high, z);
}

/// The terrain between vertices that are joined, as one area per run.
void drawTerrain(Canvas& canvas, const Frame& frame, const Profile& profile) {
  const auto& vertices = profile.vertices;
  // Where the terrain is not known, the plot is shaded over its whole height, at both ends as well.
  double end = 0;
  const auto drawGap = [&](double from, double to) {
    const Vec2 a = frame.at(from, frame.low), b = frame.at(to, frame.high);
    if (to > from) canvas.fill({a.x, b.y, b.x - a.x, a.y - b.y}, kGap);
  };
  for (std::size_t begin = 0; begin < vertices.size();) {
    std::size_t last = begin + 1;
    while (last < vertices.size() && vertices[last].isJoined) ++last;
    std::vector<Vec2> top;
    for (std::size_t i = begin; i < last; ++i)
      top.push_back(frame.at(vertices[i].distance, vertices[i].height));
    drawGap(end, vertices[begin].distance);
    end = vertices[last - 1].distance;
    std::vector<Vec2> area = top;
    area.push_back({top.back().x, frame.plot.bottom()});
    area.push_back({top.front().x, frame.plot.bottom()});
    canvas.fillPolygon(area, kGround);
    canvas.polyline(top, {.color = kGroundEdge, .width = 1.5});
    begin = last;
  }
  drawGap(end, profile.length);
}

void drawZone(Canvas& canvas, const Frame& frame, const ProfileSight& sight) {
  const double length = sight.line.length(), unit = sight.line.heightUnitMetres();
  // The whole zone is drawn fainter, and over it the part that has to be clear.
  for (const auto& [part, alpha] : {std::pair{1.0, 0.16}, {sight.part, 0.20}}) {
    std::vector<Vec2> zone;
    for (int i = 0; i <= 2 * kLineSteps; ++i) {
      const bool isUpper = i <= kLineSteps;
      const double s = length * (isUpper ? i : 2 * kLineSteps - i) / kLineSteps;
      const double radius = part * fresnelRadius(sight.wavelength, s, length) / unit;
      zone.push_back(frame.at(s, sight.line.height(s) + (isUpper ? radius : -radius)));
    }
    canvas.fillPolygon(zone, kZone, alpha);
  }
}

void drawLine(Canvas& canvas, const Frame& frame, const ProfileSight& sight) {
  const double length = sight.line.length();
  const bool isBlocked = sight.answer.obstruction.has_value();
  const double seen = isBlocked ? sight.answer.obstruction->distance : length;
  std::vector<Vec2> clear, hidden;
  for (int i = 0; i <= kLineSteps; ++i) {
    const double s = length * i / kLineSteps;
    (s <= seen ? clear : hidden).push_back(frame.at(s, sight.line.height(s)));
  }
  // The clear and the hidden part meet at the obstruction, which is between two steps.
  if (isBlocked) {
    const Vec2 p = frame.at(seen, sight.line.height(seen));
    clear.push_back(p);
    hidden.insert(hidden.begin(), p);
    canvas.polyline(hidden, {.color = kBlocked, .width = 2.25, .dash = 7});
  }
  if (sight.fresnel) {
    const SightPlace& place = sight.fresnel->place;
    const Vec2 foot = frame.at(place.distance, place.terrainHeight);
    canvas.line(foot, frame.at(place.distance, place.sightHeight), {.color = kZone, .width = 1.5, .dash = 3});
    canvas.fillCircle(foot, 4, kZone);
  }
  canvas.polyline(clear, {.color = kClear, .width = 2.25});
  for (const double s : {0.0, length}) canvas.fillCircle(frame.at(s, sight.line.height(s)), 4.5, kInk);
  if (isBlocked) {
    const Vec2 p = frame.at(seen, sight.line.height(seen));
    canvas.fillCircle(p, 7, {255, 255, 255});
    canvas.fillCircle(p, 5.5, kBlocked);
    // The text goes to the side of the place that has more room.
    const bool isLeft = p.x < frame.plot.left + frame.plot.width / 2;
    canvas.text(fmt::format("obstruction at {} m", numberText(seen)), {p.x + (isLeft ? 12 : -12), p.y - 10},
                {.size = 14, .color = kBlocked, .horizontal = isLeft ? Align::start : Align::end});
  }
}

void drawAxes(Canvas& canvas, const Frame& frame, const ProfileChartOptions& options) {
  const bool isFar = frame.length >= 5000;
  const double perMetre = isFar ? 1e-3 : 1;
  const Rect& plot = frame.plot;
  for (const double z : linearTicks(frame.low, frame.high, 6)) {
    // A line of one pixel is sharp where its middle is half a pixel from the grid.
    const double y = std::round(frame.at(0, z).y) + 0.5;
    canvas.line({plot.left, y}, {plot.right(), y}, {.color = kGridLine, .width = 1});
    canvas.text(numberText(z), {plot.left - 10, y},
                {.size = 14, .color = kInk, .horizontal = Align::end, .vertical = Align::center});
  }
  for (const double x : linearTicks(0, frame.length * perMetre, 9)) {
    const double at = std::round(frame.at(x / perMetre, frame.low).x) + 0.5;
    canvas.line({at, plot.bottom()}, {at, plot.bottom() + 6}, {.color = kInk, .width = 1});
    canvas.text(numberText(x), {at, plot.bottom() + 12},
                {.size = 14, .color = kInk, .horizontal = Align::center, .vertical = Align::start});
  }
  canvas.text(isFar ? "distance along the ground, km" : "distance along the ground, m",
              {plot.left + plot.width / 2, options.height - 20.0},
              {.size = 15, .color = kInk, .horizontal = Align::center});
  canvas.text(options.unit.empty() ? "height" : "height, " + options.unit, {30, plot.top + plot.height / 2},
              {.size = 15, .color = kInk, .horizontal = Align::center, .turnDegrees = 90});
}

}  // namespace

Result<Canvas> drawProfile(const Profile& profile, const std::optional<ProfileSight>& sight,
                           const ProfileChartOptions& options) {
  if (options.width < 320 || options.height < 240)
    return failure(ErrorCode::usage,
                   fmt::format("A chart of {} x {} pixels has no room; take 320 x 240 or more.",
                               options.width, options.height));
  if (profile.vertices.empty() || !(profile.length > 0))
    return failure(ErrorCode::degenerate, "a profile without terrain or without a length is nothing to draw");
  auto made = Canvas::create(options.width, options.height);
  if (!made) return made;
  Canvas& canvas = *made;
  const double above = 26 + (options.title.empty() ? 0 : 36) + (options.subtitle.empty() ? 0 : 26);
  Frame frame{{104, above, options.width - 104.0 - 36, options.height - above - 74}, profile.length};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ProfileVertex& v : profile.vertices) include(low, high, v.height);
  if (sight) {
    const double length = sight->line.length(), unit = sight->line.heightUnitMetres();
    for (int i = 0; i <= 64; ++i) {
      const double s = length * i / 64, z = sight->line.height(s);
      const double radius = sight->wavelength > 0 ? fresnelRadius(sight->wavelength, s, length) / unit : 0;
      include(low, high, z - radius);
      include(low, high, z + radius);
    }
  }
  const double margin = high > low ? (high - low) * 0.06 : 1;
  frame.low = low - 2 * margin;
  frame.high = high + margin;

  if (!options.title.empty()) {
    TextStyle style = {.size = 22, .color = kInk, .bold = true};
    style.size *= std::min(1.0, (options.width - 80) / canvas.textWidth(options.title, style));
    canvas.text(options.title, {40, 46}, style);
  }
  if (!options.subtitle.empty())
    canvas.text(options.subtitle, {40, options.title.empty() ? 36.0 : 74.0},
                {.size = 15, .color = kQuietInk});
  drawAxes(canvas, frame, options);
  canvas.clip(frame.plot);
  drawTerrain(canvas, frame, profile);
  if (sight && sight->wavelength > 0) drawZone(canvas, frame, *sight);
  canvas.unclip();
  if (sight) drawLine(canvas, frame, *sight);
  canvas.line({frame.plot.left, frame.plot.bottom() + 0.5}, {frame.plot.right(), frame.plot.bottom() + 0.5},
              {.color = kInk, .width = 1});
  canvas.line({frame.plot.left + 0.5, frame.plot.top}, {frame.plot.left + 0.5, frame.plot.bottom()},
              {.color = kInk, .width = 1});
  return made;
}

}  // namespace arete
