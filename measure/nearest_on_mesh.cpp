// SPDX-License-Identifier: GPL-3.0-or-later
//
// A binary tree of boxes, of which the nearest is opened next until none is nearer than the best triangle so
// far. A search in depth would look, in a part where the nearest point is a vertex of n triangles, at all n
// before it comes to the right part. Plain boxes of long triangles that lie aslant overlap each other, so
// that around a vertex of n triangles a query would look at n of them: such nodes have an oriented box beside
// the plain one. Triangles are parted in the middle of the longest side of the six-dimensional box of their
// boxes' corners, by which long ones side by side stay together and others do not come between them; at the
// median [GoldsmithSalmon1987] where that has made the tree deep.
#include "measure/nearest_on_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/oriented_box.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr std::size_t kMostInLeaf = 2;
constexpr std::uint32_t kMostUneven = 64;  // levels
/// The low and the high corner of a triangle's box.
using Corners = std::array<double, 6>;

double squaredDistanceTo(const Box3& box, const Vec3& p) {
  const double x = std::max({box.low.x - p.x, 0.0, p.x - box.high.x}),
               y = std::max({box.low.y - p.y, 0.0, p.y - box.high.y}),
               z = std::max({box.low.z - p.z, 0.0, p.z - box.high.z});
  return x * x + y * y + z * z;
}

}  // namespace

struct NearestOnMesh::Tree {
  struct Node {
    Box3 box = Box3::empty();
    std::uint32_t first = 0, count = 0;  // triangles, in the tree's order
    std::uint32_t right = kNone;         // the left child follows its parent; kNone: a leaf
    std::uint32_t oriented = kNone;      // of oriented
  };
  std::vector<SpaceTriangle> triangles;
  std::vector<std::uint32_t> ids;
  std::vector<Node> nodes;
  std::vector<OrientedBox> oriented;

  double squaredDistance(std::uint32_t node, const Vec3& p, double least) const {
    const double plain = squaredDistanceTo(nodes[node].box, p);
    if (!(plain < least) || nodes[node].oriented == kNone) return plain;
    return std::max(plain, oriented[nodes[node].oriented].squaredDistance(p));
  }

  /// @param range  of ids; their order becomes the tree's
  std::uint32_t build(std::span<std::uint32_t> range, std::span<const Corners> corners,
                      std::span<const SpaceTriangle> all, std::uint32_t depth) {
    const auto node = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    const auto first = static_cast<std::uint32_t>(range.data() - ids.data());
    std::uint32_t right = kNone;
    Box3 box = Box3::empty();
    if (range.size() > kMostInLeaf) {
      const std::size_t some = part(range, corners, depth < kMostUneven);
      const std::uint32_t left = build(range.first(some), corners, all, depth + 1);
      right = build(range.subspan(some), corners, all, depth + 1);
      for (const std::uint32_t child : {left, right}) {
        box.include(nodes[child].box.low);
        box.include(nodes[child].box.high);
      }
    } else {
      for (std::size_t i = 0; i < range.size(); ++i) {
        triangles[first + i] = all[range[i]];
        for (const Vec3& p : all[range[i]]) box.include(p);
      }
    }
    std::uint32_t number = kNone;
    if (const auto aslant = orientedBoxOf(std::span(triangles).subspan(first, range.size()), box)) {
      number = static_cast<std::uint32_t>(oriented.size());
      oriented.push_back(*aslant);
    }
    nodes[node] = {box, first, static_cast<std::uint32_t>(range.size()), right, number};
    return node;
  }

  /// @return how many are in the first part
  static std::size_t part(std::span<std::uint32_t> range, std::span<const Corners> corners,
                          bool mayBeUneven) {
    Corners low = corners[range[0]], high = low;
    for (const std::uint32_t t : range)
      for (std::size_t k = 0; k < low.size(); ++k) {
        low[k] = std::min(low[k], corners[t][k]);
        high[k] = std::max(high[k], corners[t][k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < low.size(); ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const double middle = std::midpoint(low[axis], high[axis]);
    if (mayBeUneven && middle < high[axis]) {
      const auto second = std::partition(range.begin(), range.end(),
                                         [&](std::uint32_t t) { return corners[t][axis] <= middle; });
      return static_cast<std::size_t>(second - range.begin());
    }
    const std::size_t half = range.size() / 2;
    std::ranges::nth_element(
        range, range.begin() + static_cast<std::ptrdiff_t>(half), [&](std::uint32_t s, std::uint32_t t) {
          return corners[s][axis] != corners[t][axis] ? corners[s][axis] < corners[t][axis] : s < t;
        });
    return half;
  }
};

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  std::vector<SpaceTriangle> all;
  std::vector<Corners> corners;
  for (const auto& [i, j, k] : mesh.triangles) {
    all.push_back({mesh.positions[i], mesh.positions[j], mesh.positions[k]});
    Box3 box = Box3::empty();
    for (const Vec3& p : all.back()) box.include(p);
    corners.push_back({box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z});
  }
  tree_->triangles.resize(all.size());
  tree_->ids.resize(all.size());
  std::iota(tree_->ids.begin(), tree_->ids.end(), 0u);
  tree_->build(tree_->ids, corners, all, 0);
}

NearestOnMesh::~NearestOnMesh() = default;

NearestOnMesh::Answer NearestOnMesh::nearest(const Vec3& p) const {
  const Tree& tree = *tree_;
  struct Open {
    double squared;
    std::uint32_t node;

    bool operator<(const Open& other) const {  // the nearest one is the largest
      return squared != other.squared ? squared > other.squared : node > other.node;
    }
  };
  std::vector<Open> open;
  open.reserve(64);
  open.push_back({0, 0});
  Answer answer;
  double least = std::numeric_limits<double>::infinity();
  while (!open.empty() && open.front().squared < least) {
    const Tree::Node& node = tree.nodes[open.front().node];
    const std::uint32_t left = open.front().node + 1;
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    ++answer.looks;
    if (node.right != kNone) {
      for (const std::uint32_t child : {left, node.right}) {
        const double squared = tree.squaredDistance(child, p, least);
        if (!(squared < least)) continue;
        open.push_back({squared, child});
        std::push_heap(open.begin(), open.end());
      }
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Vec3 point = nearestOnTriangle(p, tree.triangles[i]);
      const double squared = arete::squaredDistance(p, point);
      if (squared >= least) continue;
      least = squared;
      answer.point = point;
      answer.triangle = tree.ids[i];
    }
  }
  answer.distance = std::sqrt(least);
  return answer;
}

}  // namespace arete
