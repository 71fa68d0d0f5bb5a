// SPDX-License-Identifier: GPL-3.0-or-later
//
// Members are listed in the order in which they entered, so parents precede children: a member that leaves
// has no children, and one that enters is appended. A member's node of its motion is computed when it enters.
// One pass over the list computes the scale of every member's ball, in parallel; a second, in order, moves
// those that are not at rest.
//
// Popping. A node that left gets the offset that it would have now, so that the cuts before and after are
// surfaces over the same moved vertices, which differ where nodes entered or left. At any point the triangle
// that both cuts have or refine has one remover, so there either all nodes entered or all left, one after the
// other, and the distances of their floors and ceilings add up along the chain: the distance at a node is its
// own plus the largest of its parents' in the same update. On the screen it is bounded over the hull of the
// last star of the chain, extended by the vertices' offsets and by the distance itself.
#include "engine/morph/geomorphed_cut.h"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/scattered_id.h"
#include "engine/memory/paged_array.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::size_t kMembersPerTask = 2048, kChangesPerTask = 64;

}  // namespace

template <class Motion>
class GeomorphedCut<Motion>::State {
 public:
  explicit State(MultiTriangulation multitriangulation)
      : mt(std::move(multitriangulation)), offsets_(mt.nodeCount()), isMember_(mt.nodeCount()) {}

  Update update(const MorphCamera& given, const IncrementalCut& cut, bool budgetBinds) {
    changes.clear();
    takeSteps(cut);
    pixels_.resize(members_.size());
    parallelFor(IndexRange<std::size_t>(0, members_.size(), kMembersPerTask), [&](const auto& range) {
      given.pixelsPerHeight(std::span<const Sphere>(balls_).subspan(range.begin(), range.size()),
                            std::span(pixels_).subspan(range.begin(), range.size()));
    });
    MorphCamera camera = given;
    // Under a budget the tolerance is what the cut really keeps: the smallest error of a member, in pixels.
    if (budgetBinds) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < members_.size(); ++i) least = std::min(least, errors_[i] * pixels_[i]);
      if (std::isfinite(least) && least > camera.tolerance().cut) camera.widen(least);
    }
    Update made;
    made.cutPixels = camera.tolerance().cut;
    made.moving = move(camera);
    made.jumpPixels = jump(camera);
    return made;
  }

  Offset offset(std::uint32_t v) const {
    return v < mt.rootVertexCount() ? Offset{} : offsets_[v - mt.rootVertexCount()];
  }

  const MultiTriangulation mt;
  std::vector<Change> changes;
  std::vector<Moving> moving;

 private:
  struct Member {
    std::uint32_t node;
    Node morph;
  };

  void takeSteps(const IncrementalCut& cut) {
    left_.clear();
    entered_ = 0;
    bool haveLeft = false;
    for (const CutStep& step : cut.lastSteps()) {
      const std::uint32_t n = step.node.index();
      // A node may enter and leave in the same update, so the cut decides and not the step.
      const bool isIn = cut.contains(step.node);
      if (isIn == (isMember_[n] != 0)) continue;
      isMember_[n] = isIn ? 1 : 0;
      if (!isIn) {
        haveLeft = true;
        continue;
      }
      members_.push_back({n, {}});
      balls_.push_back(mt.sphere(NodeId(n)));
      errors_.push_back(static_cast<float>(mt.saturatedError(step.node)));
      ++entered_;
    }
    if (haveLeft) dropLeft();
    const std::span<Member> entered = std::span(members_).last(entered_);
    parallelFor(IndexRange<std::size_t>(0, entered.size(), kChangesPerTask), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        entered[i].morph = Motion::nodeOf(mt, NodeId(entered[i].node));
    });
  }

  /// Moves nodes that are no longer members from the list to left_, in their order.
  void dropLeft() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (isMember_[members_[i].node] == 0) {
        left_.push_back(members_[i]);
        continue;
      }
      members_[kept] = members_[i];
      balls_[kept] = balls_[i];
      errors_[kept++] = errors_[i];
    }
    members_.resize(kept);
    balls_.resize(kept);
    errors_.resize(kept);
  }

  Offset offsetOf(const MorphCamera& camera, const Node& m, double rho, double pixelsPerUnit) const {
    return Motion::offset(camera, m, rho, pixelsPerUnit, offset(m.corner[0]), offset(m.corner[1]),
                          offset(m.corner[2]));
  }

  std::uint32_t move(const MorphCamera& camera) {
    moving.clear();
    const std::size_t count = members_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [n, morph] = members_[i];
      const double rho = errors_[i] * pixels_[i];
      Offset now{};
      if (const double share = camera.share(rho); share > 0) {
        now = offsetOf(camera, morph, rho, pixels_[i]);
        moving.push_back({NodeId(n), static_cast<float>(share), &morph});
      }
      if (now == offsets_[n]) continue;
      offsets_[n] = now;
      changes.push_back({mt.apex(NodeId(n)), now});
    }
    return static_cast<std::uint32_t>(moving.size());
  }

  double jump(const MorphCamera& camera) {
    // Offsets of nodes that left are not part of the result: they are restored.
    std::vector<Offset> before;
    for (const auto& [n, morph] : left_) {
      before.push_back(offsets_[n]);
      const double pixels = camera.pixelsPerHeight(mt.sphere(NodeId(n)));
      offsets_[n] = offsetOf(camera, morph, mt.saturatedError(NodeId(n)) * pixels, pixels);
    }
    const double most = std::max(chained(camera, std::span(members_).last(entered_)), chained(camera, left_));
    for (std::size_t i = 0; i < left_.size(); ++i) offsets_[left_[i].node] = before[i];
    return most;
  }

  /// The star of a node over moved vertices, in metric space, moved by up to `room` as vertices move.
  void hullOf(std::uint32_t n, double room, std::vector<Vec3>& hull) const {
    hull.clear();
    const MetricFrame& metric = mt.metric();
    const auto add = [&](std::uint32_t v) {
      Motion::addPlaces(Motion::moved(mt.position(VertexId(v)), offset(v)), room, metric, hull);
    };
    add(mt.apex(NodeId(n)).index());
    for (const std::uint32_t v : mt.link(NodeId(n))) add(v);
  }

  /// A node that entered or left.
  struct Changed {
    double own = 0;         ///< the distance of its floor and ceiling
    double before = 0;      ///< the largest distance at one of its parents
    bool isSeen = false;    ///< it or one of its ancestors here is in sight
    bool isNeeded = false;  ///< it or one of its descendants here is in sight
  };

  /// The most pixels of popping if these nodes, parents first, all entered or all left.
  double chained(const MorphCamera& camera, std::span<const Member> nodes) const {
    std::vector<Changed> changed(nodes.size());
    parallelFor(IndexRange<std::size_t>(0, nodes.size(), kChangesPerTask), [&](const auto& range) {
      std::vector<Vec3> hull;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        hullOf(nodes[i].node, 0, hull);
        changed[i].isSeen = camera.mayMeet(hull);
      }
    });
    tsl::robin_map<std::uint32_t, std::size_t, ScatteredId> place;
    place.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i].node] = i;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  // child and parent, by child
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const std::uint32_t t : mt.floor(NodeId(nodes[i].node)))
        if (const NodeId parent = mt.creator(TriangleId(t)); parent.isValid())
          if (const auto at = place.find(parent.index()); at != place.end())
            pairs.emplace_back(i, at->second);
    for (const auto& [child, parent] : pairs)
      changed[child].isSeen = changed[child].isSeen || changed[parent].isSeen;
    for (Changed& c : changed) c.isNeeded = c.isSeen;
    for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
      const auto [child, parent] = *pair;
      changed[parent].isNeeded = changed[parent].isNeeded || changed[child].isNeeded;
    }
    parallelFor(IndexRange<std::size_t>(0, nodes.size(), kChangesPerTask), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        if (changed[i].isNeeded)
          changed[i].own = Motion::popping(mt, NodeId(nodes[i].node), nodes[i].morph,
                                           [&](std::uint32_t v) { return offset(v); });
    });
    for (const auto& [child, parent] : pairs)
      changed[child].before = std::max(changed[child].before, changed[parent].before + changed[parent].own);
    double most = 0;
    std::vector<Vec3> hull;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Changed& c = changed[i];
      if (!c.isSeen || c.own + c.before == 0) continue;
      hullOf(nodes[i].node, c.before, hull);
      most = std::max(most, camera.pixelsOf(c.own + c.before, camera.pixelsPerHeight(hull)));
    }
    return most;
  }

  PagedArray<Offset> offsets_;         // by node
  PagedArray<std::uint8_t> isMember_;  // by node
  std::vector<Member> members_;        // in the order in which they entered
  std::size_t entered_ = 0;            // how many of the last members entered in the last update
  std::vector<Member> left_;           // those that left in the last update, parents first
  std::vector<Sphere> balls_;          // of members
  std::vector<float> errors_;          // of members
  std::vector<double> pixels_;         // of members: per unit of height
};

