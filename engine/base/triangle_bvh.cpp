// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are parted in the middle of the longest side of the six-dimensional box of their boxes' corners,
// by which long ones side by side stay together, until eight are left, whose distances are found at once; so
// are those of the eight boxes of a node. Where long ones lie aslant, plain boxes overlap each other, and
// children have oriented ones too. A query
// descends to the nearest child first and passes over boxes that are no nearer than the best triangle so far.
// Which triangle is nearest is decided by the lanes; where on it the point lies, by nearestWithShares().
#include "engine/base/triangle_bvh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/base/vector_clones.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TrianglePoint nearestWithShares(const Vec3& p, const SpaceTriangle& t) {
  const auto& [a, b, c] = t;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {a, {1, 0, 0}};
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {b, {0, 1, 0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {a + v * ab, {1 - v, v, 0}};
  }
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {c, {0, 0, 1}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {a + w * ac, {1 - w, 0, w}};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {b + w * (c - b), {0, 1 - w, w}};
  }
  const double whole = va + vb + vc;
  if (!(whole > 0)) {  // no area: the nearest of its sides
    TrianglePoint best = nearestWithShares(p, {a, b, b});
    for (const auto& [from, to] : {std::pair{0, 2}, std::pair{1, 2}}) {
      const TrianglePoint side = nearestWithShares(p, {t[from], t[to], t[to]});
      if (squaredDistance(p, side.place) >= squaredDistance(p, best.place)) continue;
      best = {side.place, {}};
      best.shares[from] = side.shares[0];
      best.shares[to] = side.shares[1];
    }
    return best;
  }
  const double v = vb / whole, w = vc / whole;
  return {a + v * ab + w * ac, {1 - v - w, v, w}};
}

namespace {

/// Sorts a range into two parts: at the middle of the longest side of the box of their boxes' corners, moved
/// to a multiple of what a leaf takes, and so that each part has an eighth. @return the size of the first
std::size_t part(std::span<std::uint32_t> range, std::span<const Box3> boxes, std::size_t leaf) {
  const auto coordinate = [&](std::uint32_t t, std::size_t k) {
    const Vec3& p = k < 3 ? boxes[t].low : boxes[t].high;
    return k % 3 == 0 ? p.x : k % 3 == 1 ? p.y : p.z;
  };
  std::size_t axis = 0;
  double longest = -1, middle = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    double low = kInfinity, high = -kInfinity;
    for (const std::uint32_t t : range) {
      low = std::min(low, coordinate(t, k));
      high = std::max(high, coordinate(t, k));
    }
    if (!(high - low > longest)) continue;
    longest = high - low;
    axis = k;
    middle = std::midpoint(low, high);
  }
  auto some = static_cast<std::size_t>(
      std::ranges::count_if(range, [&](std::uint32_t t) { return coordinate(t, axis) <= middle; }));
  const std::size_t least = std::max<std::size_t>(range.size() / 8, 1);
  some = std::clamp((some + leaf / 2) / leaf * leaf, least, range.size() - least);
  std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(some),
                           [&](std::uint32_t s, std::uint32_t t) {
                             const double atS = coordinate(s, axis), atT = coordinate(t, axis);
                             return atS != atT ? atS < atT : s < t;
                           });
  return some;
}

}  // namespace

TriangleBvh::TriangleBvh(std::span<const Vec3> positions, std::span<const Corners> triangles)
    : entryOf_(triangles.size()) {
  if (triangles.empty()) return;
  std::vector<Box3> boxes(triangles.size(), Box3::empty());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) boxes[t].include(positions[v]);
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  root_ = build(all, boxes);
  places_.resize(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) entryOf_[order_[i]] = i;
  refit(positions, triangles);
}

std::uint32_t TriangleBvh::build(std::span<std::uint32_t> range, std::span<const Box3> boxes) {
  if (range.size() <= kWide) {
    const auto leaf = static_cast<std::uint32_t>(leaves_.size());
    leaves_.emplace_back();
    order_.insert(order_.end(), range.begin(), range.end());
    order_.resize((leaf + 1) * std::size_t{kWide}, range.back());
    return kLeaf + leaf;
  }
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_[node].child.fill(kNone);
  std::array<std::span<std::uint32_t>, kWide> parts;
  parts[0] = range;
  // No more parts than leaves are needed: a leaf takes as long with one triangle as with eight.
  for (std::size_t count = 1; count < kWide; ++count) {
    const auto largest = std::max_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (largest->size() <= kWide) break;
    const std::size_t some = part(*largest, boxes, kWide);
    parts[count] = largest->subspan(some);
    *largest = largest->first(some);
  }
  // The recursion may move the nodes in memory, so the parent is named by its index and never kept by
  // reference.
  for (std::size_t i = 0; i < kWide; ++i)
    if (!parts[i].empty()) {
      const std::uint32_t child = build(parts[i], boxes);
      nodes_[node].child[i] = child;
    }
  return node;
}

