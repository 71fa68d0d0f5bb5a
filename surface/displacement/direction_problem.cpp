// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/displacement/direction_problem.h"

#include <algorithm>

#include "surface/algebra/conjugate_gradients.h"

namespace arete {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
/// The weight of |d|^2 beside a vertex's own samples: what they do not hold stays short.
constexpr double kStiffness = 1e-3;
constexpr int kMostSteps = 100;
constexpr double kAccuracy = 1e-3;

}  // namespace

// The edges of the root belong to no slot and have blocks of their own, found by halving in a sorted list.
DirectionProblem::DirectionProblem(const MultiTriangulation& mt)
    : mt_(mt),
      diagonal_(mt.vertexCount(), Symmetric3::Zero()),
      right_(Eigen::Matrix3Xd::Zero(3, mt.vertexCount())),
      ofSlot_(mt.slotTotal(), Block::Zero()) {
  for (const auto& t : mt.rootTriangles())
    for (std::size_t i = 0; i < 3; ++i)
      rootEdges_.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::ranges::sort(rootEdges_);
  const auto last = std::unique(rootEdges_.begin(), rootEdges_.end());
  rootEdges_.erase(last, rootEdges_.end());
  ofRootEdge_.assign(rootEdges_.size(), Block::Zero());
}

/// A displacement is the mean of the corners' directions with the shares, so the block of two corners has the
/// product of their shares.
void DirectionProblem::Part::add(const std::array<double, 3>& shares, const Symmetric3& metric,
                                 const Vec3& residual) {
  const Eigen::Vector3d pull = unpacked(metric) * toEigen(residual);
  for (std::size_t b = 0; b < 6; ++b) blocks[b] += shares[kPairs[b][0]] * shares[kPairs[b][1]] * metric;
  for (Eigen::Index c = 0; c < 3; ++c) right.col(c) += shares[static_cast<std::size_t>(c)] * pull;
}

// The higher vertex of an edge is the younger one: the lower one is in the link of its node, or both are of
// the root.
DirectionProblem::Block& DirectionProblem::blockOf(std::uint32_t a, std::uint32_t b) {
  const auto [low, high] = std::minmax(a, b);
  if (high < mt_.rootVertexCount())
    return ofRootEdge_[static_cast<std::size_t>(std::ranges::lower_bound(rootEdges_, RootEdge{low, high}) -
                                                rootEdges_.begin())];
  const NodeId n(high - mt_.rootVertexCount());
  const auto link = mt_.link(n);
  return ofSlot_[mt_.firstSlot(n) + static_cast<std::size_t>(std::ranges::find(link, low) - link.begin())];
}

void DirectionProblem::add(const std::array<std::uint32_t, 3>& corners, const Part& part) {
  for (std::size_t c = 0; c < 3; ++c) {
    diagonal_[corners[c]] += part.blocks[c];
    right_.col(corners[c]) += part.right.col(static_cast<Eigen::Index>(c));
    blockOf(corners[c], corners[(c + 1) % 3]) += part.blocks[3 + c].cast<float>();
  }
}

// The matrix is symmetric and each block is kept once, so it counts for both of its vertices.
void DirectionProblem::multiply(std::span<const Symmetric3> diagonal, const Eigen::Matrix3Xd& x,
                                Eigen::Matrix3Xd& y) const {
  for (std::size_t v = 0; v < diagonal.size(); ++v) {
    const auto column = static_cast<Eigen::Index>(v);
    y.col(column) = unpacked(diagonal[v]) * x.col(column);
  }
  const auto across = [&](const Block& block, std::uint32_t a, std::uint32_t b) {
    const Eigen::Matrix3d m = unpacked(block);
    y.col(a) += m * x.col(b);
    y.col(b) += m * x.col(a);
  };
  for (std::size_t e = 0; e < rootEdges_.size(); ++e)
    across(ofRootEdge_[e], rootEdges_[e][0], rootEdges_[e][1]);
  for (std::uint32_t n = 0; n < mt_.nodeCount(); ++n) {
    const std::uint32_t apex = mt_.apex(NodeId(n)).index(), begin = mt_.firstSlot(NodeId(n));
    const auto link = mt_.link(NodeId(n));
    for (std::size_t i = 0; i < link.size(); ++i) across(ofSlot_[begin + i], apex, link[i]);
  }
}

// Every diagonal block is made a little stiffer, and an empty one becomes the identity, so that the problem
// has one solution.
std::vector<Vec3> DirectionProblem::solve() const {
  BlockMatrix matrix;
  matrix.diagonal = diagonal_;
  for (Symmetric3& d : matrix.diagonal) {
    const double trace = d[0] + d[3] + d[5];
    d += (trace > 0 ? kStiffness * trace / 3 : 1) * identity3();
  }
  matrix.multiply = [&](const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) { multiply(matrix.diagonal, x, y); };
  return conjugateGradients(matrix, right_, kAccuracy, kMostSteps);
}

}  // namespace arete
