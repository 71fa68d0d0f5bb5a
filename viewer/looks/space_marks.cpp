// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/looks/space_marks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

constexpr Rgba kRed{222, 64, 48, 255}, kGreen{72, 168, 64, 255}, kBlue{56, 112, 224, 255};
constexpr Rgba kGridInk{128, 128, 128, 140}, kOrbitInk{255, 200, 60, 255};
constexpr double kMostLines = 200;

/// What a step of one unit along an axis of the file is in metric space; zero where the file has no such
/// direction.
Vec3 alongFileAxis(const Subject& subject, std::size_t axis) {
  // A model's space is a similarity of its file's, so the steps of the inverse are read from three places.
  const Vec3 at = subject.box().centre();
  const double reach = std::max(subject.box().diagonal(), 1e-9);
  const Vec3 here = subject.inFile(at);
  Vec3 step;
  double squares = 0;
  for (const Vec3& to : {Vec3{reach, 0, 0}, Vec3{0, reach, 0}, Vec3{0, 0, reach}}) {
    const Vec3 moved = subject.inFile(at + to) - here;
    const double part = (axis == 0 ? moved.x : axis == 1 ? moved.y : moved.z) / reach;
    step = step + (part / reach) * to;
    squares += part * part;
  }
  return squares > 0 ? step / squares : Vec3{};
}

}  // namespace

double markStep(const Subject& subject) {
  const Vec3 size = subject.box().high - subject.box().low;
  const double side = std::max({size.x, size.y, 1e-9 * norm(size), 1e-300});
  const double tenth = side / 10, power = std::pow(10, std::floor(std::log10(tenth)));
  const double digit = tenth / power;
  return (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10) * power;
}

SpaceVertices axesOf(const Subject& subject) {
  const MetricBox& box = subject.box();
  std::array<Vec3, 3> along;
  for (std::size_t i = 0; i < 3; ++i) along[i] = alongFileAxis(subject, i);
  // The corner of the box from which all axes go inwards.
  const auto corner = [&](double of(const Vec3&)) {
    double sum = 0;
    for (const Vec3& a : along) sum += std::abs(of(a)) > 0.5 * norm(a) ? of(a) : 0;
    return sum >= 0;
  };
  const auto x = [](const Vec3& v) { return v.x; };
  const auto y = [](const Vec3& v) { return v.y; };
  const auto z = [](const Vec3& v) { return v.z; };
  const Vec3 origin{corner(x) ? box.low.x : box.high.x, corner(y) ? box.low.y : box.high.y,
                    corner(z) ? box.low.z : box.high.z};
  const Vec3 size = box.high - box.low;
  const double step = markStep(subject), tick = norm(size) / 150;
  SpaceVertices lines;
  const std::array inks = {kRed, kGreen, kBlue};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(norm(along[i]) > 0)) continue;
    const Vec3 way = unit(along[i]), aside = unit(along[(i + 1) % 3]);
    const double length = std::abs(way.x) * size.x + std::abs(way.y) * size.y + std::abs(way.z) * size.z;
    lines.addLine(origin, origin + std::max(length, 10 * tick) * way, inks[i]);
    for (double at = step; at <= length && at / step <= kMostLines; at += step)
      lines.addLine(origin + at * way, origin + at * way + tick * aside, inks[i]);
  }
  return lines;
}

SpaceVertices groundGridOf(const Subject& subject) {
  const MetricBox& box = subject.box();
  const double step = markStep(subject);
  const double west = step * std::floor(box.low.x / step - 0.5),
               east = step * std::ceil(box.high.x / step + 0.5),
               south = step * std::floor(box.low.y / step - 0.5),
               north = step * std::ceil(box.high.y / step + 0.5);
  SpaceVertices lines;
  if (!((east - west) / step < kMostLines && (north - south) / step < kMostLines)) return lines;
  for (int i = 0; west + i * step <= east + step / 2; ++i)
    lines.addLine({west + i * step, south, box.low.z}, {west + i * step, north, box.low.z}, kGridInk);
  for (int i = 0; south + i * step <= north + step / 2; ++i)
    lines.addLine({west, south + i * step, box.low.z}, {east, south + i * step, box.low.z}, kGridInk);
  return lines;
}

SpaceVertices orbitMark(const Vec3& target, double radius) {
  SpaceVertices lines;
  lines.isAlwaysSeen = true;
  for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    lines.addLine(target - (radius / 20) * way, target + (radius / 20) * way, kOrbitInk);
  return lines;
}

}  // namespace arete
