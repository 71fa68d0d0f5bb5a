// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of the vertices are a tree of boxes, halved along their widest axis. An edge descends into
// the boxes that it passes within the distance, not into those that only its own box meets: edges that run
// far across the mesh meet few. The distance is that of a point from a segment in doubles, so that it is
// certain to a few ulps of the coordinates.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/per_thread.h"
#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

bool isInside(const Vec3& p, const Vec3& a, const Vec3& b, double distance) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  if (!(squared > 0)) return false;
  const double t = std::clamp(dot(p - a, along) / squared, 0.0, 1.0);
  return norm(p - (a + along * t)) <= distance && norm(p - a) > distance && norm(p - b) > distance;
}

class PlaceTree {
 public:
  /// @param vertices at different positions; their order numbers the places. Outlive this.
  /// @param reach how far from a segment its candidates may be.
  PlaceTree(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices, double reach)
      : positions_(positions), vertices_(vertices), order_(vertices.size()), reach_(reach) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, order_.size());
  }

  template <class Visit>
  void visitNear(const Vec3& a, const Vec3& b, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, 0, order_.size(), a, b, visit);
  }

 private:
  static constexpr std::size_t kLeaf = 8;
  struct Node {
    std::array<double, 3> low, high;
    std::size_t second;  ///< the node of the upper half; that of the lower one is the next
  };

  static std::array<double, 3> coordinates(const Vec3& p) { return {p.x, p.y, p.z}; }
  std::array<double, 3> coordinates(std::uint32_t place) const {
    return coordinates(positions_[vertices_[place]]);
  }
  std::array<double, 3> placeAt(std::size_t i) const { return coordinates(order_[i]); }

  void build(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Node node{placeAt(begin), placeAt(begin), 0};
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<double, 3> p = placeAt(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.low[axis] = std::min(node.low[axis], p[axis]);
        node.high[axis] = std::max(node.high[axis], p[axis]);
      }
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return;
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (node.high[axis] - node.low[axis] > node.high[widest] - node.low[widest]) widest = axis;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t v, std::uint32_t w) {
      const double x = coordinates(v)[widest], y = coordinates(w)[widest];
      return x != y ? x < y : v < w;
    });
    build(begin, middle);
    nodes_[number].second = nodes_.size();
    build(middle, end);
  }

  /// Whether a segment passes a box within the reach. Where differences overflow, it does.
  bool passes(const Node& node, const std::array<double, 3>& a, const std::array<double, 3>& b) const {
    double from = 0, to = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = node.low[axis] - reach_, high = node.high[axis] + reach_, way = b[axis] - a[axis];
      if (way == 0) {
        if (a[axis] < low || a[axis] > high) return false;
        continue;
      }
      const double s = (low - a[axis]) / way, t = (high - a[axis]) / way;
      const double enters = way > 0 ? s : t, leaves = way > 0 ? t : s;
      if (enters > from) from = enters;
      if (leaves < to) to = leaves;
      if (from > to) return false;
    }
    return true;
  }

  template <class Visit>
  void descend(std::size_t number, std::size_t begin, std::size_t end, const Vec3& a, const Vec3& b,
               const Visit& visit) const {
    if (!passes(nodes_[number], coordinates(a), coordinates(b))) return;
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) visit(order_[i]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    descend(number + 1, begin, middle, a, b, visit);
    descend(nodes_[number].second, middle, end, a, b, visit);
  }

  std::span<const Vec3> positions_;
  std::span<const std::uint32_t> vertices_;
  std::vector<std::uint32_t> order_;  // of places, as the nodes have them
  double reach_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<TJunction> findTJunctions(std::span<const Vec3> positions,
                                      std::span<const std::array<std::uint32_t, 2>> edges,
                                      std::span<const std::uint32_t> vertices, double distance) {
  // Vertices at one position stand side by side, and the first of them in the tree.
  std::vector<std::uint32_t> sorted(vertices.begin(), vertices.end());
  const auto key = [&](std::uint32_t v) {
    return std::tuple(positions[v].x, positions[v].y, positions[v].z);
  };
  std::ranges::sort(sorted, {}, [&](std::uint32_t v) { return std::tuple_cat(key(v), std::tuple(v)); });
  std::vector<std::uint32_t> places, firstOf;
  double largest = 0;
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    const Vec3& p = positions[sorted[i]];
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (i > 0 && positions[sorted[i - 1]] == p) continue;
    firstOf.push_back(i);
    places.push_back(sorted[i]);
  }
  firstOf.push_back(static_cast<std::uint32_t>(sorted.size()));

  constexpr double kRounding = 16 * 0x1p-52;
  const PlaceTree tree(positions, places, distance + kRounding * largest);
  PerThread<std::vector<TJunction>> found;
  parallelFor(IndexRange<std::size_t>(0, edges.size(), 256), [&](const auto& range) {
    std::vector<TJunction>& here = found.local();
    for (std::size_t e = range.begin(); e < range.end(); ++e) {
      const auto [low, high] = edges[e];
      const Vec3 &a = positions[low], &b = positions[high];
      tree.visitNear(a, b, [&, low = low, high = high](std::uint32_t place) {
        if (isInside(positions[places[place]], a, b, distance))
          for (std::uint32_t i = firstOf[place]; i < firstOf[place + 1]; ++i)
            here.push_back({sorted[i], low, high});
      });
    }
  });
  std::vector<TJunction> all;
  for (const std::vector<TJunction>& some : found) all.insert(all.end(), some.begin(), some.end());
  std::ranges::sort(all);
  return all;
}

}  // namespace arete::diagnosis
