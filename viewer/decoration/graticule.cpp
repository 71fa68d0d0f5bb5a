// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the picture covers is found by asking a net of its pixels for their places. Longitudes are counted on
// from the middle of the picture, so that a picture across the antimeridian has one range of them. Lines are
// halved until they follow their curve; where halving does not bring two ends together, a seam is between
// them.
#include "viewer/decoration/graticule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "viewer/picture/inks.h"

namespace arete {
namespace {

constexpr int kNet = 24;        // pixels asked in each direction
constexpr int kMostLines = 30;  // of each kind
constexpr int kFirstPieces = 32;
constexpr int kMostHalvings = 9;
constexpr int kMostOnGround = 5;   // of lines that follow rough ground
constexpr double kFarAway = 2.5;   // in scales of the middle
constexpr double kOffCurve = 0.3;  // pixels

/// Of longitudes and latitudes, in degrees.
struct Cover {
  double west = 0, east = 0, south = 0, north = 0;
  bool isAround = false;  ///< all longitudes
};

bool isInside(const Rect& frame, Vec2 p) {
  return p.x >= frame.left && p.x <= frame.right() && p.y >= frame.top && p.y <= frame.bottom();
}

double nearestTurn(double longitude, double to) {
  return longitude - 360 * std::round((longitude - to) / 360);
}

std::optional<Cover> coverOf(const PictureGround& ground) {
  const Rect& frame = ground.frame();
  std::optional<Cover> cover;
  const auto middle = ground.lonLatAt({frame.left + frame.width / 2, frame.top + frame.height / 2});
  double from = middle ? middle->x : 0;
  bool hasFrom = middle.has_value();
  for (int i = 0; i <= kNet; ++i)
    for (int j = 0; j <= kNet; ++j) {
      auto place =
          ground.lonLatAt({frame.left + frame.width * i / kNet, frame.top + frame.height * j / kNet});
      if (!place) continue;
      if (!hasFrom) from = place->x, hasFrom = true;
      const double x = ground.hasPlainLongitudes() ? place->x : nearestTurn(place->x, from);
      if (!cover) cover = Cover{x, x, place->y, place->y};
      cover->west = std::min(cover->west, x);
      cover->east = std::max(cover->east, x);
      cover->south = std::min(cover->south, place->y);
      cover->north = std::max(cover->north, place->y);
    }
  if (!cover || ground.hasPlainLongitudes()) return cover;
  for (const double pole : {-90.0, 90.0}) {
    const auto pixel = ground.pixelOf({from, pole});
    if (!pixel || !isInside(frame, *pixel)) continue;
    // A map may put the pole anywhere, on an edge that stands for it, say: its place has to lead back.
    const auto back = ground.lonLatAt(*pixel);
    if (!back || std::abs(back->y - pole) > 0.1) continue;
    (pole > 0 ? cover->north : cover->south) = pole;
    cover->isAround = true;
  }
  if (cover->east - cover->west > 340) cover->isAround = true;
  if (cover->isAround) {
    cover->west = -180;
    cover->east = 180;
  }
  return cover;
}

constexpr std::array<double, 10> kDegreeSteps = {90, 60, 45, 30, 20, 15, 10, 5, 2, 1};
constexpr std::array<double, 7> kSixtieths = {30, 20, 15, 10, 5, 2, 1};

/// The next coarser round step.
double coarser(double step) {
  double candidate = step;
  for (double factor = 1.3; candidate <= step * 1.0001 && factor < 12; factor += 0.3)
    candidate = roundAngleDown(std::min(90.0, step * factor));
  return candidate;
}
double finer(double step) {
  return roundAngleDown(step * 0.999);
}

double linesWithin(double low, double high, double step) {
  return std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1;
}

/// A curve of the picture by its parameter, in degrees.
using Curve = std::function<std::optional<Vec2>(double)>;

class Tracer {
 public:
  Tracer(const Rect& frame, const Curve& curve, int mostHalvings)
      : frame_(frame), curve_(curve), mostHalvings_(mostHalvings) {}

