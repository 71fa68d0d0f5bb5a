// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is in the front when its creator is in the cut and its remover is not: one test per slot of the
// cut's nodes, no graph walk. Nodes are handled in blocks: a first pass counts what each block will write, a
// prefix sum gives every block its place, a second pass writes. The order is that of the triangle ids,
// whatever the thread count.
//
// Every vertex that a node of the cut inserts is in the front, so the front's vertices are the root's and one
// per node: the prefix itself for a prefix cut, the ranks of the members otherwise.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "engine/cut.h"

namespace arete {
namespace {

constexpr std::uint32_t kNodesPerBlock = 4096;

/// isIn(n): node n is in the cut. rank(v): place of MT vertex v among the front's vertices.
template <class IsIn, class Rank>
void writeFront(const MultiTriangulation& mt, std::uint32_t nodeEnd, const IsIn& isIn, const Rank& rank,
                Cut& cut) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount();
  const auto isKept = [&](std::uint32_t id) {
    const std::uint32_t r = a.remover[id];
    return r >= nodeEnd || !isIn(r);  // kNone is beyond every node
  };
  const std::uint32_t blocks = (nodeEnd + kNodesPerBlock - 1) / kNodesPerBlock;
  std::vector<std::uint32_t> begin(std::size_t(blocks) + 2, 0);
  for (std::uint32_t t = 0; t < roots; ++t) begin[1] += isKept(t) ? 1 : 0;
  tbb::parallel_for(std::uint32_t(0), blocks, [&](std::uint32_t b) {
    std::uint32_t count = 0;
    for (std::uint32_t n = b * kNodesPerBlock; n < std::min(nodeEnd, (b + 1) * kNodesPerBlock); ++n) {
      if (!isIn(n)) continue;
      for (std::uint32_t s = a.slotBegin[n]; s < a.slotBegin[n + 1]; ++s) count += isKept(roots + s) ? 1 : 0;
    }
    begin[b + 2] = count;
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  cut.triangles.resize(begin.back());
  cut.ids.resize(begin.back());
  std::vector<std::uint16_t> worst(std::size_t(blocks) + 1, 0);

  std::uint32_t at = 0;
  for (std::uint32_t t = 0; t < roots; ++t) {
    if (!isKept(t)) continue;
    const auto& c = a.rootTriangles[t];
    cut.triangles[at] = {rank(c[0]), rank(c[1]), rank(c[2])};
    cut.ids[at++] = t;
    worst[0] = std::max(worst[0], a.error[t]);
  }
  tbb::parallel_for(std::uint32_t(0), blocks, [&](std::uint32_t b) {
    std::uint32_t to = begin[b + 1];
    std::uint16_t blockWorst = 0;
    for (std::uint32_t n = b * kNodesPerBlock; n < std::min(nodeEnd, (b + 1) * kNodesPerBlock); ++n) {
      if (!isIn(n)) continue;
      const std::uint32_t first = a.slotBegin[n], last = a.slotBegin[n + 1] - 1;
      const std::uint32_t apex = rank(a.rootVertices + n);
      for (std::uint32_t s = first; s <= last; ++s) {
        if (!isKept(roots + s)) continue;
        cut.triangles[to] = {apex, rank(a.link[s]), rank(a.link[s < last ? s + 1 : first])};
        cut.ids[to++] = roots + s;
        blockWorst = std::max(blockWorst, a.error[roots + s]);
      }
    }
    worst[b + 1] = blockWorst;
  });
  cut.achievedError = a.scale.decode(*std::max_element(worst.begin(), worst.end()));
}

}  // namespace

Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes) {
  Cut cut;
  cut.nodes = nodes;
  cut.vertices.resize(std::size_t(mt.rootVertexCount()) + nodes);
  std::iota(cut.vertices.begin(), cut.vertices.end(), 0u);
  // A slot that is no triangle is removed by its own creator, which is in the prefix.
  writeFront(
      mt, nodes, [](std::uint32_t) { return true; }, [](std::uint32_t v) { return v; }, cut);
  return cut;
}

Cut front(const MultiTriangulation& mt, const NodeSet& closed) {
  const std::uint32_t roots = mt.rootVertexCount();
  Cut cut;
  cut.vertices.resize(roots);
  std::iota(cut.vertices.begin(), cut.vertices.end(), 0u);
  std::vector<std::uint32_t> rankOfNode(closed.size());
  for (std::uint32_t n = 0; n < closed.size(); ++n) {
    rankOfNode[n] = static_cast<std::uint32_t>(cut.vertices.size());
    if (closed[n]) cut.vertices.push_back(roots + n);
  }
  cut.nodes = static_cast<std::uint32_t>(cut.vertices.size()) - roots;
  writeFront(
      mt, mt.nodeCount(), [&](std::uint32_t n) { return closed[n] != 0; },
      [&](std::uint32_t v) { return v < roots ? v : rankOfNode[v - roots]; }, cut);
  return cut;
}

}  // namespace arete
