// SPDX-License-Identifier: GPL-3.0-or-later
//
// The terrain between two lattice lines is the edges between them and those of the farther one: seen from the
// observer, what hides is always an edge. A cell that is lower than the lowest skyline of its bins takes one
// comparison; most do. Where there is NODATA, rows of whole cells are treated that way, and the other cells
// edge by edge. Between the observer and the first lattice line, edges may lead behind the observer and are
// clipped, and gaps are kept as polygons (ViewshedNearGaps).
#include "terrain/viewshed/wedge_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arete {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// Wedges overlap by this much, in u: samples at their ends are compared with edges on both sides.
constexpr double kPad = 1e-6;
/// Terrain nearer to the observer than this, in steps, is left out (whyNotSweep() tells where it may matter).
constexpr double kNearest = 1e-6;
/// Mapped edges narrower than this, in steps, point at the observer: other edges that meet their ends are
/// drawn.
constexpr double kNarrow = 1e-7;
/// The same of edges clipped near the observer, in u, where nothing is mapped.
constexpr double kNoWidth = 1e-12;
/// Distance in x of an edge >= kMapX * (that of its nearer lattice line): a map's x differs from the plan's.
constexpr double kMapX = 0.99;
/// Samples drawn beside the wedge on either side, so that edges across its ends are there.
constexpr int kMargin = 3;

std::uint32_t binsOf(const ViewshedWedge& wedge, double farthest) {
  constexpr double kBinsPerSample = 0.5;
  return static_cast<std::uint32_t>(
             std::ceil((wedge.last - wedge.first) * std::max(0.0, farthest) * kBinsPerSample)) +
         1;
}

}  // namespace

WedgeTerrain::WedgeTerrain(const ImagePlane& image, const ViewshedWedge& wedge)
    : image_(image),
      wedge_(wedge),
      grid_(image.task().grid, wedge.sector),
      observer_(image.observer(wedge.sector)),
      shear_(wedge.first >= 0.5 && !image.isMapped() ? 1 : 0),
      turn_(image.turn()),
      wantsGaps_(image.isMapped() || image.task().options.nodata != NodataSight::clear),
      skyline_(wedge.first - shear_ - kPad, wedge.last - shear_ + kPad,
               binsOf(wedge, grid_.xGreatest() - observer_.x)),
      uncertain_(wedge.first - shear_ - kPad, wedge.last - shear_ + kPad,
                 image.isMapped() ? static_cast<std::uint32_t>(skyline_.binCount()) : 1) {}

void WedgeTerrain::draw(int x) {
  std::swap(near_, far_);
  constexpr double kIntRange = 2e9;
  const double away = x - observer_.x;
  const double first = observer_.y + (wedge_.first - turn_) * away,
               last = observer_.y + (wedge_.last + turn_) * away;
  const int low =
      std::max(grid_.yLeast(), static_cast<int>(std::floor(std::max(first, -kIntRange))) - kMargin);
  const int high =
      std::min(grid_.yGreatest(), static_cast<int>(std::ceil(std::min(last, kIntRange))) + kMargin);
  image_.draw(wedge_.sector, x, low, high, shear_, far_);
  const auto count = static_cast<std::size_t>(far_.count);
  for (std::size_t i = 0; i < count; ++i) far_.bin[i] = skyline_.bin(far_.u[i]);
}

void WedgeTerrain::add(int x, bool isFirst) {
  if (!image_.isMapped() && (isFirst || near_.hasGaps || far_.hasGaps)) addTips(x);
  if (isFirst) {
    addFirst(x);
  } else {
    addEdges(x);
  }
}

