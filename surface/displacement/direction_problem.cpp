// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/displacement/direction_problem.h"

#include <algorithm>

#include "engine/base/conjugate_gradients.h"

namespace arete {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
/// The weight of |d|^2 beside a vertex's own samples: what they do not hold stays short.
constexpr double kStiffness = 1e-3;
constexpr int kMostSteps = 100;
constexpr double kAccuracy = 1e-3;

Vec3 times(const std::array<float, 6>& m, const Vec3& v) {
  return arete::times(Symmetric3{m[0], m[1], m[2], m[3], m[4], m[5]}, v);
}

}  // namespace

DirectionProblem::DirectionProblem(const MultiTriangulation& mt)
    : mt_(mt),
      diagonal_(mt.vertexCount(), Symmetric3{}),
      right_(mt.vertexCount(), Vec3{0, 0, 0}),
      ofSlot_(mt.slotTotal(), Block{}) {
  for (const auto& t : mt.rootTriangles())
    for (std::size_t i = 0; i < 3; ++i)
      rootEdges_.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::ranges::sort(rootEdges_);
  const auto last = std::unique(rootEdges_.begin(), rootEdges_.end());
  rootEdges_.erase(last, rootEdges_.end());
  ofRootEdge_.assign(rootEdges_.size(), Block{});
}

void DirectionProblem::Part::add(const std::array<double, 3>& shares, const Symmetric3& metric,
                                 const Vec3& residual) {
  const Vec3 pull = arete::times(metric, residual);
  for (std::size_t b = 0; b < 6; ++b) {
    const double weight = shares[kPairs[b][0]] * shares[kPairs[b][1]];
    for (std::size_t k = 0; k < 6; ++k) blocks[b][k] += weight * metric[k];
  }
  for (std::size_t c = 0; c < 3; ++c) right[c] = right[c] + shares[c] * pull;
}

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
    for (std::size_t k = 0; k < 6; ++k) diagonal_[corners[c]][k] += part.blocks[c][k];
    right_[corners[c]] = right_[corners[c]] + part.right[c];
    Block& block = blockOf(corners[c], corners[(c + 1) % 3]);
    for (std::size_t k = 0; k < 6; ++k) block[k] += static_cast<float>(part.blocks[3 + c][k]);
  }
}

void DirectionProblem::multiply(std::span<const Symmetric3> diagonal, std::span<const Vec3> x,
                                std::span<Vec3> y) const {
  for (std::size_t v = 0; v < x.size(); ++v) y[v] = arete::times(diagonal[v], x[v]);
  const auto across = [&](const Block& block, std::uint32_t a, std::uint32_t b) {
    y[a] = y[a] + times(block, x[b]);
    y[b] = y[b] + times(block, x[a]);
  };
  for (std::size_t e = 0; e < rootEdges_.size(); ++e)
    across(ofRootEdge_[e], rootEdges_[e][0], rootEdges_[e][1]);
  for (std::uint32_t n = 0; n < mt_.nodeCount(); ++n) {
    const std::uint32_t apex = mt_.apex(NodeId(n)).index(), begin = mt_.firstSlot(NodeId(n));
    const auto link = mt_.link(NodeId(n));
    for (std::size_t i = 0; i < link.size(); ++i) across(ofSlot_[begin + i], apex, link[i]);
  }
}

std::vector<Vec3> DirectionProblem::solve() const {
  const std::size_t size = right_.size();
  std::vector<Symmetric3> diagonal = diagonal_, preconditioner(size);
  for (std::size_t v = 0; v < size; ++v) {
    Symmetric3& d = diagonal[v];
    const double trace = d[0] + d[3] + d[5], more = trace > 0 ? kStiffness * trace / 3 : 1;
    for (const std::size_t k : {0, 3, 5}) d[k] += more;
    preconditioner[v] = inverse(d);
  }
  return conjugateGradients([&](std::span<const Vec3> x, std::span<Vec3> y) { multiply(diagonal, x, y); },
                            preconditioner, right_, kAccuracy, kMostSteps);
}

}  // namespace arete
