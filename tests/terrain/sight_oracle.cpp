// SPDX-License-Identifier: GPL-3.0-or-later
//
// A piece of the track is cut by the three edges of every triangle near it; over what is left both the
// triangle's plane and the distance are linear, and the line has at most one place where it runs parallel to
// the plane: it is where the chord's angle from the foot of the centre's perpendicular says (a quadratic
// equation). No order of cells, no neighbours, no diagonals to cross.
#include "terrain/sight_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace arete::test {
namespace {

/// Gaps shorter than this, in plan, are rounding.
constexpr long double kShortestGap = 1e-9L;
/// What the engines may be wrong by in a height, in metres: the polynomials' 1e-7, and rounding.
constexpr long double kNoise = 2e-7L;

}  // namespace

OracleLine::OracleLine(long double curvature, long double length, long double height0, long double height1)
    : length_(length), height0_(height0), height1_(height1) {
  if (curvature == 0) return;
  sign_ = curvature < 0 ? -1 : 1;
  radius_ = 1 / std::fabs(curvature);
  // Seen from the first end: x away from the centre, y along the ground there. Differences are taken before
  // they are lost in the radius.
  const long double angle = length / radius_, half = std::sin(angle / 2);
  r0_ = radius_ + sign_ * height0;
  r1_ = radius_ + sign_ * height1;
  chord_[0] = sign_ * (height1 - height0) - 2 * r1_ * half * half;
  chord_[1] = r1_ * std::sin(angle);
  const long double chord = std::hypot(chord_[0], chord_[1]);
  along_[0] = chord_[0] / chord;
  along_[1] = chord_[1] / chord;
  normal_[0] = along_[1];
  normal_[1] = -along_[0];
  fromCentre_ = r0_ * normal_[0];
  footAngle_ = std::atan2(normal_[1], normal_[0]);
}

OracleLine::HeightAndSlope OracleLine::at(long double s) const {
  if (isStraight()) {
    const long double slope = length_ > 0 ? (height1_ - height0_) / length_ : 0;
    return {height0_ + slope * s, slope};
  }
  // The ray from the centre at the angle of s meets the chord at this part of it, by the areas on either
  // side.
  const long double left = r0_ * std::sin(s / radius_), right = r1_ * std::sin((length_ - s) / radius_);
  const long double part = left / (left + right);
  const long double x = part * chord_[0], y = part * chord_[1];
  const long double r = std::hypot(r0_ + x, y);
  const long double higher = (2 * r0_ * x + x * x + y * y) / (r + r0_);
  // The angle between the ray and the perpendicular.
  const long double c = (r0_ + x) / r, d = y / r;
  const long double cosine = c * normal_[0] + d * normal_[1], sine = c * along_[0] + d * along_[1];
  return {height0_ + sign_ * higher, sign_ * r * (sine / cosine) / radius_};
}

long double OracleLine::whereSlopeIs(long double slope) const {
  // d sin u / cos^2 u = slope * radius
  const long double q = sign_ * slope * radius_;
  const long double sine = 2 * q / (fromCentre_ + std::sqrt(fromCentre_ * fromCentre_ + 4 * q * q));
  return (footAngle_ + std::asin(sine)) * radius_;
}

long double OracleLine::tangentAtFirst() const {
  if (isStraight()) return (height1_ - height0_) / length_;
  return sign_ * chord_[0] / chord_[1];
}

SightOracle::SightOracle(const RasterHeightfield& raster)
    : SightOracle(raster.columns, raster.rows, raster.heights) {}

SightOracle::SightOracle(std::uint32_t columns, std::uint32_t rows, std::vector<double> heights)
    : columns_(columns), rows_(rows), heights_(std::move(heights)) {}

SightOracle::SightOracle(const MultiTriangulation& mt, const Cut& front) {
  for (const auto& t : front.triangles) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = mt.position(VertexId(front.vertices[t[i]]));
      triangle[i] = {p.x, p.y, p.z};
    }
    triangles_.push_back(triangle);
  }
}

void SightOracle::cellTriangles(std::int64_t column, std::int64_t row, std::vector<Triangle>& to) const {
  std::array<Corner, 4> valid;  // upper left, lower left, lower right, upper right: counter-clockwise or not
  std::size_t count = 0;
  for (const auto& [x, y] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
    const double z = heights_[std::size_t(row + y) * columns_ + std::size_t(column + x)];
    if (!std::isnan(z)) valid[count++] = {double(column + x), double(row + y), z};
  }
  if (count >= 3) to.push_back({valid[0], valid[1], valid[2]});
  if (count == 4) to.push_back({valid[0], valid[2], valid[3]});
}

