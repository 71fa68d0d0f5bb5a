// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sides at an edge of more than two triangles are paired into sheets (sheet_pairs.h); one without a
// partner gets a border. Then the corners at a vertex that sheets join keep one vertex, and each further
// group of corners gets a copy.
//
// Sheets that meet again around both ends of an edge would keep it one, as the two sides of a card do along
// an edge from border to border. There the edge is paired another way, which cuts the card along it.
#include <algorithm>
#include <array>
#include <utility>

#include "surface/repair/draft.h"
#include "surface/repair/sheet_pairs.h"
#include "surface/topology/disjoint_sets.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {
namespace {

constexpr std::array kPairings = {SheetPairing::solids, SheetPairing::twins, SheetPairing::spaces};

/// An edge of more than two triangles, and how its sides are paired.
struct WideEdge {
  std::size_t edge;
  std::size_t pairing = 0;  ///< of kPairings
  std::vector<std::pair<CornerId, CornerId>> pairs = {};
};

std::uint64_t countWide(const TriangleMesh& mesh) {
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  std::uint64_t wide = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) wide += edges[e].isManifold() ? 0 : 1;
  return wide;
}

/// The corners that stay one vertex.
class Groups {
 public:
  explicit Groups(const Draft& draft)
      : mesh_(draft.mesh),
        edges_(mesh_.triangles, mesh_.positions.size()),
        sets_(3 * mesh_.triangles.size()) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (!edges_[e].isManifold()) {
        wide_.push_back({e});
        pair(wide_.back());
      }
    if (wide_.empty()) return;
    joinAll();
    while (pairAnotherWay()) joinAll();
  }

  const MeshEdges& edges() const { return edges_; }
  const std::vector<WideEdge>& wide() const { return wide_; }
  std::uint32_t find(std::uint32_t corner) { return sets_.find(corner); }

 private:
  void pair(WideEdge& wide) const {
    const MeshEdges::Edge edge = edges_[wide.edge];
    std::vector<SheetSide> sides;
    for (const CornerId side : edge.sides)
      sides.push_back({side, mesh_.positions[edges_.origin(previousCorner(side)).index()],
                       edges_.origin(side) == edge.low});
    wide.pairs = pairSheets(mesh_.positions[edge.low.index()], mesh_.positions[edge.high.index()], sides,
                            kPairings[wide.pairing]);
  }

  void join(CornerId a, CornerId b) {
    const bool areOpposed = edges_.areOpposed(a, b);
    sets_.unite(a.index(), (areOpposed ? nextCorner(b) : b).index());
    sets_.unite(nextCorner(a).index(), (areOpposed ? b : nextCorner(b)).index());
  }

  void joinAll() {
    sets_ = DisjointSets(3 * mesh_.triangles.size());
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (const MeshEdges::Edge edge = edges_[e]; edge.sides.size() == 2) join(edge.sides[0], edge.sides[1]);
    for (const WideEdge& wide : wide_)
      for (const auto& [a, b] : wide.pairs) join(a, b);
  }

  /// The groups of the two ends of a side.
  std::array<std::uint32_t, 2> endsOf(CornerId side, VertexId low) {
    const std::uint32_t from = sets_.find(side.index()), to = sets_.find(nextCorner(side).index());
    return edges_.origin(side) == low ? std::array{from, to} : std::array{to, from};
  }

  /// Whether more than two sides of an edge keep both ends in common.
  bool staysWide(const WideEdge& wide) {
    const MeshEdges::Edge edge = edges_[wide.edge];
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const CornerId side : edge.sides) ends.push_back(endsOf(side, edge.low));
    std::ranges::sort(ends);
    for (std::size_t i = 2; i < ends.size(); ++i)
      if (ends[i] == ends[i - 2]) return true;
    return false;
  }

  /// Pairs the edges that stay wide in the next way. False if there is none.
  bool pairAnotherWay() {
    std::vector<WideEdge*> changed;
    for (WideEdge& wide : wide_)
      if (wide.pairing + 1 < kPairings.size() && staysWide(wide)) changed.push_back(&wide);
    for (WideEdge* const wide : changed) {
      ++wide->pairing;
      pair(*wide);
    }
    return !changed.empty();
  }

  const TriangleMesh& mesh_;
  const MeshEdges edges_;
  DisjointSets sets_;
  std::vector<WideEdge> wide_;
};

}  // namespace

void splitSheets(Draft& draft) {
  auto& triangles = draft.mesh.triangles;
  std::vector<std::uint32_t> vertexOfCorner(3 * triangles.size());
  std::uint64_t wideBefore = 0;
  {
    Groups groups(draft);
    wideBefore = groups.wide().size();
    if (wideBefore == 0) return;
    // A vertex away from such edges stays as it is, however its triangles meet.
    std::vector<std::uint8_t> isConcerned(draft.mesh.positions.size(), 0);
    for (const WideEdge& wide : groups.wide()) {
      const MeshEdges::Edge edge = groups.edges()[wide.edge];
      isConcerned[edge.low.index()] = isConcerned[edge.high.index()] = 1;
    }
    std::vector<std::uint8_t> isTaken(draft.mesh.positions.size(), 0);
    for (std::uint32_t c = 0; c < vertexOfCorner.size(); ++c) {
      const std::uint32_t v = groups.edges().origin(CornerId(c)).index(), first = groups.find(c);
      if (isConcerned[v] == 0) {
        vertexOfCorner[c] = v;
      } else if (first != c) {
        vertexOfCorner[c] = vertexOfCorner[first];
      } else if (isTaken[v] == 0) {
        isTaken[v] = 1;
        vertexOfCorner[c] = v;
      } else {
        vertexOfCorner[c] = draft.copyVertex(v);
        ++draft.counts.addedVertices;
      }
    }
  }
  for (std::size_t c = 0; c < vertexOfCorner.size(); ++c) triangles[c / 3][c % 3] = vertexOfCorner[c];
  // An edge whose sheets meet again around both of its ends, however they are paired, stays one.
  draft.counts.splitSheetEdges += wideBefore - countWide(draft.mesh);
}

}  // namespace arete::repair_passes
