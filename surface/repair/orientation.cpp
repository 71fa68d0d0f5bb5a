// SPDX-License-Identifier: GPL-3.0-or-later
//
// In each patch, the part that edges of two triangles join, the turns agree once some of the triangles are
// turned, or all others. Of the two, a closed patch takes the one that its volume says: outwards, or inwards
// where it lies in an odd number of other closed patches and so is the wall of a cavity. Closed patches that
// cross each other are turned together, as the largest of them needs it. A patch with a border, or without a
// volume, as a sheet with two sides, keeps the turn of most of its triangles; of equally many, that of the
// first one. A patch that is not orientable stays as it is: whatever is turned, one of its edges would
// disagree.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "surface/repair/draft.h"
#include "surface/repair/nesting.h"
#include "surface/topology/components.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {
namespace {

class Orienting {
 public:
  Orienting(Draft& draft, const RepairOptions& options)
      : draft_(draft),
        options_(options),
        edges_(draft.mesh.triangles, draft.mesh.positions.size()),
        orientation_(edges_) {
    const std::size_t patches = orientation_.contradiction.size();
    size_.resize(patches, 0);
    turned_.resize(patches, 0);
    for (std::size_t t = 0; t < edges_.triangles().size(); ++t) {
      ++size_[orientation_.patchOf[t]];
      turned_[orientation_.patchOf[t]] += orientation_.isTurned[t];
    }
  }

  void run() {
    draft_.crossingParts = 0;
    const std::size_t patches = size_.size();
    // By patch: whether the triangles are turned that agree with its first one, or the others.
    std::vector<std::uint8_t> turnsFirst(patches);
    for (std::size_t p = 0; p < patches; ++p) turnsFirst[p] = 2 * turned_[p] > size_[p] ? 1 : 0;
    std::vector<std::uint8_t> mayTurn(patches, 0);
    for (std::uint32_t p = 0; p < patches; ++p)
      mayTurn[p] = orientation_.isOrientable(p, edges_) && (options_.turnsOutwards || turned_[p] > 0) ? 1 : 0;
    if (std::ranges::count(mayTurn, 1) > 0) {
      findClosed();
      decide(turnsFirst);
    }
    std::vector<std::uint32_t> toTurn;
    for (std::uint32_t t = 0; t < edges_.triangles().size(); ++t) {
      const std::uint32_t p = orientation_.patchOf[t];
      if (mayTurn[p] != 0 && (orientation_.isTurned[t] != 0) != (turnsFirst[p] != 0)) toTurn.push_back(t);
    }
    for (const std::uint32_t t : toTurn) draft_.turn(t);
    count();
  }

