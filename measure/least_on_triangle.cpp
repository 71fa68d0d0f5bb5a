// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane of the triangle cuts a disk out of the ball around x; what may be taken is the triangle within
// the disk, a convex set. Over it the distance of linear numbers has convex sublevel sets, and so has its
// least along each line of one direction. Corners, sides within the ball and the nearest point are looked at
// by themselves: they have exact places, and a triangle without area has nothing else. The inside is searched
// by golden sections of golden sections [Kiefer1953].
#include "measure/least_on_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/base/triangle_bvh.h"

namespace arete {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kGolden = 0.6180339887498949;

bool areSameNumbers(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b,
                            [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool areFinite(std::span<const double> a) {
  return std::ranges::all_of(a, [](double x) { return std::isfinite(x); });
}

double angleOf(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

Vec3 directionOf(std::span<const double> a) {
  return {a[0], a[1], a[2]};
}

/// Rises with numbersApart() of finite numbers, and takes less time. 0 where that is 0.
double keyOf(NumbersNorm norm, std::span<const double> wanted, const std::vector<double>& a) {
  if (norm == NumbersNorm::angle) {
    if (a.size() > 3 && (a[3] < 0) != (wanted[3] < 0)) return kFar;
    const Vec3 from = directionOf(wanted), to = directionOf(a);
    const Vec3 across = cross(from, to);
    const double squared = dot(across, across), along = dot(from, to);
    if (along > 0) return squared / (along * along);
    // Beyond a right angle: the larger, the nearer to the opposite.
    const double lengths = dot(from, from) * dot(to, to);
    return lengths > 0 ? 1e30 * (2 - squared / lengths) : kFar;
  }
  double most = 0, squares = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const double apart = std::abs(a[c] - wanted[c]);
    most = std::max(most, apart);
    squares += apart * apart;
  }
  return norm == NumbersNorm::largest ? most : squares;
}

/// The least of a function over [low, high] whose sublevel sets are intervals, and its place.
template <class Function>
std::pair<double, double> leastBetween(double low, double high, int steps, const Function& f) {
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double fa = f(a), fb = f(b);
  std::pair<double, double> best = fa <= fb ? std::pair(a, fa) : std::pair(b, fb);
  for (int i = 0; i < steps && low < high && best.second > 0; ++i) {
    if (fa <= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - kGolden * (high - low);
      fa = f(a);
      if (fa < best.second) best = {a, fa};
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + kGolden * (high - low);
      fb = f(b);
      if (fb < best.second) best = {b, fb};
    }
  }
  return best;
}

/// The part of a segment within a distance of x, from 0 at a to 1 at b.
std::optional<std::pair<double, double>> withinBall(const Vec3& a, const Vec3& b, const Vec3& x,
                                                    double within) {
  const Vec3 side = b - a, to = x - a;
  const double length = dot(side, side);
  if (!(length > 0)) return std::nullopt;  // a corner
  const double foot = dot(side, to) / length;
  const Vec3 off = to - foot * side;
  const double left = within * within - dot(off, off);
  if (left < 0) return std::nullopt;
  const double half = std::sqrt(left / length);
  const double low = std::max(0.0, foot - half), high = std::min(1.0, foot + half);
  if (low > high) return std::nullopt;
  return std::pair(low, high);
}

/// A triangle in its plane, about the foot of x, and its numbers there.
struct InPlane {
  Vec3 foot, along, across;
  std::array<Vec2, 3> corners;
  double radius = 0;  // of the disk
  Vec2 plan(const Vec3& p) const { return {dot(p - foot, along), dot(p - foot, across)}; }
  Vec3 place(double u, double v) const { return foot + u * along + v * across; }
};

std::optional<InPlane> inPlane(const SpaceTriangle& t, const Vec3& x, double within) {
  const Vec3 normal = areaNormal(t);
  if (normal == Vec3{}) return std::nullopt;
  const Vec3 up = unit(normal);
  InPlane plane;
  const double height = dot(up, x - t[0]);
  plane.foot = x - height * up;
  plane.along = unit(t[1] - t[0]);
  plane.across = cross(up, plane.along);
  for (int i = 0; i < 3; ++i) plane.corners[i] = plane.plan(t[i]);
  plane.radius = std::sqrt(std::max(0.0, within * within - height * height));
  return plane;
}

/// The line of one u across the triangle and the disk; low above high: it misses them.
std::pair<double, double> chordAt(const InPlane& plane, double u) {
  double low = kFar, high = -kFar;
  for (int i = 0; i < 3; ++i) {
    const Vec2 &a = plane.corners[i], &b = plane.corners[(i + 1) % 3];
    if (std::min(a.x, b.x) > u || std::max(a.x, b.x) < u) continue;
    if (a.x == b.x) {
      low = std::min({low, a.y, b.y});
      high = std::max({high, a.y, b.y});
      continue;
    }
    const double v = a.y + (u - a.x) / (b.x - a.x) * (b.y - a.y);
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const double half = std::sqrt(std::max(0.0, plane.radius * plane.radius - u * u));
  return {std::max(low, -half), std::min(high, half)};
}

bool holds(const InPlane& plane, const Vec2& p) {
  for (int i = 0; i < 3; ++i)
    if (cross(plane.corners[(i + 1) % 3] - plane.corners[i], p - plane.corners[i]) < 0) return false;
  return true;
}

}  // namespace

double numbersApart(NumbersNorm norm, std::span<const double> a, std::span<const double> b) {
  if (areSameNumbers(a, b)) return 0;
  if (norm == NumbersNorm::equality || !areFinite(a) || !areFinite(b)) return kFar;
  if (norm == NumbersNorm::angle) {
    if (a.size() > 3 && (a[3] < 0) != (b[3] < 0)) return kFar;
    const Vec3 from = directionOf(a), to = directionOf(b);
    if (from == Vec3{} || to == Vec3{}) return from == to ? 0 : kFar;
    return angleOf(from, to);
  }
  double most = 0, squares = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    most = std::max(most, std::abs(a[c] - b[c]));
    squares += (a[c] - b[c]) * (a[c] - b[c]);
  }
  return norm == NumbersNorm::largest ? most : std::sqrt(squares);
}

std::span<const double> LeastOnTriangle::at(const SpaceTriangle& t, std::span<const double> corners,
                                            const Vec3& p) {
  const auto shares = nearestWithShares(p, t).shares;
  for (std::size_t c = 0; c < components_; ++c) {
    scratch_[c] = 0;
    // A share of 0 of a number that is not finite is nothing.
    for (std::size_t i = 0; i < 3; ++i)
      if (shares[i] != 0) scratch_[c] += shares[i] * corners[i * components_ + c];
  }
  return scratch_;
}

double LeastOnTriangle::atLeast(const SpaceTriangle& t, std::span<const double> corners,
                                std::span<const double> wanted, const Vec3& x, double within) const {
  if (norm_ == NumbersNorm::equality || !areFinite(corners) || !areFinite(wanted)) return 0;
  if (norm_ == NumbersNorm::angle) {
    // A cap around the three directions holds all between them.
    std::array<Vec3, 3> at;
    Vec3 middle;
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = directionOf(corners.subspan(i * components_));
      if (at[i] == Vec3{}) return 0;
      middle = middle + unit(at[i]);
    }
    const Vec3 w = directionOf(wanted);
    if (norm(middle) < 1e-6 || w == Vec3{}) return 0;
    double cap = 0;
    for (const Vec3& a : at) cap = std::max(cap, angleOf(middle, a));
    return cap < 89 ? std::max(0.0, angleOf(middle, w) - cap - 1e-9) : 0;
  }
  const auto plane = inPlane(t, x, within);
  double most = 0, squares = 0;
  for (std::size_t c = 0; c < components_; ++c) {
    const double n0 = corners[c], n1 = corners[components_ + c], n2 = corners[2 * components_ + c];
    double low = std::min({n0, n1, n2}), high = std::max({n0, n1, n2});
    if (plane) {
      // Over the disk: the number at its middle and its slope there.
      const Vec2 e1 = plane->corners[1] - plane->corners[0], e2 = plane->corners[2] - plane->corners[0];
      const double area = cross(e1, e2);
      const double du = ((n1 - n0) * e2.y - (n2 - n0) * e1.y) / area,
                   dv = ((n2 - n0) * e1.x - (n1 - n0) * e2.x) / area;
      const double middle = n0 - du * plane->corners[0].x - dv * plane->corners[0].y;
      const double spread = std::hypot(du, dv) * plane->radius * (1 + 1e-9);
      if (std::isfinite(middle) && std::isfinite(spread)) {
        low = std::max(low, middle - spread - 1e-12 * std::abs(middle));
        high = std::min(high, middle + spread + 1e-12 * std::abs(middle));
      }
    }
    const double gap = std::max({low - wanted[c], wanted[c] - high, 0.0});
    most = std::max(most, gap);
    squares += gap * gap;
  }
  return (norm_ == NumbersNorm::largest ? most : std::sqrt(squares)) * (1 - 1e-12);
}

LeastOnTriangle::Found LeastOnTriangle::find(const SpaceTriangle& t, std::span<const double> corners,
                                             std::span<const double> wanted, const Vec3& x, double within,
                                             const Vec3& nearest, int steps) {
  Found best{kFar, nearest};
  const auto take = [&](double apart, const Vec3& place) {
    if (apart < best.apart) best = {apart, place};
  };
  const auto numbersOf = [&](std::size_t i) { return corners.subspan(i * components_, components_); };
  if (norm_ == NumbersNorm::equality || !areFinite(corners) || !areFinite(wanted)) {
    // A corner stands for what is nearer to it than to the others: a quadrilateral of two triangles.
    const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double apart = numbersApart(norm_, wanted, numbersOf(i));
      if (!(apart < best.apart)) continue;
      for (const std::size_t next : {(i + 1) % 3, (i + 2) % 3}) {
        const Vec3 place = nearestOnTriangle(x, {t[i], 0.5 * (t[i] + t[next]), middle});
        if (squaredDistance(x, place) <= within * within * (1 + 1e-12)) take(apart, place);
      }
    }
    return best;
  }
  take(numbersApart(norm_, wanted, at(t, corners, nearest)), nearest);
  for (std::size_t i = 0; i < 3 && best.apart > 0; ++i)
    if (squaredDistance(x, t[i]) <= within * within) take(numbersApart(norm_, wanted, numbersOf(i)), t[i]);
  if (best.apart == 0) return best;
  if (std::ranges::equal(numbersOf(0), numbersOf(1)) && std::ranges::equal(numbersOf(0), numbersOf(2)))
    return best;