  std::vector<std::vector<Vec2>> trace(double from, double to) {
    std::optional<Vec2> before = curve_(from);
    if (before) part_.push_back(*before);
    for (int i = 1; i <= kFirstPieces; ++i) {
      const double a = from + (to - from) * (i - 1) / kFirstPieces, b = from + (to - from) * i / kFirstPieces;
      const std::optional<Vec2> next = curve_(b);
      between(a, before, b, next, 0);
      before = next;
    }
    end();
    return std::move(parts_);
  }

 private:
  void end() {
    if (part_.size() > 1) parts_.push_back(std::move(part_));
    part_.clear();
  }

  /// Both are beyond one edge of the picture.
  bool areOutside(Vec2 a, Vec2 b) const {
    return (a.x < frame_.left && b.x < frame_.left) || (a.x > frame_.right() && b.x > frame_.right()) ||
           (a.y < frame_.top && b.y < frame_.top) || (a.y > frame_.bottom() && b.y > frame_.bottom());
  }

  /// Adds what follows the place at `a`, up to and with the place at `b`.
  void between(double a, std::optional<Vec2> p, double b, std::optional<Vec2> q, int depth) {
    if (!p && !q) {
      // A short piece may be visible between two hidden places.
      if (depth < 2) halve(a, p, b, q, depth);
      return;
    }
    const double middle = (a + b) / 2;
    if (p && q) {
      const auto m = curve_(middle);
      const Vec2 straight = (*p + *q) * 0.5;
      const bool isStraight = m && std::hypot(m->x - straight.x, m->y - straight.y) <= kOffCurve;
      // Far outside of the picture a curve need not be followed, but it may come back.
      if (isStraight || (m && depth >= 2 && areOutside(*p, *q) && areOutside(*p, *m))) {
        part_.push_back(*q);
        return;
      }
      if (depth >= mostHalvings_) {
        if (std::hypot(p->x - q->x, p->y - q->y) > 3) end();
        part_.push_back(*q);
        return;
      }
    } else if (depth >= mostHalvings_) {
      if (p) end();
      if (q) part_.push_back(*q);
      return;
    }
    halve(a, p, b, q, depth);
  }

  void halve(double a, std::optional<Vec2> p, double b, std::optional<Vec2> q, int depth) {
    const double middle = (a + b) / 2;
    const auto m = curve_(middle);
    between(a, p, middle, m, depth + 1);
    between(middle, m, b, q, depth + 1);
  }