bool WedgeTerrain::isBesideGap(int x, int y) const {
  const bool isAtBorder = image_.isMapped() && (y == grid_.yLeast() || y == grid_.yGreatest());
  if (!far_.hasGaps && !near_.hasGaps && !isAtBorder) return false;
  // Steps across: mapped, the line may come from the other side of y = 0.
  constexpr double kMapped = 1e-2;
  const double yy = y - observer_.y, turned = turn_ * far_.x + (image_.isMapped() ? kMapped : 0);
  return (yy >= -turned &&
          std::isnan(grid_.height(x, y - 1) + grid_.height(x - 1, y - 1) + grid_.height(x - 1, y))) ||
         (yy <= turned &&
          std::isnan(grid_.height(x, y + 1) + grid_.height(x - 1, y + 1) + grid_.height(x - 1, y)));
}

void WedgeTerrain::raiseByPending(int y, double above, ViewshedHorizon::Bounds& skyline) const {
  const double u = far_.u[far_.at(y)];
  const auto raiseBy = [&](int yNear, int yFar) {
    if (!near_.has(yNear) || !far_.has(yFar)) return;
    const std::size_t n = near_.at(yNear), f = far_.at(yFar);
    const double v0 = near_.v[n], v1 = far_.v[f];
    if (!(std::max(v0, v1) > above)) return;
    const double u0 = near_.u[n], u1 = far_.u[f];
    if (!(std::min(u0, u1) <= u && u <= std::max(u0, u1)) || u0 == u1) return;
    const double v = v0 + (v1 - v0) * ((u - u0) / (u1 - u0));
    skyline.upper = std::max(skyline.upper, v);
    if (!image_.isMapped() || !(near_.isBesideGap[n] || far_.isBesideGap[f]))
      skyline.lower = std::max(skyline.lower, v - slack(near_, n, far_, f));
  };
  if (y < observer_.y || image_.isMapped()) raiseBy(y, y + 1);
  if (!image_.isMapped()) return;
  raiseBy(y - 1, y - 1);
  skyline.upper = std::max(skyline.upper, uncertain_.at(u).upper);
}

ViewshedNearGaps::Crossing WedgeTerrain::gapsTowards(double u) const {
  ViewshedNearGaps::Crossing gap{gaps_.isPossible(u), gaps_.isCertain(u)};
  if (nearGaps_.isEmpty() || gap.isCertain) return gap;
  const ViewshedNearGaps::Crossing near = nearGaps_.towards(u + shear_);
  return {gap.isPossible || near.isPossible, near.isCertain};
}

double WedgeTerrain::slack(const ImageLine& a, std::size_t i, const ImageLine& b, std::size_t j) const {
  return image_.slack(std::min(a.x, b.x) * kMapX,
                      image_.isMapped() ? std::max(a.uncertainty[i], b.uncertainty[j]) : 0);
}

/// Edges and gaps between the last lattice line that is not in front of the observer and the first that is.
void WedgeTerrain::addFirst(int x) {
  const int low = std::max(grid_.yLeast(), static_cast<int>(std::floor(observer_.y)) - 3),
            high = std::min(grid_.yGreatest(), low + 8);
  const auto isThere = [&](int atX, int atY) { return grid_.isThere(atX, atY); };
  nearGaps_.setError(image_.directionError());
  for (int y = low; y <= high; ++y) {
    const ImagePlane::Sample before = image_.sample(wedge_.sector, x - 1, y),
                             at = image_.sample(wedge_.sector, x, y);
    if (isThere(x - 1, y - 1) || isThere(x, y - 1) || isThere(x - 1, y + 1) || isThere(x, y + 1))
      addNear(before, at);
    if (y == high) break;
    const ImagePlane::Sample beforeNext = image_.sample(wedge_.sector, x - 1, y + 1),
                             next = image_.sample(wedge_.sector, x, y + 1);
    if (isThere(x - 1, y + 1) || isThere(x, y)) addNear(before, next);
    if (isThere(x - 1, y) != isThere(x, y + 1)) addNear(beforeNext, at);
    if (isThere(x - 1, y) || isThere(x - 1, y + 1) || isThere(x + 1, y) || isThere(x + 1, y + 1))
      addNear(at, next);
    if (wantsGaps_) addNearGap(x, y);
  }
}

