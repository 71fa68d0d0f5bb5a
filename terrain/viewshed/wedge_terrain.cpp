// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges between two lattice lines of x, and those of the farther one, added to the skyline. A cell that
// stands lower than the skyline's lowest place around is done with by one comparison: that is most of them.
// Where there are voids the cells between them are whole, and are taken row by row.
#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/viewshed/wedge.h"

namespace arete {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Terrain this near to the observer (in steps) is left out where an edge comes so near.
constexpr double kNearest = 1e-6;
/// Edges narrower than this (in steps) point at the observer, over a fan: their ends are those of others.
constexpr double kNarrow = 1e-7;

}  // namespace

/// The edges of cells that may not all be whole, row by row of those that are.
void ViewshedWedgeSweep::addCells(int x, int from, int to) {
  const double *z0 = near_.z.data() + near_.at(from), *z1 = far_.z.data() + far_.at(from);
  const auto isWhole = [&](int i) { return !std::isnan((z0[i] + z0[i + 1]) + (z1[i] + z1[i + 1])); };
  const int count = to - from;
  for (int i = 0; i <= count;) {
    int end = i;
    while (end < count && isWhole(end)) ++end;
    if (end > i) addWholeCells(x, from + i, end - i);
    // Its edge at `end` is twice the same where the cell before is whole: no matter.
    addPartialCell(x, from + end);
    i = end + 1;
  }
}

void ViewshedWedgeSweep::addWholeCells(int x, int from, int count) {
  if (picture_.isFan()) {
    addWholeCells<true>(x, from, count);
  } else {
    addWholeCells<false>(x, from, count);
  }
}

template <bool kIsFan>
void ViewshedWedgeSweep::addWholeCells(int x, int from, int count) {
  const std::size_t n = near_.at(from), f = far_.at(from);
  const double *u0 = near_.u.data() + n, *v0 = near_.v.data() + n, *u1 = far_.u.data() + f,
               *v1 = far_.v.data() + f;
  const int *bin0 = near_.bin.data() + n, *bin1 = far_.bin.data() + f;
  const double slack0 = picture_.slack(near_.x * 0.99, 0), slack1 = picture_.slack(far_.x * 0.99, 0);
  for (int i = 0; i < count; ++i) {
    const double highest = std::max(v0[i], std::max(v1[i], v1[i + 1]));
    if (highest <= horizon_.low(std::min(bin0[i], bin1[i]), std::max(bin0[i], bin1[i + 1]))) continue;
    if constexpr (kIsFan) {
      const End start{near_, n + static_cast<std::size_t>(i)}, across{far_, f + static_cast<std::size_t>(i)},
          end{far_, across.at + 1};
      addFanEdge(across, end, trianglesAcross(x, from + i));
      addFanEdge(start, across, trianglesAlong(x, from + i));
      addFanEdge(start, end, 2);
    } else {
      horizon_.add(u1[i], v1[i], u1[i + 1], v1[i + 1], slack1);
      horizon_.add(u0[i], v0[i], u1[i], v1[i], slack0);
      horizon_.add(u0[i], v0[i], u1[i + 1], v1[i + 1], slack0);
    }
  }
  if (count < 0) return;
  if constexpr (kIsFan) {
    addFanEdge({near_, n + static_cast<std::size_t>(count)}, {far_, f + static_cast<std::size_t>(count)},
               trianglesAlong(x, from + count));
  } else {
    horizon_.add(u0[count], v0[count], u1[count], v1[count], slack0);
  }
}

/// How many triangles the edges from (x - 1, y) to (x, y) and from (x, y) to (x, y + 1) have, if both their
/// samples are there.
int ViewshedWedgeSweep::trianglesAlong(int x, int y) const {
  const auto isThere = [&](int atX, int atY) { return !std::isnan(height(atX, atY)); };
  return int{isThere(x, y - 1) || isThere(x - 1, y - 1)} + int{isThere(x, y + 1) || isThere(x - 1, y + 1)};
}
int ViewshedWedgeSweep::trianglesAcross(int x, int y) const {
  const auto isThere = [&](int atX, int atY) { return !std::isnan(height(atX, atY)); };
  return int{isThere(x - 1, y) || isThere(x - 1, y + 1)} + int{isThere(x + 1, y) || isThere(x + 1, y + 1)};
}