 private:
  /// The orientable patches without a border: along each of their edges, as many sides run forward as
  /// backward once the turns agree. Those with a volume are closed parts.
  void findClosed() {
    std::vector<std::uint8_t> isClosed(size_.size(), 1);
    for (std::uint32_t p = 0; p < size_.size(); ++p)
      if (!orientation_.isOrientable(p, edges_)) isClosed[p] = 0;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const MeshEdges::Edge edge = edges_[e];
      if (edge.sides.size() == 2) continue;
      std::map<std::uint32_t, int> balance;
      for (const CornerId side : edge.sides) {
        const std::uint32_t t = triangleOf(side).index();
        const bool isForward = (edges_.origin(side) == edge.low) != (orientation_.isTurned[t] != 0);
        balance[orientation_.patchOf[t]] += isForward ? 1 : -1;
      }
      for (const auto& [patch, sum] : balance)
        if (sum != 0) isClosed[patch] = 0;
    }
    std::vector<std::uint32_t> partOf(size_.size(), RepairedMesh::kNone);
    std::vector<double> sum, largest;
    for (std::uint32_t t = 0; t < edges_.triangles().size(); ++t) {
      const std::uint32_t patch = orientation_.patchOf[t];
      if (isClosed[patch] == 0) continue;
      if (partOf[patch] == RepairedMesh::kNone) {
        partOf[patch] = static_cast<std::uint32_t>(parts_.size());
        patchOf_.push_back(patch);
        parts_.emplace_back();
        sum.push_back(0);
        largest.push_back(0);
      }
      add(parts_[partOf[patch]], t, sum[partOf[patch]], largest[partOf[patch]]);
    }
    // A volume that may be rounding alone does not count.
    std::vector<ClosedPart> kept;
    std::vector<std::uint32_t> keptPatch;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!(std::abs(sum[i]) > 1e-12 * largest[i])) continue;
      parts_[i].volume = std::abs(sum[i]) / 6;
      isPositive_.push_back(sum[i] > 0 ? 1 : 0);
      kept.push_back(std::move(parts_[i]));
      keptPatch.push_back(patchOf_[i]);
    }
    parts_ = std::move(kept);
    patchOf_ = std::move(keptPatch);
  }

  /// Adds a triangle to its part, and its volume about the part's first vertex, as it turns where the turns
  /// agree.
  void add(ClosedPart& part, std::uint32_t t, double& sum, double& largest) const {
    const auto& corners = edges_.triangles()[t];
    const auto& positions = draft_.mesh.positions;
    if (part.triangles.empty()) part.object = objectOf(t);
    part.triangles.push_back(t);
    for (const std::uint32_t v : corners) part.box.include(positions[v]);
    const Vec3& middle = positions[edges_.triangles()[part.triangles.front()][0]];
    const double sixfold = dot(positions[corners[0]] - middle,
                               cross(positions[corners[1]] - middle, positions[corners[2]] - middle));
    sum += orientation_.isTurned[t] != 0 ? -sixfold : sixfold;
    largest += std::abs(sixfold);
  }

  std::uint32_t objectOf(std::uint32_t t) const {
    const std::uint32_t source = draft_.triangleOf[t];
    return options_.partOf.empty() || source == RepairedMesh::kNone ? 0 : options_.partOf[source];
  }

  void decide(std::vector<std::uint8_t>& turnsFirst) {
    const Nesting nesting = findNesting(draft_.mesh, parts_);
    // By part that stands for those that cross: the largest of them, and how many there are.
    std::vector<std::uint32_t> largest(parts_.size(), RepairedMesh::kNone), members(parts_.size(), 0);
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      std::uint32_t& of = largest[nesting.crossing[i]];
      if (of == RepairedMesh::kNone || parts_[i].volume > parts_[of].volume) of = i;
      ++members[nesting.crossing[i]];
    }
    // Whether the turn that most triangles have is the outward one.
    const auto isOutward = [&](std::uint32_t i) {
      return (isPositive_[i] != 0) != (turnsFirst[patchOf_[i]] != 0);
    };
    isOutward_.resize(parts_.size());
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const std::uint32_t group = nesting.crossing[i], first = largest[group];
      if (members[group] > 1) ++draft_.crossingParts;
      const bool isWantedOutward = nesting.depth[first] % 2 == 0;
      const bool turnsGroup = isOutward(first) != isWantedOutward;
      isOutward_[i] = (isOutward(i) != turnsGroup) ? 1 : 0;
    }
    for (std::uint32_t i = 0; i < parts_.size(); ++i)
      turnsFirst[patchOf_[i]] = (isPositive_[i] != 0) != (isOutward_[i] != 0) ? 1 : 0;
  }

  /// Counts what is turned, and the closed parts that are turned as a whole.
  void count() {
    RepairCounts& counts = draft_.counts;
    counts.turnedTriangles = counts.turnedSolids = counts.turnedCavities = 0;
    const auto isOfSource = [&](std::uint32_t t) { return draft_.triangleOf[t] != RepairedMesh::kNone; };
    for (std::uint32_t t = 0; t < draft_.isTurned.size(); ++t)
      if (isOfSource(t)) counts.turnedTriangles += draft_.isTurned[t];
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (std::ranges::all_of(parts_[i].triangles,
                              [&](std::uint32_t t) { return !isOfSource(t) || draft_.isTurned[t] != 0; }))
        ++(isOutward_[i] != 0 ? counts.turnedSolids : counts.turnedCavities);
  }

  Draft& draft_;
  const RepairOptions& options_;
  const MeshEdges edges_;
  const MeshOrientation orientation_;
  std::vector<std::uint64_t> size_, turned_;  // by patch
  std::vector<ClosedPart> parts_;
  std::vector<std::uint32_t> patchOf_;    // by part
  std::vector<std::uint8_t> isPositive_;  // by part: its volume where it turns as its first triangle does
  std::vector<std::uint8_t> isOutward_;   // by part: as it is turned
};

}  // namespace

void orient(Draft& draft, const RepairOptions& options) {
  Orienting(draft, options).run();
}

}  // namespace arete::repair_passes