template <class Motion>
GeomorphedCut<Motion>::GeomorphedCut(MultiTriangulation mt)
    : state_(std::make_unique<State>(std::move(mt))) {}
template <class Motion>
GeomorphedCut<Motion>::~GeomorphedCut() = default;
template <class Motion>
GeomorphedCut<Motion>::GeomorphedCut(GeomorphedCut&&) noexcept = default;
template <class Motion>
GeomorphedCut<Motion>& GeomorphedCut<Motion>::operator=(GeomorphedCut&&) noexcept = default;

template <class Motion>
auto GeomorphedCut<Motion>::update(const MorphCamera& camera, const IncrementalCut& cut, bool budgetBinds)
    -> Update {
  return state_->update(camera, cut, budgetBinds);
}

template <class Motion>
auto GeomorphedCut<Motion>::offset(VertexId v) const -> Offset {
  return state_->offset(v.index());
}

template <class Motion>
auto GeomorphedCut<Motion>::changes() const -> std::span<const Change> {
  return state_->changes;
}

template <class Motion>
auto GeomorphedCut<Motion>::moving() const -> std::span<const Moving> {
  return state_->moving;
}

template <class Motion>
const MultiTriangulation& GeomorphedCut<Motion>::mt() const {
  return state_->mt;
}

template class GeomorphedCut<HeightMotion>;
template class GeomorphedCut<SpaceMotion>;

}  // namespace arete
