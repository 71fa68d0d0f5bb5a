// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fan has two ends at most, so at most two border sides: the fans and the border sides form paths and
// cycles. Paths are walked from their ends first; what is left are cycles.
#include "surface/topology/border_loops.h"

#include <algorithm>
#include <array>

namespace arete {
namespace {

class Walker {
 public:
  Walker(const MeshEdges& edges, const MeshFans& fans) : fans_(fans), sidesAt_(fans.vertexOf.size()) {
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].isBorder()) borders_.push_back(edges[e].sides[0]);
    std::ranges::sort(borders_);
    for (const CornerId side : borders_) {
      put(first(side), side);
      put(last(side), side);
    }
    isTaken_.resize(fans.fanOf.size(), 0);
  }

  std::vector<BorderLoop> run() {
    std::vector<BorderLoop> loops;
    for (const CornerId side : borders_) {
      if (isTaken_[side.index()] != 0) continue;
      if (other(first(side), side).isValid() && other(last(side), side).isValid()) continue;
      loops.push_back(walk(side, other(first(side), side).isValid() ? last(side) : first(side)));
      loops.back().isClosed = false;
    }
    for (const CornerId side : borders_)
      if (isTaken_[side.index()] == 0) loops.push_back(walk(side, first(side)));
    std::ranges::sort(loops, {}, [](const BorderLoop& loop) { return std::ranges::min(loop.sides); });
    return loops;
  }

 private:
  FanId first(CornerId side) const { return fans_.fanOf[side.index()]; }
  FanId last(CornerId side) const { return fans_.fanOf[nextCorner(side).index()]; }
  void put(FanId fan, CornerId side) {
    auto& [a, b] = sidesAt_[fan.index()];
    (a.isValid() ? b : a) = side;
  }
  CornerId other(FanId fan, CornerId side) const {
    const auto& [a, b] = sidesAt_[fan.index()];
    return a == side ? b : a;
  }
  /// The sides from one on, which is entered at a fan of its own.
  BorderLoop walk(CornerId side, FanId entered) {
    BorderLoop loop;
    while (side.isValid() && isTaken_[side.index()] == 0) {
      isTaken_[side.index()] = 1;
      loop.sides.push_back(side);
      entered = first(side) == entered ? last(side) : first(side);
      side = other(entered, side);
    }
    return loop;
  }

  const MeshFans& fans_;
  std::vector<std::array<CornerId, 2>> sidesAt_;  // by fan
  std::vector<CornerId> borders_;
  std::vector<std::uint8_t> isTaken_;  // by side
};

}  // namespace

std::vector<BorderLoop> findBorderLoops(const MeshEdges& edges, const MeshFans& fans) {
  return Walker(edges, fans).run();
}

}  // namespace arete
