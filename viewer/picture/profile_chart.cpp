// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distance and height have separate linear scales. The line of sight is drawn as a curve through points of
// its height above the map. Labels are placed last, where they cover nothing that is drawn.
#include "viewer/picture/profile_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viewer/picture/chart_labels.h"
#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr Rgb kGridLine = {229, 232, 236}, kGround = {196, 186, 168}, kGroundEdge = {96, 82, 60};
constexpr Rgb kClear = {0, 140, 90}, kBlocked = {205, 50, 30}, kZone = {60, 130, 210}, kGap = {238, 238, 240},
              kAssumed = {118, 122, 132};
constexpr int kLineSteps = 600;
constexpr double kLeastPlot = 80;  // pixels of height

struct Frame {
  Rect plot;
  double length = 1, low = 0, high = 1;

  Vec2 at(double s, double z) const {
    return {plot.left + plot.width * s / length, plot.bottom() - plot.height * (z - low) / (high - low)};
  }
};

std::string distanceText(double metres) {
  return metres >= 5000 ? numberText(metres / 1000) + " km" : numberText(metres) + " m";
}

/// The heights that have to be seen.
void include(double& low, double& high, double z) {
  if (!std::isfinite(z)) return;
  low = std::min(low, z);
  high = std::max(high, z);
}

constexpr double kLeastGap = 1e-3;  // metres; less is the rounding of the ends

/// From where to where terrain is missing.
std::vector<std::pair<double, double>> gapsOf(const Profile& profile) {
  std::vector<std::pair<double, double>> gaps;
  double end = 0;
  const auto add = [&](double begin) {
    if (begin - end > kLeastGap) gaps.emplace_back(end, begin);
  };
  for (const ProfileVertex& v : profile.vertices) {
    if (!v.isJoined) add(v.distance);
    end = v.distance;
  }
  add(profile.length);
  return gaps;
}

/// How far the line is free.
double freeLength(const ProfileSight& sight) {
  return sight.answer.obstruction ? sight.answer.obstruction->distance : sight.line.length();
}

