// SPDX-License-Identifier: GPL-3.0-or-later
//
// First every piece is measured as a whole against each triangle of the floor. Its corners' distances to the
// nearest triangle bound from below what any division can reach; the largest of these over all pieces is the
// error that the floor has anyway. Pieces that stay well below it as a whole need no cut. The others are cut
// by the planes through the floor's diagonals that halve the angle there: the diagonals are a binary tree, of
// which a polygon passes the part that it lies across. Each part then belongs to the triangle that is nearest
// to it as a whole, whichever that is, so what a cut does not reach makes a bound larger and never wrong. A
// plane goes on behind the diagonal's ends, and a hole with a reflex corner is not what the tree takes it
// for: there further cuts by any of the planes help.
#include "surface/error/piece_division.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

/// Pieces below this part of the floor's error are not cut.
constexpr double kLeastCoveredShare = 0.7;
/// And what further cuts leave at this part of it is not cut again.
constexpr double kNearEnough = 1.15;
/// Of more pieces of a face the convex hull is taken, which is farther than they are where they do not touch.
constexpr std::size_t kMostApart = 24;

Vec3 unitOrZero(const Vec3& a) {
  const double length = norm(a);
  return length > 0 ? a / length : a;
}

}  // namespace

const AttributeField PieceDivision::kNoAttributes;

void PieceDivision::clear() {
  parts_.clear();
  points_.clear();
}

void PieceDivision::add(const PieceList& pieces) {
  pieces.forEach([&](const Piece& piece) { add(piece.face, piece.cuts, piece.polygon); });
}

void PieceDivision::add(std::uint32_t face) {
  add(face, 0, wholeFace());
}

void PieceDivision::add(std::uint32_t face, std::uint32_t cuts, std::span<const FacePoint> polygon) {
  const auto begin = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), polygon.begin(), polygon.end());
  parts_.push_back({face, cuts, begin, static_cast<std::uint32_t>(points_.size()), {}});
}

void PieceDivision::joinParts() {
  std::ranges::sort(parts_, [](const Part& a, const Part& b) {
    return a.face != b.face ? a.face < b.face : a.begin < b.begin;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0, end; i < parts_.size(); i = end) {
    end = i + 1;
    while (end < parts_.size() && parts_[end].face == parts_[i].face) ++end;
    const std::size_t first = kept;
    parts_[kept++] = parts_[i];
    if (end - i == 1) continue;
    Part hull = parts_[i];
    const bool isFilled = join(std::span(parts_).subspan(i, end - i), hull);
    if (isFilled || end - i > kMostApart) {
      parts_[first] = hull;
      continue;
    }
    // Each with those before that it fills a convex polygon with.
    for (std::size_t k = i + 1; k < end; ++k) {
      Part part = parts_[k];
      for (std::size_t m = first; m < kept;) {
        const std::array<Part, 2> both{parts_[m], part};
        Part joined = part;
        if (!join(both, joined)) {
          ++m;
          continue;
        }
        part = joined;
        parts_[m] = parts_[--kept];
        m = first;
      }
      parts_[kept++] = part;
    }
  }
  parts_.resize(kept);
}

bool PieceDivision::join(std::span<const Part> some, Part& into) {
  hull_.clear();
  std::uint32_t cuts = 0;
  std::int64_t apart = 0;
  for (const Part& part : some) {
    apart += twiceArea(polygonOf(part));
    hull_.insert(hull_.end(), points_.begin() + part.begin, points_.begin() + part.end);
    cuts = std::max(cuts, part.cuts);
  }
  takeConvexHull(hull_);
  into.face = some[0].face;
  into.cuts = isWholeFace(hull_) ? 0 : cuts;
  into.begin = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), hull_.begin(), hull_.end());
  into.end = static_cast<std::uint32_t>(points_.size());
  // But for what rounding has moved corners by.
  return twiceArea(hull_) <= apart + std::int64_t{FacePoint::kOne} * (cuts + 4);
}