/// An edge of so many triangles.
void ViewshedWedgeSweep::addFanEdge(End a, End b, int triangles) {
  const double u0 = a.line.u[a.at], u1 = b.line.u[b.at];
  if (triangles == 0 || !(std::fabs(u1 - u0) * near_.x > kNarrow)) return;
  const double v0 = a.line.v[a.at], v1 = b.line.v[b.at];
  if (!a.line.isBesideGap[a.at] && !b.line.isBesideGap[b.at])
    return horizon_.add(u0, v0, u1, v1, slack(a.line, a.at, b.line, b.at));
  doubtful_.add(u0, v0, u1, v1, 0);
  addBesideGap(a, b, triangles == 1);
}

/// The part of an edge beside a gap that is before lines in its directions for sure, though they run a little
/// to its side: that is no nearer than this to where there may be no terrain. A line that crosses the rim
/// does so elsewhere, and surely has terrain below it only some way into its triangle, where it may be lower.
void ViewshedWedgeSweep::addBesideGap(End a, End b, bool isRim) {
  constexpr double kSmallestAngle = 0.25;  // its sine, between the line and the rim
  const Vec2 p = a.place(), q = b.place();
  const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy);
  const double error = 3 * picture_.planError(
                               std::hypot(std::max(p.x, q.x), std::max(std::fabs(p.y), std::fabs(q.y)))),
               inward = isRim ? error / kSmallestAngle : 0;
  const double cut = 2 * (error + inward) / length;
  const double first = a.line.isBesideGap[a.at] ? cut : 0, last = b.line.isBesideGap[b.at] ? 1 - cut : 1;
  if (!(first < last)) return;
  const double h0 = a.line.v[a.at] * p.x, h1 = b.line.v[b.at] * q.x;
  double u[2], v[2], nearest = p.x, steepest = 0, sines[2];
  for (const int end : {0, 1}) {
    const double t = end == 0 ? first : last, x = p.x + t * dx, y = p.y + t * dy;
    u[end] = t == 0 ? a.line.u[a.at] : t == 1 ? b.line.u[b.at] : y / x;
    v[end] = t == 0 ? a.line.v[a.at] : t == 1 ? b.line.v[b.at] : (h0 + t * (h1 - h0)) / x;
    nearest = std::min(nearest, x);
    steepest = std::max(steepest, std::fabs(v[end]));
    sines[end] = (x * dy - y * dx) / (length * std::sqrt(x * x + y * y));
  }
  double doubt = std::max(a.line.doubt[a.at], b.line.doubt[b.at]);
  if (isRim) {
    if (!(std::min(std::fabs(sines[0]), std::fabs(sines[1])) > kSmallestAngle) || sines[0] * sines[1] < 0)
      return;
    doubt = 8 * doubt + 2 * inward * steepest;
  }
  if (std::fabs(u[1] - u[0]) * near_.x > kNarrow)
    horizon_.add(u[0], v[0], u[1], v[1], picture_.slack(nearest * 0.99, doubt));
}

/// Samples on the skyline that a line may meet without being over terrain before or behind them: whether they
/// count is for the engine to say. (Over a fan no sample beside a gap is sure to hide.)
void ViewshedWedgeSweep::addTips(int x) {
  for (int y = far_.from; y < far_.from + far_.count; ++y) {
    const std::size_t i = far_.at(y);
    const double u = far_.u[i];
    if (!(far_.v[i] > horizon_.low(far_.bin[i])) || !isTip(x, y, u + shear_)) continue;
    if (!(far_.v[i] > horizon_.at(u).lower)) continue;
    const double corner = picture_.corner(far_.x);
    if (tips_.isEmpty()) binsWithTips_.assign(static_cast<std::size_t>(horizon_.binCount()), 0);
    tips_.add(u - corner, u + corner);
    for (int bin = horizon_.bin(u - corner); bin <= horizon_.bin(u + corner); ++bin)
      binsWithTips_[static_cast<std::size_t>(bin)] = 1;
  }
}