/// The terrain between vertices that are joined, as one area per run.
void drawTerrain(Canvas& canvas, const Frame& frame, const Profile& profile, ChartLabels& labels) {
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
    labels.avoid(top);
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

/// The line of sight from one distance to another.
std::vector<Vec2> lineBetween(const Frame& frame, const ProfileSight& sight, double from, double to) {
  std::vector<Vec2> points = {frame.at(from, sight.line.height(from))};
  for (int i = 0; i <= kLineSteps; ++i)
    if (const double s = sight.line.length() * i / kLineSteps; s > from && s < to)
      points.push_back(frame.at(s, sight.line.height(s)));
  points.push_back(frame.at(to, sight.line.height(to)));
  return points;
}

/// Over terrain the free part is known to be free; over a gap it is what the question assumed.
void drawFreeLine(Canvas& canvas, const Frame& frame, const ProfileSight& sight, const Profile& profile,
                  ChartLabels& labels) {
  const double seen = freeLength(sight);
  double from = 0;
  const auto drawTo = [&](double to, bool isGap) {
    if (!(to > from)) return;
    const std::vector<Vec2> points = lineBetween(frame, sight, from, to);
    if (isGap)
      canvas.polyline(points, {.color = kAssumed, .width = 2.25, .dash = 4});
    else
      canvas.polyline(points, {.color = kClear, .width = 2.25});
    labels.avoid(points);
    from = to;
  };
  for (const auto& [begin, end] : gapsOf(profile)) {
    drawTo(std::min(begin, seen), false);
    drawTo(std::min(end, seen), true);
  }
  drawTo(seen, false);
}

void drawLine(Canvas& canvas, const Frame& frame, const ProfileSight& sight, const Profile& profile,
              ChartLabels& labels, const std::string& unit) {
  const double length = sight.line.length();
  const bool isBlocked = sight.answer.obstruction.has_value();
  const double seen = freeLength(sight);
  if (isBlocked) {
    const std::vector<Vec2> hidden = lineBetween(frame, sight, seen, length);
    canvas.polyline(hidden, {.color = kBlocked, .width = 2.25, .dash = 7});
    labels.avoid(hidden);
  }
  if (sight.fresnel) {
    const SightPlace& place = sight.fresnel->place;
    const Vec2 foot = frame.at(place.distance, place.terrainHeight);
    canvas.line(foot, frame.at(place.distance, place.sightHeight), {.color = kZone, .width = 1.5, .dash = 3});
    canvas.fillCircle(foot, 4, kZone);
    labels.avoid(std::vector{foot, frame.at(place.distance, place.sightHeight)});
  }
  drawFreeLine(canvas, frame, sight, profile, labels);
  for (const double s : {0.0, length}) canvas.fillCircle(frame.at(s, sight.line.height(s)), 4.5, kInk);
  if (isBlocked) {
    const Vec2 p = frame.at(seen, sight.line.height(seen));
    canvas.fillCircle(p, 7, {255, 255, 255});
    canvas.fillCircle(p, 5.5, kBlocked);
    labels.add(p, fmt::format("obstruction at {}", distanceText(seen)), kBlocked);
  }
  const auto heightText = [&](double s) {
    return numberText(sight.line.height(s)) + (unit.empty() ? "" : " " + unit);
  };
  labels.add(frame.at(0, sight.line.height(0)), "from, at " + heightText(0), kInk);
  labels.add(frame.at(length, sight.line.height(length)), "to, at " + heightText(length), kInk);
}

/// What is in the chart, by name.
std::vector<ChartKey> keysOf(const Profile& profile, const std::optional<ProfileSight>& sight) {
  std::vector<ChartKey> keys = {{"terrain", kGround, ChartKey::Shape::area}};
  if (profile.gapMetres > kLeastGap) keys.push_back({"no data", kGap, ChartKey::Shape::area});
  if (!sight) return keys;
  const bool isBlocked = sight->answer.obstruction.has_value();
  keys.push_back({isBlocked ? "line of sight, free" : "line of sight", kClear, ChartKey::Shape::line});
  if (const auto gaps = gapsOf(profile); !gaps.empty() && gaps.front().first < freeLength(*sight))
    keys.push_back({"line of sight, over no data", kAssumed, ChartKey::Shape::dashes});
  if (isBlocked) keys.push_back({"line of sight, behind the obstruction", kBlocked, ChartKey::Shape::dashes});
  if (sight->wavelength > 0)
    keys.push_back({fmt::format("first Fresnel zone, and {:g} of it", sight->part),
                    mix({255, 255, 255}, kZone, 0.33), ChartKey::Shape::area});
  if (sight->fresnel) keys.push_back({"where the terrain comes furthest in", kZone, ChartKey::Shape::dashes});
  return keys;
}

void drawAxes(Canvas& canvas, const Frame& frame, const ProfileChartOptions& options) {
  const bool isFar = frame.length >= 5000;
  const double perMetre = isFar ? 1e-3 : 1;
  const Rect& plot = frame.plot;
  const std::vector<double> heights = linearTicks(frame.low, frame.high, 6);
  const std::vector<std::string> heightTexts = tickTexts(heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double z = heights[i];
    // A line of one pixel is sharp where its middle is half a pixel from the grid.
    const double y = std::round(frame.at(0, z).y) + 0.5;
    canvas.line({plot.left, y}, {plot.right(), y}, {.color = kGridLine, .width = 1});
    canvas.text(heightTexts[i], {plot.left - 10, y},
                {.size = 14, .color = kInk, .horizontal = Align::end, .vertical = Align::center});
  }
  // Long numbers stand farther apart.
  const int most = std::clamp(int(plot.width / 110), 2, 9);
  const std::vector<double> distances = linearTicks(0, frame.length * perMetre, most);
  const std::vector<std::string> distanceTexts = tickTexts(distances);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double x = distances[i];
    const double at = std::round(frame.at(x / perMetre, frame.low).x) + 0.5;
    canvas.line({at, plot.bottom()}, {at, plot.bottom() + 6}, {.color = kInk, .width = 1});
    canvas.text(distanceTexts[i], {at, plot.bottom() + 12},
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
  // Doubles next to each other have no heights in between to draw.
  const double least = std::max(std::abs(low), std::abs(high)) * 1e-12;
  const double margin = high - low > least ? (high - low) * 0.06 : std::max(1.0, least);
  Frame frame{{}, profile.length, low - 2 * margin, high + 2.5 * margin};
  double widest = 0;
  for (const std::string& text : tickTexts(linearTicks(frame.low, frame.high, 6)))
    widest = std::max(widest, canvas.textWidth(text, {.size = 14}));
  const double left = std::max(104.0, widest + 56);
  std::vector<ChartKey> keys = keysOf(profile, sight);
  double above = 26 + (options.title.empty() ? 0 : 36) + (options.subtitle.empty() ? 0 : 26);
  const double keyTop = above - 6, keyWidth = options.width - left - 36;
  const double keyHeight = chartKeysHeight(canvas, keys, keyWidth) + 6;
  // A tiny chart has room for the chart alone.
  if (options.height - above - keyHeight - 74 < kLeastPlot)
    keys.clear();
  else
    above += keyHeight;
  frame.plot = {left, above, options.width - left - 36, options.height - above - 74};
  ChartLabels labels(frame.plot);
  // Metres of height and of distance in one pixel.
  const double tall = (frame.high - frame.low) * options.unitMetres / frame.plot.height,
               wide = profile.length / frame.plot.width;

  if (!options.title.empty()) {
    TextStyle style = {.size = 22, .color = kInk, .bold = true};
    style.size *= std::min(1.0, (options.width - 80) / canvas.textWidth(options.title, style));
    canvas.text(options.title, {40, 46}, style);
  }
  if (!options.subtitle.empty())
    canvas.text(options.subtitle, {40, options.title.empty() ? 36.0 : 74.0},
                {.size = std::min(
                     15.0, 15.0 * (options.width - 80) / canvas.textWidth(options.subtitle, {.size = 15})),
                 .color = kQuietInk});
  drawChartKeys(canvas, keys, {frame.plot.left, keyTop}, keyWidth);
  drawAxes(canvas, frame, options);
  canvas.text(fmt::format("vertical exaggeration {:.3g} \u00d7", wide / tall),
              {frame.plot.right(), options.height - 20.0},
              {.size = 14, .color = kQuietInk, .horizontal = Align::end});
  canvas.clip(frame.plot);
  drawTerrain(canvas, frame, profile, labels);
  if (sight && sight->wavelength > 0) drawZone(canvas, frame, *sight);
  canvas.unclip();
  if (sight) drawLine(canvas, frame, *sight, profile, labels, options.unit);
  canvas.line({frame.plot.left, frame.plot.bottom() + 0.5}, {frame.plot.right(), frame.plot.bottom() + 0.5},
              {.color = kInk, .width = 1});
  canvas.line({frame.plot.left + 0.5, frame.plot.top}, {frame.plot.left + 0.5, frame.plot.bottom()},
              {.color = kInk, .width = 1});
  labels.draw(canvas);
  return made;
}

}  // namespace arete