void TriangleBvh::refit(std::span<const Vec3> positions, std::span<const Corners> triangles) {
  aslant_.clear();
  if (!isEmpty()) refit(root_, positions, triangles);
}

/// Oriented boxes are kept apart from the nodes, since few nodes need them. A lane without one is unbounded
/// and so never raises a distance.
void TriangleBvh::putAslant(Node& node, std::size_t lane, const OrientedBox& box) {
  if (node.aslant == kNone) {
    node.aslant = static_cast<std::uint32_t>(aslant_.size());
    Aslant& none = aslant_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      none.axes[k].fill(Lanes{});
      none.low[k].fill(-kInfinity);
      none.high[k].fill(kInfinity);
    }
  }
  Aslant& to = aslant_[node.aslant];
  for (std::size_t k = 0; k < 3; ++k) {
    to.axes[k][0][lane] = box.axes[k].x;
    to.axes[k][1][lane] = box.axes[k].y;
    to.axes[k][2][lane] = box.axes[k].z;
    to.low[k][lane] = box.low[k];
    to.high[k][lane] = box.high[k];
  }
}

TriangleBvh::Below TriangleBvh::refit(std::uint32_t child, std::span<const Vec3> positions,
                                      std::span<const Corners> triangles) {
  Below all;
  Box3& box = all.box;
  const auto put = [](std::array<Lanes, 3>& to, std::size_t lane, const Vec3& v) {
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
  };
  // The boxes of an inner node follow from its children; a missing child has an empty box, infinitely far
  // from every point. The leaves below a child follow each other, so their triangles are one span.
  if (child < kLeaf) {
    Node& node = nodes_[child];
    node.aslant = kNone;
    for (std::size_t i = 0; i < kWide; ++i) {
      const Below below = node.child[i] == kNone ? Below{} : refit(node.child[i], positions, triangles);
      put(node.low, i, below.box.low);
      put(node.high, i, below.box.high);
      if (node.child[i] == kNone) continue;
      box.include(below.box.low);
      box.include(below.box.high);
      all.first = std::min(all.first, below.first);
      all.end = below.end;
      const auto inside = std::span(places_).subspan(below.first * std::size_t{kWide},
                                                     (below.end - below.first) * std::size_t{kWide});
      if (const auto aslant = orientedBoxOf(inside, below.box)) putAslant(node, i, *aslant);
    }
    return all;
  }
  // A leaf keeps what the search would compute for each query: edge vectors, their products and their
  // inverses. An inverse is 0 where a side or the area vanishes, so that no query divides by zero.
  all.first = child - kLeaf;
  all.end = all.first + 1;
  Leaf& leaf = leaves_[child - kLeaf];
  const auto inverse = [](double x) { return x > 0 ? 1 / x : 0; };
  for (std::size_t i = 0; i < kWide; ++i) {
    const std::size_t entry = (child - kLeaf) * std::size_t{kWide} + i;
    const Corners& corners = triangles[order_[entry]];
    const Vec3 &a = positions[corners[0]], &b = positions[corners[1]], &c = positions[corners[2]];
    const Vec3 ab = b - a, ac = c - a, normal = cross(ab, ac);
    places_[entry] = {a, b, c};
    put(leaf.a, i, a);
    put(leaf.ab, i, ab);
    put(leaf.ac, i, ac);
    leaf.abab[i] = dot(ab, ab);
    leaf.abac[i] = dot(ab, ac);
    leaf.acac[i] = dot(ac, ac);
    leaf.perAb[i] = inverse(dot(ab, ab));
    leaf.perAc[i] = inverse(dot(ac, ac));
    leaf.perBc[i] = inverse(dot(c - b, c - b));
    leaf.perArea[i] = inverse(dot(normal, normal));
    for (const Vec3& p : {a, b, c}) box.include(p);
  }
  return all;
}

// These loops have no branch, only selections, so that compilers turn the lanes into vector instructions.
ARETE_VECTOR_CLONES
void TriangleBvh::squaresOf(const Node& node, const Vec3& p, Lanes& to) {
  for (std::size_t i = 0; i < kWide; ++i) {
    double squared = 0;
    const std::array<double, 3> at = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double below = node.low[k][i] - at[k], above = at[k] - node.high[k][i];
      double beyond = below > above ? below : above;
      beyond = beyond > 0 ? beyond : 0;
      squared += beyond * beyond;
    }
    to[i] = squared;
  }
}