/// The part of an edge near the observer that is in the wedge, in front of the observer, and not too near.
void WedgeTerrain::addNear(const ImagePlane::Sample& from, const ImagePlane::Sample& to) {
  if (std::isnan(from.height + to.height)) return;
  const Vec2 a = from.place, b = to.place;
  double t0 = 0, t1 = 1;
  // Keeps the part of [t0, t1] in which a linear function, with these values at both ends, is positive.
  const auto keep = [&](double atA, double atB) {
    if (atA >= 0 && atB >= 0) return;
    if (atA < 0 && atB < 0) {
      t0 = 2;
    } else if (atA < 0) {
      t0 = std::max(t0, atA / (atA - atB));
    } else {
      t1 = std::min(t1, atA / (atA - atB));
    }
  };
  // Wider than the wedge, so that clipping changes nothing in it.
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
  if (std::fabs(u1 - u0) < (image_.isMapped() ? kNarrow : kNoWidth)) return;  // it points at the observer
  if (from.isBesideGap || to.isBesideGap) return uncertain_.add(u0, v0, u1, v1, 0);
  skyline_.add(u0, v0, u1, v1, image_.slack(nearest, std::max(from.uncertainty, to.uncertainty)));
}

/// The part without terrain of the cell from (x - 1, y) to (x, y + 1).
void WedgeTerrain::addNearGap(int x, int y) {
  const double x0 = x - 1 - observer_.x, x1 = x - observer_.x, y0 = y - observer_.y, y1 = y + 1 - observer_.y;
  const std::array<Vec2, 4> corners{Vec2{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  const bool isMissing[] = {std::isnan(grid_.height(x - 1, y)), std::isnan(grid_.height(x, y)),
                            std::isnan(grid_.height(x, y + 1)), std::isnan(grid_.height(x - 1, y + 1))};
  const auto missing = std::count(std::begin(isMissing), std::end(isMissing), true);
  if (missing > 1) return nearGaps_.add(corners);
  if (missing == 0) return;
  // The triangle of the missing corner and its two neighbours.
  const auto i =
      static_cast<std::size_t>(std::find(std::begin(isMissing), std::end(isMissing), true) - isMissing);
  nearGaps_.add(std::array<Vec2, 3>{corners[(i + 3) % 4], corners[i], corners[(i + 1) % 4]});
}

/// Tips on the skyline: an engine says whether they hide what is behind them. (Of a mapped plan no sample
/// beside a gap hides for sure, so there are none.)
void WedgeTerrain::addTips(int x) {
  for (int y = far_.from; y < far_.from + far_.count; ++y) {
    const std::size_t i = far_.at(y);
    const double u = far_.u[i];
    if (!(far_.v[i] > skyline_.low(far_.bin[i])) || !grid_.isTip(x, y, u + shear_)) continue;
    if (!(far_.v[i] > skyline_.at(u).lower)) continue;
    tips_.add(skyline_, u, image_.corner(far_.x));
  }
}

void WedgeTerrain::addEdges(int x) {
  const int from = std::max(near_.from, far_.from),
            to = std::min(near_.from + near_.count, far_.from + far_.count) - 1;
  if (to < from) return;
  if (near_.hasGaps || far_.hasGaps) {
    addCells(x, from, to);
  } else {
    addWholeCells(x, from, to - from);
  }
  // A mapped line may leave the DEM and come back.
  if (image_.isMapped() && from == grid_.yLeast()) addBorder(x, grid_.yLeast(), grid_.yLeast() - 1);
  if (image_.isMapped() && to == grid_.yGreatest()) addBorder(x, grid_.yGreatest(), grid_.yGreatest() + 1);
}

/// Edges of cells of which some are not whole: runs of whole cells at once, the others one by one.
void WedgeTerrain::addCells(int x, int from, int to) {
  const double *z0 = near_.z.data() + near_.at(from), *z1 = far_.z.data() + far_.at(from);
  const auto isWhole = [&](int i) { return !std::isnan((z0[i] + z0[i + 1]) + (z1[i] + z1[i + 1])); };
  const int count = to - from;
  for (int i = 0; i <= count;) {
    int end = i;
    while (end < count && isWhole(end)) ++end;
    if (end > i) addWholeCells(x, from + i, end - i);
    // If the cell before is whole, its last edge is added twice, which does not change the skyline.
    addPartialCell(x, from + end);
    i = end + 1;
  }
}

void WedgeTerrain::addWholeCells(int x, int from, int count) {
  if (image_.isMapped()) {
    addWholeCells<true>(x, from, count);
  } else {
    addWholeCells<false>(x, from, count);
  }
}

template <bool kIsMapped>
void WedgeTerrain::addWholeCells(int x, int from, int count) {
  const std::size_t n = near_.at(from), f = far_.at(from);
  const double *u0 = near_.u.data() + n, *v0 = near_.v.data() + n, *u1 = far_.u.data() + f,
               *v1 = far_.v.data() + f;
  const int *bin0 = near_.bin.data() + n, *bin1 = far_.bin.data() + f;
  const double slack0 = image_.slack(near_.x * kMapX, 0), slack1 = image_.slack(far_.x * kMapX, 0);
  for (int i = 0; i < count; ++i) {
    const double highest = std::max(v0[i], std::max(v1[i], v1[i + 1]));
    if (highest <= skyline_.low(std::min(bin0[i], bin1[i]), std::max(bin0[i], bin1[i + 1]))) continue;
    if constexpr (kIsMapped) {
      const End start{near_, n + static_cast<std::size_t>(i)}, across{far_, f + static_cast<std::size_t>(i)},
          end{far_, across.at + 1};
      addMappedEdge(across, end, grid_.trianglesAcross(x, from + i));
      addMappedEdge(start, across, grid_.trianglesAlong(x, from + i));
      addMappedEdge(start, end, 2);
    } else {
      skyline_.add(u1[i], v1[i], u1[i + 1], v1[i + 1], slack1);
      skyline_.add(u0[i], v0[i], u1[i], v1[i], slack0);
      skyline_.add(u0[i], v0[i], u1[i + 1], v1[i + 1], slack0);
    }
  }
  if (count < 0) return;
  if constexpr (kIsMapped) {
    addMappedEdge({near_, n + static_cast<std::size_t>(count)}, {far_, f + static_cast<std::size_t>(count)},
                  grid_.trianglesAlong(x, from + count));
  } else {
    skyline_.add(u0[count], v0[count], u1[count], v1[count], slack0);
  }
}

/// Adds edges and gaps of the cell from (x - 1, y) to (x, y + 1): its diagonal, its edge along x at y, its
/// edge along y at x; those that exist.
void WedgeTerrain::addPartialCell(int x, int y) {
  const auto n = near_.at(y), f = far_.at(y);
  const auto add = [&](const ImageLine& a, std::size_t i, const ImageLine& b, std::size_t j, int triangles) {
    if (image_.isMapped()) {
      addMappedEdge({a, i}, {b, j}, triangles);
    } else if (triangles > 0) {
      skyline_.add(a.u[i], a.v[i], b.u[j], b.v[j], slack(a, i, b, j));
    }
  };
  const bool has00 = !std::isnan(near_.z[n]), has10 = !std::isnan(far_.z[f]);
  if (has00 && has10) add(near_, n, far_, f, grid_.trianglesAlong(x, y));
  if (!near_.has(y + 1) || !far_.has(y + 1)) return;
  const bool has01 = !std::isnan(near_.z[n + 1]), has11 = !std::isnan(far_.z[f + 1]);
  if (has10 && has11) add(far_, f, far_, f + 1, grid_.trianglesAcross(x, y));
  const int corners = has00 + has01 + has10 + has11;
  if (corners >= 3) {
    if (has00 && has11) {
      add(near_, n, far_, f + 1, corners - 2);
    } else {
      add(near_, n + 1, far_, f, 1);
    }
  }
  if (corners == 4 || !wantsGaps_) return;
  double first = kUnbounded, last = -kUnbounded;
  const auto reach = [&](double u) {
    first = std::min(first, u);
    last = std::max(last, u);
  };
  // Of three corners, the gap is the triangle of the fourth and its neighbours.
  if (corners < 3 || !has00 || !has11 || !has01) reach(near_.u[n + 1]);
  if (corners < 3 || !has00 || !has11 || !has10) reach(far_.u[f]);
  if (corners < 3 || !has01 || !has10 || !has00) reach(near_.u[n]);
  if (corners < 3 || !has01 || !has10 || !has11) reach(far_.u[f + 1]);
  gaps_.add(first, last, image_.corner(near_.x));
}

/// @param triangles how many triangles the edge has.
void WedgeTerrain::addMappedEdge(End a, End b, int triangles) {
  const double u0 = a.line.u[a.at], u1 = b.line.u[b.at];
  if (triangles == 0 || !(std::fabs(u1 - u0) * near_.x > kNarrow)) return;
  const double v0 = a.line.v[a.at], v1 = b.line.v[b.at];
  if (!a.line.isBesideGap[a.at] && !b.line.isBesideGap[b.at])
    return skyline_.add(u0, v0, u1, v1, slack(a.line, a.at, b.line, b.at));
  uncertain_.add(u0, v0, u1, v1, 0);
  addBesideGap(a, b, triangles == 1);
}

/// Adds the part of an edge beside a gap that is in front of lines in its directions for sure, though they
/// run up to planError() to its side: the part that is no nearer than that to where terrain may be missing.
/// If the edge is a rim, a line in its direction has terrain below it for sure only some way into the
/// triangle behind it, where that may be lower.
void WedgeTerrain::addBesideGap(End a, End b, bool isRim) {
  constexpr double kSmallestSine = 0.25;  // of the angle between the line and the rim
  // Factors of safety, tested, not proved: how far a line and the ends of the edge may be off together, in
  // planError(); what is cut off beyond that; how much more uncertain heights and slopes beside a rim are.
  constexpr double kOff = 3, kCut = 2, kRimHeight = 8, kRimSlope = 2;
  const Vec2 p = a.place(), q = b.place();
  const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy);
  const double error = kOff * image_.planError(
                                  std::hypot(std::max(p.x, q.x), std::max(std::fabs(p.y), std::fabs(q.y)))),
               inward = isRim ? error / kSmallestSine : 0;
  const double cut = kCut * (error + inward) / length;
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
  double uncertainty = std::max(a.line.uncertainty[a.at], b.line.uncertainty[b.at]);
  if (isRim) {
    if (!(std::min(std::fabs(sines[0]), std::fabs(sines[1])) > kSmallestSine) || sines[0] * sines[1] < 0)
      return;
    uncertainty = kRimHeight * uncertainty + kRimSlope * inward * steepest;
  }
  if (std::fabs(u[1] - u[0]) * near_.x > kNarrow)
    skyline_.add(u[0], v[0], u[1], v[1], image_.slack(nearest * kMapX, uncertainty));
}

/// A gap: the cell from the DEM's border at y to one row outside of it.
void WedgeTerrain::addBorder(int x, int y, int outside) {
  const double beyond0 = image_.direction(wedge_.sector, x - 1, outside, shear_),
               beyond1 = image_.direction(wedge_.sector, x, outside, shear_);
  const double u0 = near_.u[near_.at(y)], u1 = far_.u[far_.at(y)];
  gaps_.add(std::min(std::min(u0, u1), std::min(beyond0, beyond1)),
            std::max(std::max(u0, u1), std::max(beyond0, beyond1)), image_.corner(near_.x));
}

}  // namespace arete