void SightOracle::candidates(Vec2 a, Vec2 b, std::vector<Triangle>& to) const {
  to.clear();
  const double margin = 1e-6 * (1 + std::fabs(a.x) + std::fabs(a.y));
  const double nx = a.y - b.y, ny = b.x - a.x, far = margin * std::hypot(nx, ny);
  // All corners on one side of the line.
  const auto isBeside = [&](const Triangle& t) {
    double side[3];
    for (std::size_t i = 0; i < 3; ++i) side[i] = nx * (t[i].x - a.x) + ny * (t[i].y - a.y);
    return std::min({side[0], side[1], side[2]}) > far || std::max({side[0], side[1], side[2]}) < -far;
  };
  if (columns_ == 0) {
    const double xMin = std::min(a.x, b.x) - margin, xMax = std::max(a.x, b.x) + margin;
    const double yMin = std::min(a.y, b.y) - margin, yMax = std::max(a.y, b.y) + margin;
    for (const Triangle& t : triangles_) {
      if (std::max({t[0].x, t[1].x, t[2].x}) < xMin || std::min({t[0].x, t[1].x, t[2].x}) > xMax ||
          std::max({t[0].y, t[1].y, t[2].y}) < yMin || std::min({t[0].y, t[1].y, t[2].y}) > yMax)
        continue;
      if (!isBeside(t)) to.push_back(t);
    }
    return;
  }
  // Row by row: the columns that the piece passes there, and one more on either side.
  const auto first =
      static_cast<std::int64_t>(std::floor(std::clamp(std::min(a.y, b.y) - 1, 0.0, double(rows_))));
  const auto last =
      static_cast<std::int64_t>(std::floor(std::clamp(std::max(a.y, b.y) + 1, -1.0, double(rows_) - 2)));
  for (std::int64_t row = first; row <= last; ++row) {
    double low = std::min(a.x, b.x), high = std::max(a.x, b.x);
    if (std::fabs(a.y - b.y) > 1e-6) {
      const auto xAt = [&](double y) { return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y)); };
      const double x0 = xAt(double(row) - 0.01), x1 = xAt(double(row) + 1.01);
      low = std::max(low, std::min(x0, x1));
      high = std::min(high, std::max(x0, x1));
    }
    if (!(low <= high + 2)) continue;
    const auto from = static_cast<std::int64_t>(std::floor(std::clamp(low - 1.01, 0.0, double(columns_))));
    const auto to_ =
        static_cast<std::int64_t>(std::floor(std::clamp(high + 1.01, -1.0, double(columns_) - 2)));
    for (std::int64_t column = from; column <= to_; ++column) cellTriangles(column, row, to);
  }
  std::erase_if(to, isBeside);
}

std::optional<std::array<long double, 2>> SightOracle::clip(const Triangle& t, Vec2 a, Vec2 b,
                                                            long double reach) {
  const auto cross = [](long double ux, long double uy, long double vx, long double vy) {
    return ux * vy - uy * vx;
  };
  const long double area = cross((long double)t[1].x - t[0].x, (long double)t[1].y - t[0].y,
                                 (long double)t[2].x - t[0].x, (long double)t[2].y - t[0].y);
  if (area == 0) return {};
  long double first = 0, last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &p = t[i], &q = t[(i + 1) % 3];
    const long double ex = (long double)q.x - p.x, ey = (long double)q.y - p.y;
    const long double length = std::sqrt(ex * ex + ey * ey) * (area < 0 ? -1 : 1);
    // How far inside of the edge the piece begins and ends.
    const long double in0 = cross(ex, ey, (long double)a.x - p.x, (long double)a.y - p.y) / length + reach;
    const long double in1 = cross(ex, ey, (long double)b.x - p.x, (long double)b.y - p.y) / length + reach;
    if (in0 < 0 && in1 < 0) return {};
    if (in0 < 0) first = std::max(first, in0 / (in0 - in1));
    if (in1 < 0) last = std::min(last, in0 / (in0 - in1));
  }
  if (!(first <= last)) return {};
  return std::array{first, last};
}