  const auto plane = inPlane(t, x, within);
  double least = kFar;  // the key of what is found along sides and inside
  Vec3 leastPlace = nearest;
  std::vector<double> leastNumbers(components_);
  const auto takeKey = [&](double key, const Vec3& place) {
    if (!(key < least)) return;
    least = key;
    leastPlace = place;
    leastNumbers = scratch_;
  };
  const auto finish = [&] {
    if (least < kFar) take(numbersApart(norm_, wanted, leastNumbers), leastPlace);
    return best;
  };
  double low = kFar, high = -kFar;  // of u, of what may be taken
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const auto part = withinBall(t[i], t[next], x, within);
    if (!part) continue;
    const auto keyAt = [&](double s) {
      for (std::size_t c = 0; c < components_; ++c)
        scratch_[c] = (1 - s) * corners[i * components_ + c] + s * corners[next * components_ + c];
      const double key = keyOf(norm_, wanted, scratch_);
      takeKey(key, t[i] + s * (t[next] - t[i]));
      return key;
    };
    leastBetween(part->first, part->second, steps, keyAt);
    for (const double end : {part->first, part->second}) {
      keyAt(end);
      if (!plane) continue;
      const double u = plane->plan(t[i] + end * (t[next] - t[i])).x;
      low = std::min(low, u);
      high = std::max(high, u);
    }
  }
  if (!plane || least == 0) return finish();
  for (const double u : {-plane->radius, plane->radius})
    if (holds(*plane, {u, 0})) {
      low = std::min(low, u);
      high = std::max(high, u);
    }
  if (!(low < high)) return finish();
  const Vec2 e1 = plane->corners[1] - plane->corners[0], e2 = plane->corners[2] - plane->corners[0];
  const double area = cross(e1, e2);
  const auto leastAt = [&](double u) {
    auto [from, to] = chordAt(*plane, u);
    if (from > to) from = to = (from + to) / 2;
    if (!std::isfinite(from)) return kFar;
    return leastBetween(from, to, steps,
                        [&](double v) {
                          const Vec2 off{u - plane->corners[0].x, v - plane->corners[0].y};
                          const double s1 = cross(off, e2) / area, s2 = cross(e1, off) / area;
                          for (std::size_t c = 0; c < components_; ++c)
                            scratch_[c] = corners[c] + s1 * (corners[components_ + c] - corners[c]) +
                                          s2 * (corners[2 * components_ + c] - corners[c]);
                          const double key = keyOf(norm_, wanted, scratch_);
                          takeKey(key, plane->place(u, v));
                          return key;
                        })
        .second;
  };
  leastBetween(low, high, steps, leastAt);
  return finish();
}

}  // namespace arete