ARETE_VECTOR_CLONES
void TriangleBvh::raise(const Aslant& boxes, const Vec3& p, Lanes& squares) {
  for (std::size_t i = 0; i < kWide; ++i) {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = boxes.axes[k][0][i] * p.x + boxes.axes[k][1][i] * p.y + boxes.axes[k][2][i] * p.z;
      const double below = boxes.low[k][i] - at, above = at - boxes.high[k][i];
      double beyond = below > above ? below : above;
      beyond = beyond > 0 ? beyond : 0;
      squared += beyond * beyond;
    }
    squares[i] = squares[i] > squared ? squares[i] : squared;
  }
}

// A lane gets the least distance to the three sides, or the distance to the plane where the foot lies inside.
// A triangle without area has a foot with weights 0, which is not inside, and is left to its sides.
ARETE_VECTOR_CLONES
void TriangleBvh::squaresOf(const Leaf& leaf, const Vec3& p, Lanes& to) {
  for (std::size_t i = 0; i < kWide; ++i) {
    const double x = p.x - leaf.a[0][i], y = p.y - leaf.a[1][i], z = p.z - leaf.a[2][i];
    const double bx = leaf.ab[0][i], by = leaf.ab[1][i], bz = leaf.ab[2][i];
    const double cx = leaf.ac[0][i], cy = leaf.ac[1][i], cz = leaf.ac[2][i];
    const double d = bx * x + by * y + bz * z, e = cx * x + cy * y + cz * z;
    const auto squareAt = [&](double v, double w) {
      const double rx = x - v * bx - w * cx, ry = y - v * by - w * cy, rz = z - v * bz - w * cz;
      return rx * rx + ry * ry + rz * rz;
    };
    const auto clamped = [](double s) {
      s = s > 0 ? s : 0;
      return s < 1 ? s : 1;
    };
    const double onAb = squareAt(clamped(d * leaf.perAb[i]), 0),
                 onAc = squareAt(0, clamped(e * leaf.perAc[i]));
    const double w = clamped((e - d + leaf.abab[i] - leaf.abac[i]) * leaf.perBc[i]),
                 onBc = squareAt(1 - w, w);
    const double v0 = (leaf.acac[i] * d - leaf.abac[i] * e) * leaf.perArea[i],
                 w0 = (leaf.abab[i] * e - leaf.abac[i] * d) * leaf.perArea[i], inPlane = squareAt(v0, w0);
    double least = onAb < onAc ? onAb : onAc;
    least = least < onBc ? least : onBc;
    double lowest = v0 < w0 ? v0 : w0;
    lowest = lowest < 1 - v0 - w0 ? lowest : 1 - v0 - w0;
    const double inside = lowest > 0 ? inPlane : kInfinity;
    to[i] = least < inside ? least : inside;
  }
}

TriangleBvh::Answer TriangleBvh::nearest(const Vec3& p, std::uint32_t guess) const {
  std::uint32_t best = 0;  // an entry
  double least = kInfinity;
  Lanes squares;
  const auto search = [&](std::uint32_t leaf) {
    squaresOf(leaves_[leaf], p, squares);
    for (std::uint32_t i = 0; i < kWide; ++i)
      if (squares[i] < least) {
        least = squares[i];
        best = leaf * kWide + i;
      }
  };
  const std::uint32_t begun = guess == kNone ? kNone : entryOf_[guess] / kWide;
  if (begun != kNone) {
    best = entryOf_[guess];
    search(begun);
  }
  struct Open {
    double squared;
    std::uint32_t child;
  };
  std::uint32_t looks = 0;
  // At most 7 wait at each of 22 levels: a child has at most (7 / 8)^7 of what its parent has.
  std::array<Open, 192> stack;
  std::size_t size = 0;
  stack[size++] = {0, root_};
  while (size > 0) {
    const Open at = stack[--size];
    if (!(at.squared < least)) continue;
    ++looks;
    if (at.child >= kLeaf) {
      if (at.child - kLeaf != begun) search(at.child - kLeaf);
      continue;
    }
    const Node& node = nodes_[at.child];
    squaresOf(node, p, squares);
    if (node.aslant != kNone) raise(aslant_[node.aslant], p, squares);
    const std::size_t first = size;
    for (std::size_t i = 0; i < kWide; ++i) {
      if (!(squares[i] < least)) continue;
      // The nearest one on top.
      std::size_t to = size++;
      for (; to > first && stack[to - 1].squared < squares[i]; --to) stack[to] = stack[to - 1];
      stack[to] = {squares[i], node.child[i]};
    }
  }
  Answer answer{order_[best], nearestWithShares(p, places_[best]), 0, looks};
  answer.squaredDistance = squaredDistance(p, answer.point.place);
  return answer;
}

}  // namespace arete