long double SightOracle::planeAt(const Triangle& t, long double x, long double y) {
  long double weight[3], sum = 0, z = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &p = t[(i + 1) % 3], &q = t[(i + 2) % 3];
    weight[i] = (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
    sum += weight[i];
  }
  for (std::size_t i = 0; i < 3; ++i) z += weight[i] / sum * t[i].z;
  return z;
}

std::optional<long double> SightOracle::heightAt(Vec2 plan, long double reach) const {
  std::vector<Triangle> near;
  candidates(plan, plan, near);
  for (const Triangle& t : near)
    if (clip(t, plan, plan, reach)) return planeAt(t, plan.x, plan.y);
  return {};
}

void SightOracle::dropTouches(std::vector<Stretch>& stretches, long double length) {
  std::vector<Stretch> kept;
  for (std::size_t i = 0; i < stretches.size();) {
    // As far as terrain goes on.
    std::size_t j = i;
    long double u = stretches[i].u0, s = stretches[i].s0;
    while (j < stretches.size() && stretches[j].u0 <= u + 1e-12L) {
      u = std::max(u, stretches[j].u1);
      s = std::max(s, stretches[j].s1);
      ++j;
    }
    const bool isTouch = u - stretches[i].u0 < kShortestGap && stretches[i].u0 > 0 && u < length;
    if (!isTouch)
      kept.insert(kept.end(), stretches.begin() + std::ptrdiff_t(i), stretches.begin() + std::ptrdiff_t(j));
    i = j;
  }
  stretches = std::move(kept);
}

