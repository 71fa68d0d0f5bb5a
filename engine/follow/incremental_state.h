// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/follow/id_index_map.h"
#include "engine/follow/incremental_cut.h"
#include "engine/follow/kinetic_queue.h"
#include "engine/memory/paged_array.h"

namespace arete {

/// The cut of an IncrementalCut and the two ways to change it: enter() applies a node, leave() undoes one.
///
/// A node's count is 0 when it can change. A member's count is the number of its ceiling's triangles that
/// other members have removed (0: it is a leaf, which can leave). Any other node's is the number of its
/// floor's triangles that are not in the front (0: it can enter). A mark that is 0 as a whole has not been
/// touched: none of the node's floor is in the front. So a cut takes memory where it has been, which for a
/// coarse one are the first nodes.
class IncrementalCut::State {
 public:
  explicit State(MultiTriangulation multitriangulation)
      : mt(std::move(multitriangulation)), queue(leastTravel(mt)), marks_(mt.nodeCount()) {
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
      addTriangle(t);
      if (const std::uint32_t r = mt.arrays().remover[t]; r != MultiTriangulation::kNone) --touched(r);
    }
  }

  bool isIn(std::uint32_t n) const { return (marks_[n] & kIn) != 0; }
  bool isLeaf(std::uint32_t n) const { return (marks_[n] & ~kHasCertificate) == (kIn | kTouched); }
  bool canEnter(std::uint32_t n) const { return (marks_[n] & ~kHasCertificate) == kTouched; }
  std::uint32_t nodeCount() const { return nodes_; }
  std::uint32_t count(std::uint32_t n) const {
    const std::uint32_t mark = marks_[n];
    return mark == 0 ? floorSize(n) : mark & ~(kIn | kHasCertificate | kTouched);
  }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  bool hasTriangle(std::uint32_t t) const { return indexOf_.contains(t); }

  /// @param canChange canChange(node): called for every node that can enter now and could not before.
  /// Precondition: canEnter(n), and n is not in.
  template <class CanChange>
  void enter(std::uint32_t n, const CanChange& canChange) {
    const NodeId node(n);
    for (const std::uint32_t t : mt.floor(node)) {
      removeTriangle(t);
      if (const NodeId parent = mt.creator(TriangleId(t)); parent.isValid()) ++touched(parent.index());
    }
    forCeiling(node, [&](std::uint32_t t, std::uint32_t remover) {
      addTriangle(t);
      if (remover == MultiTriangulation::kNone) return;
      --touched(remover);
      if (canEnter(remover)) canChange(remover);
    });
    fillGaps();
    touched(n) |= kIn;
    ++nodes_;
    steps.push_back({node, true});
  }

  /// @param canChange canChange(node): called for every node that becomes a leaf. Precondition: isLeaf(n).
  template <class CanChange>
  void leave(std::uint32_t n, const CanChange& canChange) {
    const NodeId node(n);
    forCeiling(node, [&](std::uint32_t t, std::uint32_t remover) {
      removeTriangle(t);
      if (remover != MultiTriangulation::kNone) ++touched(remover);
    });
    for (const std::uint32_t t : mt.floor(node)) {
      addTriangle(t);
      const NodeId parent = mt.creator(TriangleId(t));
      if (!parent.isValid()) continue;
      --touched(parent.index());
      if (isLeaf(parent.index())) canChange(parent.index());
    }
    fillGaps();
    marks_[n] &= ~kIn;
    --nodes_;
    steps.push_back({node, false});
  }

  void enter(std::uint32_t n) {
    enter(n, [](std::uint32_t) {});
  }
  void leave(std::uint32_t n) {
    leave(n, [](std::uint32_t) {});
  }

  /// Prefetches what a change of the node reads: first where its slots begin; then, when that is in a cache,
  /// its floor and the removers of its ceiling.
  void prefetchSlots(std::uint32_t n) const { __builtin_prefetch(&mt.arrays().slotBegin[n]); }
  void prefetchTriangles(std::uint32_t n) const {
    __builtin_prefetch(mt.floor(NodeId(n)).data());
    __builtin_prefetch(&mt.arrays().remover[mt.slotTriangle(NodeId(n), 0).index()]);
  }