void PieceDivision::squaresAt(std::uint32_t number, const FacePoint& p, const Vec3& place,
                              FloorDistance::Squares& to) {
  if (joint_.size() == 0) {
    floor_.squares(place, to);
    return;
  }
  wanted_.resize(field_.components());
  field_.mean(field_.cornersOf(number), sharesOf(p), wanted_);
  for (std::size_t lane = 0; lane < joint_.size(); ++lane) to[lane] = joint_.squared(lane, place, wanted_);
}

std::pair<double, double> PieceDivision::heightsOver(const Cut& plane, std::span<const FacePoint> polygon,
                                                     std::uint32_t number, const SpaceTriangle& face,
                                                     std::vector<double>& heights) {
  heights.clear();
  double low = 0, high = 0;
  for (const FacePoint& p : polygon) {
    double height = dot(plane.normal, placeOf(p, face) - plane.point);
    if (joint_.size() > 0) {
      const std::size_t count = field_.components();
      wanted_.resize(count);
      field_.mean(field_.cornersOf(number), sharesOf(p), wanted_);
      const double *const point = ofPlanes_.data() + plane.attributes, *const normal = point + count;
      for (std::size_t i = 0; i < count; ++i)
        if (normal[i] != 0) height += normal[i] * (wanted_[i] - point[i]);
    }
    heights.push_back(height);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return {low, high};
}

void PieceDivision::countAttributes(Cut& cut, const HoleTriangulation& floor, std::span<const Vec3> corners,
                                    const FloorJoins::Diagonal& diagonal, bool isForthBelow) {
  const std::size_t count = field_.components();
  cut.attributes = ofPlanes_.size();
  ofPlanes_.resize(ofPlanes_.size() + 2 * count, 0.0);
  double* const normal = ofPlanes_.data() + cut.attributes + count;
  Vec3 inSpace{};
  for (const bool isForth : {true, false}) {
    const std::size_t t = isForth ? diagonal.forth.triangle : diagonal.back.triangle;
    std::array<std::size_t, 3> at{};  // the ends, and the third corner
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint8_t corner = floor.triangles[t][c];
      at[corner == diagonal.from ? 0 : corner == diagonal.to ? 1 : 2] = c;
    }
    const auto place = [&](std::size_t i) { return corners[floor.triangles[t][at[i]]]; };
    const auto values = [&](std::size_t i) { return field_.at(drawn_[t][at[i]]); };
    const Vec3 along = place(1) - place(0), up = place(2) - place(0);
    double length = dot(along, along), common = dot(along, up);
    const auto forEach = [&](const auto& visit) {
      for (const AttributeField::Entry& e : field_.entries()) {
        if (e.length == 0) continue;
        for (std::size_t i = e.first; i < e.first + e.measured(); ++i) {
          const double a = values(0)[i], onEdge = values(1)[i] - a, off = values(2)[i] - a;
          if (std::isfinite(onEdge + off)) visit(i, e.weight(), onEdge, off);
        }
      }
    };
    forEach([&](std::size_t, double weight, double onEdge, double off) {
      length += weight * onEdge * onEdge;
      common += weight * onEdge * off;
    });
    const double share = length > 0 ? common / length : 0;
    const Vec3 across = up - share * along;
    double squared = dot(across, across);
    forEach([&](std::size_t, double weight, double onEdge, double off) {
      squared += weight * (off - share * onEdge) * (off - share * onEdge);
    });
    if (!(squared > 0)) continue;
    const double towards = (isForth == isForthBelow ? -1 : 1) / std::sqrt(squared);
    inSpace = inSpace + towards * across;
    forEach([&](std::size_t i, double weight, double onEdge, double off) {
      normal[i] += towards * weight * (off - share * onEdge);
    });
    std::ranges::copy(values(0), ofPlanes_.begin() + std::ptrdiff_t(cut.attributes));
  }
  cut.normal = inSpace;
}