OracleAnswer SightOracle::ask(const SightTrack& track, double height0, double height1, double unit,
                              const Options& options) const {
  const auto& points = track.points;
  const long double length = points.back().distance;
  const bool isVertical = length == 0;
  const OracleLine line(isVertical ? 0 : track.curvature, length, (long double)height0 * unit,
                        (long double)height1 * unit);
  const auto lineHeight = [&](long double s) {
    return isVertical ? (long double)std::min(height0, height1) : line.height(s) / unit;
  };

  std::vector<Stretch> stretches;
  OracleAnswer answer;
  std::vector<Triangle> near;
  std::vector<std::array<long double, 2>> covered;
  long double passed = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const SightPoint &a = points[i - 1], &b = points[i];
    const long double dx = (long double)b.plan.x - a.plan.x, dy = (long double)b.plan.y - a.plan.y;
    const long double ds = (long double)b.distance - a.distance, plan = std::sqrt(dx * dx + dy * dy);
    candidates(a.plan, b.plan, near);
    covered.clear();
    for (const Triangle& t : near) {
      const auto part = clip(t, a.plan, b.plan, options.reach);
      if (!part) continue;
      const auto [t0, t1] = *part;
      covered.push_back(*part);
      stretches.push_back(
          {a.distance + t0 * ds, a.distance + t1 * ds, planeAt(t, a.plan.x + t0 * dx, a.plan.y + t0 * dy),
           planeAt(t, a.plan.x + t1 * dx, a.plan.y + t1 * dy), passed + t0 * plan, passed + t1 * plan});
    }
    passed += plan;
    std::sort(covered.begin(), covered.end());
    covered.push_back({1, 1});
    long double end = 0;
    bool isFirst = true;
    for (const auto& [t0, t1] : covered) {
      const bool isPlace = plan == 0;  // a piece without a length: all or nothing
      const bool isGap = isPlace ? covered.size() == 1 && isFirst : (t0 - end) * plan > kShortestGap;
      if (isGap) {
        answer.gapMetres += isPlace ? ds : (t0 - end) * ds;
        answer.longestGapInPlan = std::max(answer.longestGapInPlan, isPlace ? 1 : (t0 - end) * plan);
        if (!answer.firstGap) answer.firstGap = a.distance + end * ds;
      }
      isFirst = false;
      end = std::max(end, t1);
    }
  }

  if (options.endReach > 0)
    for (const SightPoint* end : {&points.front(), &points.back()})
      if (const auto z = heightAt(end->plan, options.endReach)) {
        const long double u = end == &points.front() ? 0 : passed;
        stretches.push_back({end->distance, end->distance, *z, *z, u, u});
      }

  const long double tolerance = (1e-6L + 1e-12L * length) / unit;
  std::sort(stretches.begin(), stretches.end(),
            [](const Stretch& a, const Stretch& b) { return a.s0 < b.s0; });
  if (!options.countsTouches) dropTouches(stretches, passed);
  const auto over = [&](const Stretch& p, long double s) {
    const long double f = p.s1 > p.s0 ? (s - p.s0) / (p.s1 - p.s0) : 0;
    return lineHeight(s) - (p.z0 + f * (p.z1 - p.z0));
  };
  const auto least = [&](const Stretch& p) {
    const long double c0 = over(p, p.s0), c1 = over(p, p.s1);
    std::pair<long double, long double> best = c0 <= c1 ? std::pair{c0, p.s0} : std::pair{c1, p.s1};
    if (line.isStraight() || isVertical || !(p.s1 > p.s0)) return best;
    const long double s = line.whereSlopeIs((p.z1 - p.z0) * unit / (p.s1 - p.s0));
    if (s > p.s0 && s < p.s1)
      if (const long double c = over(p, s); c < best.first) best = {c, s};
    return best;
  };
  // The first place between from (where it is not below) and to (where it is) that is below a level.
  const auto falls = [&](const Stretch& p, long double from, long double to, long double level) {
    for (int i = 0; i < 80; ++i) {
      const long double s = from + (to - from) / 2;
      (over(p, s) < level ? to : from) = s;
    }
    return to;
  };

  // A line over a globe is convex, so it is above its tangents: terrain far below one needs no sines.
  constexpr int kTangents = 32;
  std::vector<OracleLine::HeightAndSlope> tangents;
  if (!isVertical && !line.isStraight() && line.isConvex() && stretches.size() > 2 * kTangents)
    for (int i = 0; i <= kTangents; ++i) tangents.push_back(line.at(length * i / kTangents));
  const auto atLeast = [&](const Stretch& p) {
    if (tangents.empty()) return -std::numeric_limits<long double>::infinity();
    const auto i = static_cast<int>(p.s0 / length * kTangents + 0.5L);
    const auto& tangent = tangents[static_cast<std::size_t>(std::clamp(i, 0, kTangents))];
    const auto above = [&](long double s, long double z) {
      return (tangent.height + tangent.slope * (s - length * i / kTangents)) / unit - z;
    };
    return std::min(above(p.s0, p.z0), above(p.s1, p.z1)) - 1e-7L / unit;
  };
  if (!tangents.empty()) {
    const auto lowest =
        std::min_element(stretches.begin(), stretches.end(),
                         [&](const auto& a, const auto& b) { return atLeast(a) < atLeast(b); });
    std::tie(answer.clearance, answer.at) = least(*lowest);
  }

  std::optional<long double> shallow;
  for (const Stretch& p : stretches) {
    if (const long double bound = atLeast(p); bound > 0 && answer.clearance && bound > *answer.clearance)
      continue;
    const auto [c, s] = least(p);
    if (!answer.clearance || c < *answer.clearance) {
      answer.clearance = c;
      answer.at = s;
    }
    for (auto* found : {&shallow, &answer.deep}) {
      const long double level = -tolerance * (found == &shallow ? 0.5L : 1.5L);
      if (!(c < level)) continue;
      const long double first = over(p, p.s0) < level ? p.s0 : falls(p, p.s0, s, level);
      if (!*found || first < **found) *found = first;
    }
  }
  if (!shallow) return answer;
  long double ceased = 0;
  for (const Stretch& p : stretches) {
    if (p.s0 > *shallow) continue;
    const long double end = std::min(p.s1, *shallow), level = kNoise / unit;
    if (atLeast(p) > level || over(p, end) > level) {
      ceased = std::max(ceased, end);
    } else if (over(p, p.s0) > level) {
      ceased = std::max(ceased, falls(p, p.s0, end, level));
    }
  }
  // Where terrain begins after a gap, it begins.
  std::vector<std::array<long double, 2>> all;
  for (const Stretch& p : stretches)
    if (p.s0 <= *shallow) all.push_back({p.s0, p.s1});
  long double end = 0;
  const long double step = kShortestGap * length;
  for (const auto& [s0, s1] : all) {
    if (s0 > end + step) ceased = std::max(ceased, s0);
    end = std::max(end, s1);
  }
  answer.ceased = ceased;
  return answer;
}

}  // namespace arete::test