/// Of a line in the direction u over the sample.
bool ViewshedWedgeSweep::isTip(int x, int y, double u) const {
  const auto isThere = [&](int atX, int atY) { return !std::isnan(height(atX, atY)); };
  const auto hasTerrain = [&](int ahead, int side) {
    return isThere(x + ahead, y) && (isThere(x + ahead, y + side) || isThere(x, y + side));
  };
  const auto isBetween = [&](int side) { return !hasTerrain(1, side) && !hasTerrain(-1, -side); };
  constexpr double kAlong = 1e-6;
  // Beside a lattice line or a diagonal, on either side of it.
  if (std::fabs(u) < kAlong) return isBetween(1) || isBetween(-1);
  if (std::fabs(u) > 1 - kAlong)
    return !isThere(x + 1, y) || !isThere(x - 1, y) || !isThere(x, y - 1) || !isThere(x, y + 1);
  return isBetween(u > 0 ? 1 : -1);
}

void ViewshedWedgeSweep::addEdges(int x) {
  const int from = std::max(near_.from, far_.from),
            to = std::min(near_.from + near_.count, far_.from + far_.count) - 1;
  if (to < from) return;
  if (near_.hasGaps || far_.hasGaps) {
    addCells(x, from, to);
  } else {
    addWholeCells(x, from, to - from);
  }
  // Geodesics may leave the DEM between two places in it.
  if (picture_.isFan() && from == yLeast_) addBorder(x, yLeast_, yLeast_ - 1);
  if (picture_.isFan() && to == yGreatest_) addBorder(x, yGreatest_, yGreatest_ + 1);
}

/// The cell from the DEM's border to beyond it.
void ViewshedWedgeSweep::addBorder(int x, int y, int outside) {
  const double beyond0 = picture_.direction(wedge_.sector, x - 1, outside, shear_),
               beyond1 = picture_.direction(wedge_.sector, x, outside, shear_);
  const double u0 = near_.u[near_.at(y)], u1 = far_.u[far_.at(y)];
  gaps_.add(std::min(std::min(u0, u1), std::min(beyond0, beyond1)),
            std::max(std::max(u0, u1), std::max(beyond0, beyond1)), picture_.corner(near_.x));
}

/// The edges of the cell from (x - 1, y) to (x, y + 1) that it adds: its own diagonal, that along x at y,
/// that along y at x; if they are there. An edge is when both its samples are and any sample opposite to it
/// is.
void ViewshedWedgeSweep::addPartialCell(int x, int y) {
  const auto n = near_.at(y), f = far_.at(y);
  const auto add = [&](const PictureLine& a, std::size_t i, const PictureLine& b, std::size_t j,
                       int triangles) {
    if (picture_.isFan()) {
      addFanEdge({a, i}, {b, j}, triangles);
    } else if (triangles > 0) {
      horizon_.add(a.u[i], a.v[i], b.u[j], b.v[j], slack(a, i, b, j));
    }
  };
  const bool has00 = !std::isnan(near_.z[n]), has10 = !std::isnan(far_.z[f]);
  if (has00 && has10) add(near_, n, far_, f, trianglesAlong(x, y));
  if (!near_.has(y + 1) || !far_.has(y + 1)) return;
  const bool has01 = !std::isnan(near_.z[n + 1]), has11 = !std::isnan(far_.z[f + 1]);
  if (has10 && has11) add(far_, f, far_, f + 1, trianglesAcross(x, y));
  const int corners = has00 + has01 + has10 + has11;
  if (corners >= 3) {
    if (has00 && has11) {
      add(near_, n, far_, f + 1, corners - 2);
    } else {
      add(near_, n + 1, far_, f, 1);
    }
  }
  if (corners == 4 || !wantsGaps_) return;
  double first = kInfinite, last = -kInfinite;
  const auto reach = [&](double u) {
    first = std::min(first, u);
    last = std::max(last, u);
  };
  // Of three corners, the gap is the triangle of the fourth and its neighbours.
  if (corners < 3 || !has00 || !has11 || !has01) reach(near_.u[n + 1]);
  if (corners < 3 || !has00 || !has11 || !has10) reach(far_.u[f]);
  if (corners < 3 || !has01 || !has10 || !has00) reach(near_.u[n]);
  if (corners < 3 || !has01 || !has10 || !has11) reach(far_.u[f + 1]);
  gaps_.add(first, last, picture_.corner(near_.x));
}