PieceDivision::Whole PieceDivision::bestWhole(std::uint32_t number, const SpaceTriangle& face,
                                              std::span<const FacePoint> polygon, double* least) {
  std::array<double, kMaxHoleCorners> most{};
  double leastOfAll = 0;
  FloorDistance::Squares squares;
  for (const FacePoint& p : polygon) {
    double nearest = std::numeric_limits<double>::infinity();
    squaresAt(number, p, placeOf(p, face), squares);
    for (int t = 0; t < floor_.size(); ++t) {
      most[t] = std::max(most[t], squares[t]);
      nearest = std::min(nearest, squares[t]);
    }
    leastOfAll = std::max(leastOfAll, nearest);
  }
  if (least != nullptr) *least = leastOfAll;
  const auto best =
      static_cast<int>(std::min_element(most.begin(), most.begin() + floor_.size()) - most.begin());
  return {best, most[best]};
}

int PieceDivision::planCuts(const HoleTriangulation& floor, const FloorJoins& joins,
                            std::span<const Vec3> corners, std::uint32_t members) {
  const int size = std::popcount(members);
  if (size == 1) return -1;
  // The diagonal that divides the triangles most evenly. Those between its corners are below it.
  std::uint32_t bestBelow = 0;
  int best = -1;
  for (int d = 0; d < joins.diagonalCount; ++d) {
    const FloorJoins::Diagonal& diagonal = joins.diagonals[d];
    if ((members >> diagonal.forth.triangle & members >> diagonal.back.triangle & 1) == 0) continue;
    std::uint32_t below = 0;
    for (int t = 0; t < floor.size; ++t)
      if (floor.triangles[t][0] >= diagonal.from && floor.triangles[t][2] <= diagonal.to)
        below |= std::uint32_t{1} << t;
    below &= members;
    const auto balance = [&](std::uint32_t part) { return std::abs(2 * std::popcount(part) - size); };
    if (best >= 0 && balance(below) >= balance(bestBelow)) continue;
    best = d;
    bestBelow = below;
  }
  const FloorJoins::Diagonal& diagonal = joins.diagonals[best];
  const Vec3 along = corners[diagonal.to] - corners[diagonal.from];
  const Vec3 normal = unitOrZero(floor_.normal(laneOf_[diagonal.forth.triangle])) +
                      unitOrZero(floor_.normal(laneOf_[diagonal.back.triangle]));
  Cut cut{corners[diagonal.from], cross(normal, along), 0, 0, 0};
  if (joint_.size() > 0)
    countAttributes(cut, floor, corners, diagonal, (bestBelow >> diagonal.forth.triangle & 1) != 0);
  cut.below = planCuts(floor, joins, corners, bestBelow);
  cut.above = planCuts(floor, joins, corners, members & ~bestBelow);
  tree_.push_back(cut);
  return static_cast<int>(tree_.size() - 1);
}

void PieceDivision::cutAlong(int node, std::size_t depth, std::uint32_t number, const SpaceTriangle& face,
                             const FacePolygon& polygon, std::uint32_t cuts) {
  if (node < 0) {
    if (leafCount_ == leaves_.size()) leaves_.emplace_back();
    Leaf& leaf = leaves_[leafCount_++];
    leaf.polygon = polygon;
    leaf.cuts = cuts;
    leaf.whole = bestWhole(number, face, polygon, nullptr);
    return;
  }
  const Cut plane = tree_[static_cast<std::size_t>(node)];
  Halves& halves = halves_[depth];
  const auto [low, high] = heightsOver(plane, polygon, number, face, halves.heights);
  bool isBelow = low < 0;
  if (low < 0 && high > 0) {
    cut(polygon, halves.heights, halves.below, halves.above);
    // A half without area is what rounding leaves of a polygon that only touches the plane. Elsewhere than
    // the rest it would count as if it were far from there.
    const bool hasBelow = twiceArea(halves.below) > 0, hasAbove = twiceArea(halves.above) > 0;
    if (hasBelow && hasAbove) {
      cutAlong(plane.below, depth + 1, number, face, halves.below, cuts + 1);
      cutAlong(plane.above, depth + 1, number, face, halves.above, cuts + 1);
      return;
    }
    isBelow = hasBelow || (!hasAbove && -low > high);
  }
  cutAlong(isBelow ? plane.below : plane.above, depth + 1, number, face, polygon, cuts);
}

