// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tsl/robin_set.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/follow/id_index_map.h"
#include "engine/follow/incremental_cut.h"
#include "engine/follow/kinetic_queue.h"

namespace arete {

/// Scatters ids, which come in runs: the root's, a star's. Unscattered they would fill whole stretches of a
/// table, and every other id that falls there would search to their end.
struct ScatteredId {
  std::size_t operator()(std::uint32_t id) const noexcept {
    return static_cast<std::size_t>((id * 0x9E3779B97F4A7C15ull) >> 32);
  }
};

/// The cut of an IncrementalCut and the only two ways to change it.
///
/// A node's count is 0 when it can change: of a member, how many triangles of its ceiling other members have
/// removed (0: a leaf, which can leave); of any other node, how many triangles of its floor are not in the
/// front (0: it can enter).
class IncrementalCut::State {
 public:
  explicit State(MultiTriangulation multitriangulation)
      : mt(std::move(multitriangulation)), calendar(leastTravel(mt)), marks_(mt.nodeCount()) {
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
      marks_[n] = static_cast<std::uint32_t>(mt.floor(NodeId(n)).size());
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
      addTriangle(t);
      if (const std::uint32_t r = mt.arrays().remover[t]; r != MultiTriangulation::kNone) --marks_[r];
    }
  }

  bool isIn(std::uint32_t n) const { return (marks_[n] & kIn) != 0; }
  bool isLeaf(std::uint32_t n) const { return (marks_[n] & ~kWatched) == kIn; }
  bool canEnter(std::uint32_t n) const { return (marks_[n] & ~kWatched) == 0; }
  std::uint32_t nodeCount() const { return nodes_; }
  std::uint32_t count(std::uint32_t n) const { return marks_[n] & ~(kIn | kWatched); }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  bool hasTriangle(std::uint32_t t) const { return place_.contains(t); }

  /// canChange(node): of every node that can enter now and could not before. Precondition: n is out and its
  /// floor in the front.
  template <class CanChange>
  void enter(std::uint32_t n, const CanChange& canChange) {
    const NodeId node(n);
    for (const std::uint32_t t : mt.floor(node)) {
      removeTriangle(t);
      if (const NodeId parent = mt.creator(TriangleId(t)); parent.isValid()) ++marks_[parent.index()];
    }
    forCeiling(node, [&](std::uint32_t t, std::uint32_t remover) {
      addTriangle(t);
      if (remover == MultiTriangulation::kNone) return;
      --marks_[remover];
      if (canEnter(remover)) canChange(remover);
    });
    fillGaps();
    marks_[n] |= kIn;
    ++nodes_;
    steps.push_back({node, true});
  }

  /// canChange(node): of every node that is a leaf now and was none before. Precondition: n is a leaf.
  template <class CanChange>
  void leave(std::uint32_t n, const CanChange& canChange) {
    const NodeId node(n);
    forCeiling(node, [&](std::uint32_t t, std::uint32_t remover) {
      removeTriangle(t);
      if (remover != MultiTriangulation::kNone) ++marks_[remover];
    });
    for (const std::uint32_t t : mt.floor(node)) {
      addTriangle(t);
      const NodeId parent = mt.creator(TriangleId(t));
      if (!parent.isValid()) continue;
      --marks_[parent.index()];
      if (isLeaf(parent.index())) canChange(parent.index());
    }
    fillGaps();
    marks_[n] &= ~kIn;
    --nodes_;
    steps.push_back({node, false});
  }

  /// The same, whoever can change then.
  void enter(std::uint32_t n) {
    enter(n, [](std::uint32_t) {});
  }
  void leave(std::uint32_t n) {
    leave(n, [](std::uint32_t) {});
  }

  /// Asks for what a change of the node reads first, where its slots begin; then, when that is there, for its
  /// floor and for what removes its ceiling. What it reads later is nearer.
  void prefetchSlots(std::uint32_t n) const { __builtin_prefetch(&mt.arrays().slotBegin[n]); }
  void prefetchTriangles(std::uint32_t n) const {
    __builtin_prefetch(mt.floor(NodeId(n)).data());
    __builtin_prefetch(&mt.arrays().remover[mt.slotTriangle(NodeId(n), 0).index()]);
  }

  const MultiTriangulation mt;
  std::vector<CutStep> steps;  ///< of the running or the last update
  std::size_t cursor = 0;      ///< where a scan that ran out of time goes on

  // What saturated updates know (kinetic_update.cpp). While isWatching, every node that can change is
  // watched: it is in the calendar, where the verdict on it is that it stays as it is, or among the unasked.
  bool isWatching = false;
  std::unique_ptr<const Criterion> asked;  ///< the last criterion, if it can be remembered
  KineticQueue calendar;
  std::vector<std::uint32_t> unasked;
  bool isBudgetTight = false;  ///< the last update could not afford what it was asked for

  bool isWatched(std::uint32_t n) const { return (marks_[n] & kWatched) != 0; }
  void unwatch(std::uint32_t n) { marks_[n] &= ~kWatched; }
  /// To be asked about, if it is not watched already.
  void watch(std::uint32_t n) {
    if (isWatched(n)) return;
    marks_[n] |= kWatched;
    unasked.push_back(n);
  }
  void forgetWatches() {
    if (!isWatching) return;
    calendar.clear([&](std::uint32_t n) { unwatch(n); });
    for (const std::uint32_t n : unasked) unwatch(n);
    unasked.clear();
    asked.reset();
    isWatching = false;
  }

 private:
  static constexpr std::uint32_t kIn = 1u << 31, kWatched = 1u << 30;

  /// A millionth of the size of the largest region: no travel worth a clock's while.
  static double leastTravel(const MultiTriangulation& mt) {
    return mt.nodeCount() == 0 ? 1 : std::max(1e-6 * double(mt.arrays().sphere[0].radius), 1e-12);
  }

  /// visit(triangle, the node that removes it or kNone).
  template <class Visit>
  void forCeiling(NodeId n, const Visit& visit) const {
    const std::uint32_t first = mt.slotTriangle(n, 0).index(), size = mt.ceilingSize(n);
    for (std::uint32_t t = first; t < first + size; ++t) visit(t, mt.arrays().remover[t]);
  }

  /// Takes a gap, where one was left.
  void addTriangle(std::uint32_t t) {
    if (gaps_.empty()) {
      place_.insert(t, static_cast<std::uint32_t>(triangles_.size()));
      triangles_.push_back(t);
      return;
    }
    place_.insert(t, gaps_.back());
    triangles_[gaps_.back()] = t;
    gaps_.pop_back();
  }
  void removeTriangle(std::uint32_t t) { gaps_.push_back(place_.erase(t)); }
  /// The last triangles go to the gaps that are left.
  void fillGaps() {
    std::sort(gaps_.begin(), gaps_.end());
    for (; !gaps_.empty(); gaps_.pop_back()) {
      const std::uint32_t last = triangles_.back();
      triangles_.pop_back();
      if (gaps_.back() == triangles_.size()) continue;
      triangles_[gaps_.back()] = last;
      place_[last] = gaps_.back();
    }
  }

  std::vector<std::uint32_t> marks_;
  std::uint32_t nodes_ = 0;
  std::vector<std::uint32_t> triangles_;
  IdIndexMap place_;
  std::vector<std::uint32_t> gaps_;  ///< places of triangles that the running modification has removed
};

}  // namespace arete
