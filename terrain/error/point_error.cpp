// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points a triangle covers is decided by linear functions with margins (conflict_lists.h), and by exact
// predicates where those leave a point undecided. The plane itself is evaluated only at points that may
// change the result.
#include "terrain/error/point_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/error/exact_error.h"

namespace arete {
namespace {

// Products below the first may have lost digits; the second is more than any of them has lost.
constexpr double kUnderflow = 0x1p-900, kTiny = 0x1p-1030;

}  // namespace

bool PointError::covers(VertexId a, VertexId b, VertexId c, VertexId p) const {
  const Vec2 pa = plan_.planPosition(a), pb = plan_.planPosition(b), pc = plan_.planPosition(c),
             q = plan_.planPosition(p);
  if (q.x < std::min({pa.x, pb.x, pc.x}) || q.x > std::max({pa.x, pb.x, pc.x}) ||
      q.y < std::min({pa.y, pb.y, pc.y}) || q.y > std::max({pa.y, pb.y, pc.y}))
    return false;
  return plan_.orientation(a, b, p) >= 0 && plan_.orientation(b, c, p) >= 0 &&
         plan_.orientation(c, a, p) >= 0;
}

/// difference() for a triangle whose area is lost to rounding: the difference of largest magnitude over the
/// sides beside p, since that of the plane lies between those of two sides.
double PointError::differenceOnLine(VertexId a, VertexId b, VertexId c, VertexId p) const {
  const Vec2 q = plan_.planPosition(p);
  double largest = 0;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Vec2 u = plan_.planPosition(from), v = plan_.planPosition(to);
    const double dx = v.x - u.x, dy = v.y - u.y, squared = dx * dx + dy * dy;
    const double along = squared > 0 ? ((q.x - u.x) * dx + (q.y - u.y) * dy) / squared : 0;
    constexpr double kBeside = 0.01;
    if (along < -kBeside || along > 1 + kBeside) continue;
    const double t = std::clamp(along, 0.0, 1.0);
    const double d = position(from).z + t * (position(to).z - position(from).z) - position(p).z;
    if (std::abs(d) > std::abs(largest)) largest = d;
  }
  return largest;
}

/// z of the plane through a, b, c minus z of p, at p. Precondition: the triangle covers p.
PointError::Difference PointError::difference(VertexId a, VertexId b, VertexId c, VertexId p) const {
  const Vec2 o = plan_.planPosition(a), pb = plan_.planPosition(b), pc = plan_.planPosition(c),
             q = plan_.planPosition(p);
  const double bx = pb.x - o.x, by = pb.y - o.y, cx = pc.x - o.x, cy = pc.y - o.y, x = q.x - o.x,
               y = q.y - o.y;
  const double left = bx * cy, right = by * cx, area = left - right;
  // The terms are rounded: an area far smaller than its terms is not reliable enough to divide by.
  constexpr double kReliable = 0x1p-30;
  const double terms = std::abs(left) + std::abs(right), riseB = position(b).z - position(a).z,
               riseC = position(c).z - position(a).z;
  if (riseB == 0 && riseC == 0) {  // level ground
    const double value = position(a).z - position(p).z;
    return {value, 0x1p-53 * std::abs(value)};
  }
  // The weights are between 0 and 1, so a height is right to the rises at worst.
  if (!(std::abs(area) > kReliable * terms && terms > kUnderflow)) {
    const double value = differenceOnLine(a, b, c, p);
    return {value, 2 * (std::abs(riseB) + std::abs(riseC)) + 0x1p-50 * std::abs(position(a).z)};
  }
  const double u = (x * cy - y * cx) / area, w = (bx * y - by * x) / area;
  const double value = position(a).z + u * riseB + w * riseC - position(p).z;
  // A difference of coordinates is rounded once, a product of two of them and its sum four times.
  const double lostU = std::abs(x * cy) + std::abs(y * cx) + std::abs(u) * terms,
               lostW = std::abs(bx * y) + std::abs(by * x) + std::abs(w) * terms;
  const double rounding = 0x1p-49 * (lostU * std::abs(riseB) + lostW * std::abs(riseC)) / std::abs(area) +
                          0x1p-50 * (std::abs(riseB) + std::abs(riseC) + std::abs(position(a).z)) + kTiny;
  return {value, rounding + 0x1p-52 * std::abs(value)};
}

namespace {
// One hole at a time per thread; the arrays keep their capacity from hole to hole.
thread_local ConflictLists conflictsOfHole;
}  // namespace

// The lists are merged at the first query of a hole, and a hole that no query reaches costs nothing. The
// removed apex is the first point; the reach covers all points and corners, by which the margins are
// computed.
const ConflictLists& PointError::Hole::conflicts() const {
  if (conflicts_ != nullptr) return *conflicts_;
  ConflictLists& conflicts = conflictsOfHole;
  const Vec3 apex = errors_.position(apex_);
  conflicts.clear(apex);
  conflicts.add(apex_, apex);
  Vec3 reach;
  for (const VertexId corner : star_.linkView()) {
    const Vec3& p = errors_.position(corner);
    reach = {std::max(reach.x, std::abs(p.x - apex.x)), std::max(reach.y, std::abs(p.y - apex.y)),
             std::max(reach.z, std::abs(p.z - apex.z))};
  }
  for (int i = 0; i < star_.triangleCount; ++i)
    for (VertexId p = errors_.head_[star_.slot(i)]; p.isValid(); p = errors_.next_[p]) {
      const Vec3& position = errors_.position(p);
      conflicts.add(p, position);
      reach.z = std::max(reach.z, std::abs(position.z - apex.z));
    }
  conflicts.close(reach);
  conflicts_ = &conflicts;
  return conflicts;
}