  Rect frame_;
  const Curve& curve_;
  int mostHalvings_;
  std::vector<Vec2> part_;
  std::vector<std::vector<Vec2>> parts_;
};

/// The pieces of a line within the frame, cut at its edges.
std::vector<Vec2> pointsInside(const Rect& frame, const GraticuleLine& line) {
  std::vector<Vec2> points;
  for (const auto& part : line.parts)
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (isInside(frame, part[i])) points.push_back(part[i]);
      if (i == 0) continue;
      const Vec2 a = part[i - 1], way = part[i] - a;
      const auto cut = [&](double start, double along, double edge) {
        const double t = (edge - start) / along;
        if (!(t >= 0 && t <= 1)) return;
        const Vec2 p = a + way * t;
        if (isInside({frame.left - 1e-6, frame.top - 1e-6, frame.width + 2e-6, frame.height + 2e-6}, p))
          points.push_back(p);
      };
      for (const double edge : {frame.left, frame.right()}) cut(a.x, way.x, edge);
      for (const double edge : {frame.top, frame.bottom()}) cut(a.y, way.y, edge);
    }
  return points;
}

bool overlap(const Rect& a, const Rect& b) {
  return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

}  // namespace

double roundAngleDown(double degrees) {
  const double slack = degrees * (1 + 1e-9);
  for (const double step : kDegreeSteps)
    if (step <= slack) return step;
  for (const double unit : {1.0 / 60, 1.0 / 3600})
    for (const double step : kSixtieths)
      if (step * unit <= slack) return step * unit;
  const double seconds = slack * 3600, decade = std::pow(10, std::floor(std::log10(seconds)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= seconds) return factor * decade / 3600;
  return decade / 3600;
}

std::string angleText(double degrees, double stepDegrees, bool isLongitude) {
  if (isLongitude) degrees = degrees - 360 * std::round(degrees / 360);
  const double seconds = stepDegrees * 3600;
  const int decimals = seconds < 0.999999 ? std::clamp(int(std::ceil(-std::log10(seconds) - 1e-9)), 1, 9) : 0;
  // Counted in the smallest part that is written, so that no 60 seconds appear.
  const double perDegree = stepDegrees > 0.999999        ? 1
                           : stepDegrees > 0.999999 / 60 ? 60
                                                         : 3600 * std::pow(10, decimals);
  const auto count = static_cast<long long>(std::llround(std::abs(degrees) * perDegree));
  const auto whole = static_cast<long long>(perDegree);
  std::string text = fmt::format("{}\u00b0", count / whole);
  const long long rest = count % whole;
  if (whole == 60) text += fmt::format(" {:02}\u2032", rest);
  if (whole > 60) {
    const long long perMinute = whole / 60;
    text += fmt::format(" {:02}\u2032 ", rest / perMinute);
    text += fmt::format("{:0{}.{}f}\u2033", double(rest % perMinute) * 60 / double(perMinute),
                        decimals > 0 ? decimals + 3 : 2, decimals);
  }
  // The equator, and the meridians on which east and west meet, have neither side.
  if (count == 0 || (isLongitude && count == 180 * whole)) return text;
  return text + (isLongitude ? degrees > 0 ? " E" : " W" : degrees > 0 ? " N" : " S");
}

std::vector<GraticuleLine> graticuleOf(const PictureGround& ground, double spacing) {
  if (!ground.hasLonLat()) return {};
  const auto cover = coverOf(ground);
  if (!cover) return {};
  const Rect& frame = ground.frame();
  Vec2 middle = {frame.left + frame.width / 2, frame.top + frame.height / 2};
  std::optional<double> scale;
  for (int i = 0; i < 32 && !scale; ++i, middle.y += frame.height / 64) scale = ground.lengthPerPixel(middle);
  if (!scale) return {};
  const auto place = ground.lonLatAt(middle);
  const double latitude = place ? place->y : (cover->south + cover->north) / 2;
  constexpr double kRadians = std::numbers::pi / 180;
  const double cosine = std::max(std::cos(latitude * kRadians), 0.02);
  const double wanted = spacing * *scale / (ground.georeference().semiMajorAxisMetres * kRadians);
  double latStep = roundAngleDown(std::clamp(wanted, 1e-9, 30.0));
  double lonStep = roundAngleDown(std::clamp(wanted / cosine, 1e-9, 90.0));
  while (linesWithin(cover->south, cover->north, latStep) > kMostLines && latStep < 30)
    latStep = coarser(latStep);
  while (linesWithin(cover->west, cover->east, lonStep) > kMostLines && lonStep < 90)
    lonStep = coarser(lonStep);
  // A small map may lie between two lines.
  for (int i = 0; i < 4 && linesWithin(cover->south, cover->north, latStep) < 2; ++i)
    latStep = finer(latStep);
  for (int i = 0; i < 4 && linesWithin(cover->west, cover->east, lonStep) < 2; ++i) lonStep = finer(lonStep);

  std::vector<GraticuleLine> lines;
  const auto add = [&](bool isMeridian, double at, double step, double from, double to) {
    const Curve curve = [&](double along) {
      return ground.pixelOf(isMeridian ? Vec2{at, along} : Vec2{along, at});
    };
    GraticuleLine line{isMeridian, isMeridian ? nearestTurn(at, 0) : at, angleText(at, step, isMeridian), {}};
    if (isMeridian && line.degrees <= -180) line.degrees = 180;
    line.parts = Tracer(frame, curve, ground.isPerspective() ? kMostOnGround : kMostHalvings).trace(from, to);
    std::erase_if(line.parts, [&](const std::vector<Vec2>& part) {
      return pointsInside(frame, {isMeridian, at, {}, {part}}).empty();
    });
    if (!line.parts.empty()) lines.push_back(std::move(line));
  };
  // Lines go on a little past what was found between the pixels asked.
  const double moreLat = (cover->north - cover->south) / kNet, moreLon = (cover->east - cover->west) / kNet;
  const double south = std::max(-90.0, cover->south - moreLat),
               north = std::min(90.0, cover->north + moreLat);
  const double west = cover->isAround ? -180 : cover->west - moreLon,
               east = cover->isAround ? 180 : cover->east + moreLon;
  for (double i = std::ceil(west / lonStep - 1e-9); i * lonStep <= east + lonStep * 1e-9; ++i) {
    // 180 degrees west and east are one meridian.
    if (cover->isAround && i * lonStep <= -180 + lonStep * 1e-9) continue;
    add(true, i * lonStep, lonStep, south, north);
  }
  for (double i = std::ceil(south / latStep - 1e-9); i * latStep <= north + latStep * 1e-9; ++i) {
    // The poles are points, whatever a map makes of them.
    if (std::abs(i * latStep) >= 90 - latStep * 1e-9) continue;
    add(false, i * latStep, latStep, west, east);
  }
  return lines;
}

void drawGraticuleLines(Canvas& canvas, const PictureGround& ground,
                        const std::vector<GraticuleLine>& lines) {
  canvas.clip(ground.frame());
  // Light under dark: the line is seen on any ground.
  const double light = ground.isPerspective() ? 0.45 : 0.25;
  for (const Stroke& stroke : {Stroke{.color = {255, 255, 255}, .width = 2.2, .alpha = light},
                               Stroke{.color = kInk, .width = 0.9, .alpha = 0.6}})
    for (const GraticuleLine& line : lines)
      for (const auto& part : line.parts) canvas.polyline(part, stroke);
  canvas.unclip();
}

void drawGraticuleLabels(Canvas& canvas, const PictureGround& ground, const std::vector<GraticuleLine>& lines,
                         std::span<const Rect> panels, double textSize) {
  const Rect& frame = ground.frame();
  std::vector<Rect> labels;
  // Towards a horizon lines come together, and their labels would be a heap.
  const auto middle = ground.lengthPerPixel({frame.left + frame.width / 2, frame.top + frame.height / 2});
  const auto isFarAway = [&](Vec2 p) {
    if (!ground.isPerspective() || !middle) return false;
    const auto there = ground.lengthPerPixel(p);
    return there && *there > kFarAway * *middle;
  };
  const auto isTaken = [](std::span<const Rect> others, const Rect& room) {
    return std::ranges::any_of(others, [&](const Rect& other) { return overlap(room, other); });
  };
  const TextStyle style = {.size = textSize, .color = kInk, .halo = textSize * 0.22};
  for (const GraticuleLine& line : lines) {
    std::vector<Vec2> points = pointsInside(frame, line);
    if (points.empty()) continue;
    const auto [first, last] =
        std::ranges::minmax_element(points, {}, [&](Vec2 p) { return line.isMeridian ? -p.y : p.x; });
    const double width = canvas.textWidth(line.label, style), height = textSize * 1.1;
    for (const Vec2 p : {*first, *last}) {
      if (isFarAway(p)) continue;
      Rect room = {line.isMeridian ? p.x - width / 2 : p.x + 4, p.y - height - 1, width, height};
      room.left = std::clamp(room.left, frame.left + 3, std::max(frame.left + 3, frame.right() - width - 3));
      room.top = std::clamp(room.top, frame.top + 3, std::max(frame.top + 3, frame.bottom() - height - 3));
      if (room.right() > frame.right() || room.bottom() > frame.bottom()) break;
      // Behind a panel the other end is labelled; beside another label none is missed.
      if (isTaken(panels, room)) continue;
      if (isTaken(labels, room)) break;
      canvas.text(line.label, {room.left, room.bottom() - textSize * 0.2}, style);
      labels.push_back(room);
      break;
    }
  }
}

}  // namespace arete