  const MultiTriangulation mt;
  std::vector<CutStep> steps;  ///< of the running or the last update

  // What updates keep between them (kinetic_update.cpp). While hasCertificates, every node that can change
  // has a certificate in the queue (its verdict is: no change) or is pending.
  bool hasCertificates = false;
  std::unique_ptr<const KineticCriterion> lastCriterion;  ///< null: it did not bound its motion
  KineticQueue queue;
  std::vector<std::uint32_t> pending;  ///< nodes to evaluate in this update or the next
  bool isOverBudget = false;           ///< the last update's criterion took more triangles than it had

  /// Whether the node is in the queue or pending.
  bool hasCertificate(std::uint32_t n) const { return (marks_[n] & kHasCertificate) != 0; }
  void dropCertificate(std::uint32_t n) { marks_[n] &= ~kHasCertificate; }
  /// Makes the node pending, unless it has a certificate.
  void requestCertificate(std::uint32_t n) {
    if (hasCertificate(n)) return;
    touched(n) |= kHasCertificate;
    pending.push_back(n);
  }
  void clearCertificates() {
    if (!hasCertificates) return;
    queue.clear([&](std::uint32_t n) { dropCertificate(n); });
    for (const std::uint32_t n : pending) dropCertificate(n);
    pending.clear();
    lastCriterion.reset();
    hasCertificates = false;
  }

 private:
  static constexpr std::uint32_t kIn = 1u << 31, kHasCertificate = 1u << 30, kTouched = 1u << 29;

  std::uint32_t floorSize(std::uint32_t n) const {
    return static_cast<std::uint32_t>(mt.floor(NodeId(n)).size());
  }
  std::uint32_t& touched(std::uint32_t n) {
    std::uint32_t& mark = marks_[n];
    if (mark == 0) mark = kTouched | floorSize(n);
    return mark;
  }

  /// A millionth of the size of the largest region: shorter travel is counted as if it were this long.
  static double leastTravel(const MultiTriangulation& mt) {
    return mt.nodeCount() == 0 ? 1 : std::max(1e-6 * double(mt.sphere(NodeId(0)).radius), 1e-12);
  }

  /// visit(triangle, the node that removes it or kNone).
  template <class Visit>
  void forCeiling(NodeId n, const Visit& visit) const {
    const std::uint32_t first = mt.slotTriangle(n, 0).index(), size = mt.ceilingSize(n);
    for (std::uint32_t t = first; t < first + size; ++t) visit(t, mt.arrays().remover[t]);
  }

  /// Fills a gap, where there is one.
  void addTriangle(std::uint32_t t) {
    if (gaps_.empty()) {
      indexOf_.insert(t, static_cast<std::uint32_t>(triangles_.size()));
      triangles_.push_back(t);
      return;
    }
    indexOf_.insert(t, gaps_.back());
    triangles_[gaps_.back()] = t;
    gaps_.pop_back();
  }
  void removeTriangle(std::uint32_t t) { gaps_.push_back(indexOf_.erase(t)); }
  /// Moves the last triangles to the remaining gaps.
  void fillGaps() {
    std::sort(gaps_.begin(), gaps_.end());
    for (; !gaps_.empty(); gaps_.pop_back()) {
      const std::uint32_t last = triangles_.back();
      triangles_.pop_back();
      if (gaps_.back() == triangles_.size()) continue;
      triangles_[gaps_.back()] = last;
      indexOf_[last] = gaps_.back();
    }
  }

  PagedArray<std::uint32_t> marks_;
  std::uint32_t nodes_ = 0;
  std::vector<std::uint32_t> triangles_;
  IdIndexMap indexOf_;
  std::vector<std::uint32_t> gaps_;  ///< indices of triangles that the running modification removed
};

}  // namespace arete