ConflictLists::Triangle PointError::Hole::triangle(int i, int j, int m) const {
  return {conflicts(), position(i), position(j), position(m)};
}

bool PointError::Hole::isCovered(const ConflictLists::Found& found, int i, int j, int m) const {
  return found.isCovered ||
         errors_.covers(star_.link[i], star_.link[j], star_.link[m], conflicts()[found.index]);
}

// Differences of plan coordinates are computed from the exact points, and not from rounded positions.
Vec3 PointError::Hole::fromApex(int i) const {
  const VertexId corner = star_.link[i];
  const PointPlan::Point o = errors_.plan_.point(apex_), p = errors_.plan_.point(corner);
  return {p.x() - o.x(), p.y() - o.y(), errors_.position(corner).z - errors_.position(apex_).z};
}

double PointError::Hole::apexError(int i, int j, int m) const {
  return std::abs(errors_.difference(star_.link[i], star_.link[j], star_.link[m], apex_).value);
}

// A point that may exceed the worst error so far is evaluated, so candidates become rare as the error grows.
// The caller does not care how far beyond the limit the error is.
double PointError::Hole::maximum(int i, int j, int m, double limit) const {
  const ConflictLists::Triangle over = triangle(i, j, m);
  double worst = 0;
  for (auto found = over.next(0, worst, worst); found.index != conflicts().size();
       found = over.next(found.index + 1, worst, worst)) {
    if (!isCovered(found, i, j, m)) continue;
    const VertexId p = conflicts()[found.index];
    worst =
        std::max(worst, std::abs(errors_.difference(star_.link[i], star_.link[j], star_.link[m], p).value));
    if (worst > limit) break;
  }
  return worst;
}

double PointError::Hole::maximum(int i, int j, int m, double limit, SignedBound& bound,
                                 double& rounding) const {
  const ConflictLists::Triangle over = triangle(i, j, m);
  double worst = 0;
  rounding = 0;
  for (auto found = over.next(0, bound.above, bound.below); found.index != conflicts().size();
       found = over.next(found.index + 1, bound.above, bound.below)) {
    if (!isCovered(found, i, j, m)) continue;
    const VertexId p = conflicts()[found.index];
    const Difference d = errors_.difference(star_.link[i], star_.link[j], star_.link[m], p);
    bound.include({d.rounding - d.value, d.rounding + d.value});
    worst = std::max(worst, std::abs(d.value));
    rounding = std::max(rounding, d.rounding);
    if (worst > limit) break;
  }
  return worst;
}

// A difference farther from the bound than its rounding decides; only one that is closer needs the exact
// predicate.
bool PointError::Hole::isAbove(int i, int j, int m, double, double, double bound) const {
  const ConflictLists::Triangle over = triangle(i, j, m);
  const VertexId a = star_.link[i], b = star_.link[j], c = star_.link[m];
  for (auto found = over.next(0, bound, bound); found.index != conflicts().size();
       found = over.next(found.index + 1, bound, bound)) {
    if (!isCovered(found, i, j, m)) continue;
    const VertexId p = conflicts()[found.index];
    const Difference d = errors_.difference(a, b, c, p);
    if (std::abs(d.value) + d.rounding <= bound) continue;
    if (std::abs(d.value) - d.rounding > bound) return true;
    if (isErrorAbove(errors_.position(a), errors_.position(b), errors_.position(c), errors_.position(p),
                     bound))
      return true;
  }
  return false;
}

// Each point goes to the first triangle that covers it. A point on an edge is covered by two triangles, and
// must be in one list only.
void PointError::Hole::settle(const HoleTriangulation& floor) {
  const std::size_t count = conflicts().size();
  thread_local std::vector<std::uint8_t> isAssigned;
  isAssigned.assign(count, 0);
  for (int t = 0; t < star_.triangleCount; ++t) errors_.head_[star_.slot(t)] = VertexId();
  for (int f = 0; f < floor.size; ++f) {
    const auto [i, j, m] = floor.triangles[f];
    VertexId& head = errors_.head_[star_.slot(f)];
    const ConflictLists::Triangle over = triangle(i, j, m);
    for (auto found = over.nextCovered(0); found.index != count; found = over.nextCovered(found.index + 1)) {
      if (isAssigned[found.index] != 0 || !isCovered(found, i, j, m)) continue;
      const VertexId p = conflicts()[found.index];
      isAssigned[found.index] = 1;
      errors_.next_[p] = head;
      head = p;
    }
  }
}

void PointError::compact(const SlotMap& newSlot) {
  newSlot.forLiveInPlace([&](SlotId from, SlotId to) { head_[to] = head_[from]; });
  head_.shrink(newSlot.liveCount());
}

}  // namespace arete