/// @param enough the squared distance below which a leaf is not cut
void PieceDivision::cutFurther(std::size_t at, std::uint32_t number, const SpaceTriangle& face, double enough,
                               std::uint32_t depth) {
  constexpr std::uint32_t kDeepest = 6;
  // A cut adds rounding, which should stay well below what it gains.
  const double added = 4 * roundingOf(original_, face, leaves_[at].cuts + 1);
  enough = std::max(enough, added * added);
  if (depth == kDeepest || leaves_[at].whole.squared <= enough) return;
  Leaf below, above;
  double least = leaves_[at].whole.squared;
  bool isCut = false;
  Halves& halves = halves_[0];
  for (const Cut& plane : tree_) {
    const FacePolygon& polygon = leaves_[at].polygon;
    const auto [low, high] = heightsOver(plane, polygon, number, face, halves.heights);
    if (!(low < 0 && high > 0)) continue;
    cut(polygon, halves.heights, halves.below, halves.above);
    if (!(twiceArea(halves.below) > 0 && twiceArea(halves.above) > 0)) continue;
    const Whole one = bestWhole(number, face, halves.below, nullptr),
                other = bestWhole(number, face, halves.above, nullptr);
    const double worst = std::max(one.squared, other.squared);
    const bool isFirst = !isCut && worst <= least && std::min(one.squared, other.squared) <= enough;
    if (!(worst < least) && !isFirst) continue;
    isCut = true;
    least = worst;
    below = {halves.below, leaves_[at].cuts + 1, one};
    above = {halves.above, leaves_[at].cuts + 1, other};
  }
  if (!isCut) return;
  if (leafCount_ == leaves_.size()) leaves_.emplace_back();
  const std::size_t next = leafCount_++;
  leaves_[at] = std::move(below);
  leaves_[next] = std::move(above);
  cutFurther(at, number, face, enough, depth + 1);
  cutFurther(next, number, face, enough, depth + 1);
}

void PieceDivision::assign(std::uint32_t face, std::uint32_t cuts, std::span<const FacePoint> polygon,
                           const SpaceTriangle& place, const Whole& whole) {
  const auto lane = static_cast<std::size_t>(whole.lane);
  const std::size_t f = triangleOf_[lane];
  lists_[f].add(face, cuts, polygon);
  const double rounding = roundingOf(original_, place, isWholeFace(polygon) ? 0 : cuts);
  // A sum over the polygon's middle and corners that is exact for a triangle and a quadratic function.
  Vec3 middle;
  double atCorners = 0, most = 0;
  FloorDistance::Squares squares;
  for (const FacePoint& p : polygon) {
    const Vec3 at = placeOf(p, place);
    middle = middle + at;
    floor_.squares(at, squares);
    atCorners += squares[lane];
    most = std::max(most, squares[lane]);
  }
  const double count = double(polygon.size()), unit = 1.0 / FacePoint::kOne;
  const double area =
      norm(cross(place[1] - place[0], place[2] - place[0])) / 2 * (double(twiceArea(polygon)) * unit * unit);
  integrals_[f].area += area;
  floor_.squares(middle / count, squares);
  integrals_[f].squared += area * (0.75 * squares[lane] + 0.25 * atCorners / count);
  bounds_[f] = std::max(bounds_[f], std::sqrt(most) * (1 + 1e-12) + rounding);
}