/// The edges and the gaps between the lattice line behind the observer, or below it, and the first before it.
void ViewshedWedgeSweep::addFirst(int x) {
  const int low = std::max(yLeast_, static_cast<int>(std::floor(observer_.y)) - 3),
            high = std::min(yGreatest_, low + 8);
  const auto isThere = [&](int atX, int atY) { return !std::isnan(height(atX, atY)); };
  nearGaps_.setError(picture_.directionError());
  for (int y = low; y <= high; ++y) {
    const ImagePlane::Sample before = picture_.sample(wedge_.sector, x - 1, y),
                             at = picture_.sample(wedge_.sector, x, y);
    if (isThere(x - 1, y - 1) || isThere(x, y - 1) || isThere(x - 1, y + 1) || isThere(x, y + 1))
      addNear(before, at);
    if (y == high) break;
    const ImagePlane::Sample beforeNext = picture_.sample(wedge_.sector, x - 1, y + 1),
                             next = picture_.sample(wedge_.sector, x, y + 1);
    if (isThere(x - 1, y + 1) || isThere(x, y)) addNear(before, next);
    if (isThere(x - 1, y) != isThere(x, y + 1)) addNear(beforeNext, at);
    if (isThere(x - 1, y) || isThere(x - 1, y + 1) || isThere(x + 1, y) || isThere(x + 1, y + 1))
      addNear(at, next);
    if (wantsGaps_) addNearGap(x, y);
  }
}

/// What is not terrain of the cell from (x - 1, y) to (x, y + 1).
void ViewshedWedgeSweep::addNearGap(int x, int y) {
  const double x0 = x - 1 - observer_.x, x1 = x - observer_.x, y0 = y - observer_.y, y1 = y + 1 - observer_.y;
  const std::array<Vec2, 4> corners{Vec2{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  const bool isMissing[] = {std::isnan(height(x - 1, y)), std::isnan(height(x, y)),
                            std::isnan(height(x, y + 1)), std::isnan(height(x - 1, y + 1))};
  const auto missing = std::count(std::begin(isMissing), std::end(isMissing), true);
  if (missing > 1) return nearGaps_.add(corners);
  if (missing == 0) return;
  // The triangle of the corner that is missing and those beside it.
  const auto i =
      static_cast<std::size_t>(std::find(std::begin(isMissing), std::end(isMissing), true) - isMissing);
  nearGaps_.add(std::array<Vec2, 3>{corners[(i + 3) % 4], corners[i], corners[(i + 1) % 4]});
}

/// An edge that may lead behind the observer: the part of it that is in the wedge and not too near.
void ViewshedWedgeSweep::addNear(const ImagePlane::Sample& from, const ImagePlane::Sample& to) {
  if (std::isnan(from.height + to.height)) return;
  const Vec2 a = from.place, b = to.place;
  double t0 = 0, t1 = 1;
  const auto keep = [&](double atA, double atB) {  // where it is positive
    if (atA >= 0 && atB >= 0) return;
    if (atA < 0 && atB < 0) {
      t0 = 2;
    } else if (atA < 0) {
      t0 = std::max(t0, atA / (atA - atB));
    } else {
      t1 = std::min(t1, atA / (atA - atB));
    }
  };
  // Wider than the wedge: what is cut off here must not matter.
  constexpr double kWider = 1.0 / 64;
  keep(a.x - kNearest, b.x - kNearest);
  keep(a.y - (wedge_.first - kWider) * a.x, b.y - (wedge_.first - kWider) * b.x);
  keep((wedge_.last + kWider) * a.x - a.y, (wedge_.last + kWider) * b.x - b.y);
  if (!(t0 < t1)) return;
  const auto at = [&](double t, double& u, double& v) {
    const double x = t == 1 ? b.x : a.x + t * (b.x - a.x), y = t == 1 ? b.y : a.y + t * (b.y - a.y);
    u = (y - shear_ * x) / x;
    v = (t == 1 ? to.height : from.height + t * (to.height - from.height)) / x;
    return x;
  };
  double u0, v0, u1, v1;
  const double x0 = at(t0, u0, v0), x1 = at(t1, u1, v1), nearest = std::min(x0, x1);
  if (std::fabs(u1 - u0) < (picture_.isFan() ? kNarrow : 1e-12)) return;  // it points at the observer
  if (from.isBesideGap || to.isBesideGap) return doubtful_.add(u0, v0, u1, v1, 0);
  horizon_.add(u0, v0, u1, v1, picture_.slack(nearest, std::max(from.doubt, to.doubt)));
}

}  // namespace arete
