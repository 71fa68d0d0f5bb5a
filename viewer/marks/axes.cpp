// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/marks/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "viewer/marks/units_of_axes.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr std::array<Rgba, 3> kAxisInks = {Rgba{214, 39, 40, 255}, {34, 139, 58, 255}, {38, 84, 220, 255}};
constexpr std::array<const char*, 3> kAxisNames = {"X", "Y", "Z"};
constexpr int kTicks = 8;
/// The axis of a side without a length, of the longest one.
constexpr double kLeastSide = 0.05;

struct Stroke {
  Vec2 from, to;
};
/// In a square of -1 to 1.
std::span<const Stroke> strokesOf(std::size_t axis) {
  static constexpr std::array<Stroke, 2> kX = {Stroke{{-0.7, -1}, {0.7, 1}}, {{-0.7, 1}, {0.7, -1}}};
  static constexpr std::array<Stroke, 3> kY = {
      Stroke{{-0.7, 1}, {0, 0}}, {{0.7, 1}, {0, 0}}, {{0, 0}, {0, -1}}};
  static constexpr std::array<Stroke, 3> kZ = {
      Stroke{{-0.7, 1}, {0.7, 1}}, {{0.7, 1}, {-0.7, -1}}, {{-0.7, -1}, {0.7, -1}}};
  if (axis == 0) return kX;
  return axis == 1 ? std::span<const Stroke>(kY) : std::span<const Stroke>(kZ);
}

double along(const Vec3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

Vec3 moved(Vec3 p, std::size_t axis, double to) {
  (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = to;
  return p;
}

}  // namespace

MarkLines axesOfFile(const Subject& subject, const Camera& camera, double stretch) {
  MarkLines axes;
  axes.legend.title = "axes";
  const Box3 box = subject.fileBox();
  const Vec3 corner = subject.fromFile(box.low);
  const double size = subject.box().diagonal() > 0 ? subject.box().diagonal() : 1;
  PictureAxes facing = axesOf(subject.space(), lookOf(camera));
  for (Vec3* const side : {&facing.right, &facing.up}) side->z /= stretch;
  std::array<Vec3, 3> ways;  // of length 1
  std::array<double, 3> perUnit{}, sides{};
  double longest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    // The model's own extent carries the step, so that it is exact enough wherever the file lies.
    const double step = std::max(along(box.high, a) - along(box.low, a), box.longestSide() * 1e-3);
    const Vec3 way = subject.fromFile(moved(box.low, a, along(box.low, a) + (step > 0 ? step : 1))) - corner;
    perUnit[a] = norm(way) / (step > 0 ? step : 1);
    ways[a] = way * (1 / norm(way));
    sides[a] = perUnit[a] * (along(box.high, a) - along(box.low, a));
    longest = std::max(longest, sides[a]);
  }
  if (!(longest > 0)) longest = 1;
  const std::array<std::string, 3> units = unitsOfAxes(subject);
  for (std::size_t a = 0; a < 3; ++a) {
    const Rgba& ink = kAxisInks[a];
    const double low = along(box.low, a), high = along(box.high, a);
    const double length = std::max(sides[a], kLeastSide * longest);
    const Vec3 end = corner + ways[a] * length;
    axes.lines.addLine(corner, end, ink);
    const Vec3 &across = ways[(a + 1) % 3], &other = ways[(a + 2) % 3];
    const double head = 0.02 * size;
    for (const Vec3& side : {across, across * -1.0, other, other * -1.0})
      axes.lines.addLine(end, end - head * ways[a] + 0.35 * head * side, ink);
    std::string text = fmt::format("{} {} to {}{}", kAxisNames[a], numberOf(low, high - low),
                                   numberOf(high, high - low), units[a]);
    if (low < high && sides[a] >= kLeastSide * longest) {
      const std::vector<double> ticks = linearTicks(low, high, kTicks);
      for (const double tick : ticks) {
        const Vec3 at = corner + ways[a] * (perUnit[a] * (tick - low));
        axes.lines.addLine(at, at - 0.5 * head * across, ink);
        axes.lines.addLine(at, at - 0.5 * head * other, ink);
      }
      if (ticks.size() > 1)
        text += fmt::format(", ticks {} apart", numberOf(ticks[1] - ticks[0], high - low));
    }
    const Vec3 middle = end + 2 * head * ways[a];
    for (const Stroke& s : strokesOf(a)) {
      const auto there = [&](Vec2 p) {
        return middle + 0.8 * head * (p.x * facing.right) + 0.8 * head * (p.y * facing.up);
      };
      axes.lines.addLine(there(s.from), there(s.to), ink);
    }
    axes.legend.entries.push_back({ink, text, Legend::Mark::line});
  }
  return axes;
}

}  // namespace arete