/// The pieces are measured by their distances from the segment between a and b: the triangle contains it, so
/// the bound holds for the triangle too.
void PieceDivision::giveAcross(int f, std::uint8_t across, const Vec3& a, const Vec3& b) {
  joinParts();
  const Vec3 along = b - a;
  const double squaredLength = dot(along, along);
  for (const Part& part : parts_) {
    const SpaceTriangle face = original_.face(part.face);
    const std::span<const FacePoint> polygon = polygonOf(part);
    double most = 0;
    for (const FacePoint& p : polygon) {
      const Vec3 away = placeOf(p, face) - a;
      const double at = squaredLength > 0 ? std::clamp(dot(away, along) / squaredLength, 0.0, 1.0) : 0;
      most = std::max(most, squaredDistance(away, at * along));
    }
    lists_[f].add(part.face, part.cuts, polygon, across);
    const double rounding = roundingOf(original_, face, isWholeFace(polygon) ? 0 : part.cuts);
    bounds_[f] = std::max(bounds_[f], std::sqrt(most) * (1 + 1e-12) + rounding);
  }
}

void PieceDivision::divide(std::span<const Vec3> corners, const HoleTriangulation& floor,
                           std::uint32_t members, std::span<const std::array<std::uint32_t, 3>> drawn) {
  joinParts();
  floor_.clear();
  joint_.clear();
  ofPlanes_.clear();
  drawn_ = drawn;
  for (int t = 0; t < floor.size; ++t) {
    if ((members >> t & 1) == 0) continue;
    const auto& [i, j, m] = floor.triangles[t];
    laneOf_[t] = static_cast<std::uint8_t>(floor_.size());
    triangleOf_[floor_.size()] = static_cast<std::uint8_t>(t);
    floor_.add({corners[i], corners[j], corners[m]});
    if (!drawn.empty()) joint_.add({corners[i], corners[j], corners[m]}, drawn[static_cast<std::size_t>(t)]);
    lists_[t].clear();
    bounds_[t] = 0;
    integrals_[t] = {};
  }
  // What every division leaves anyway is known before any cut, so parts that are good enough are not cut.
  double anyway = 0;
  for (Part& part : parts_) {
    double least = 0;
    part.whole = bestWhole(part.face, original_.face(part.face), polygonOf(part), &least);
    anyway = std::max(anyway, least);
  }
  tree_.clear();
  int root = 0;
  bool isPlanned = false;
  for (const Part& part : parts_) {
    const SpaceTriangle face = original_.face(part.face);
    if (part.whole.squared <= kLeastCoveredShare * kLeastCoveredShare * anyway || floor_.size() == 1) {
      assign(part.face, part.cuts, polygonOf(part), face, part.whole);
      continue;
    }
    // The tree of cuts is made at the first part that needs it, and shared by the others.
    if (!isPlanned) {
      root = planCuts(floor, FloorJoins(floor), corners, members);
      isPlanned = true;
    }
    leafCount_ = 0;
    hull_.assign(polygonOf(part).begin(), polygonOf(part).end());
    cutAlong(root, 0, part.face, face, hull_, part.cuts);
    for (std::size_t i = 0, count = leafCount_; i < count; ++i)
      cutFurther(i, part.face, face, kNearEnough * kNearEnough * anyway, 0);
    // Cuts are kept only if they make the part's largest distance smaller; otherwise the part stays whole and
    // the lists stay short.
    double worst = 0;
    const std::span<const Leaf> leaves(leaves_.data(), leafCount_);
    for (const Leaf& leaf : leaves) worst = std::max(worst, leaf.whole.squared);
    if (worst < part.whole.squared)
      for (const Leaf& leaf : leaves) assign(part.face, leaf.cuts, leaf.polygon, face, leaf.whole);
    else
      assign(part.face, part.cuts, polygonOf(part), face, part.whole);
  }
}

}  // namespace arete
