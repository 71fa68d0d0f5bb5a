// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

#include <cstdint>
#include <vector>

#include "engine/incremental_cut.h"

namespace arete {

/// Scatters ids, which come in runs: the root's, a star's. Unscattered they would fill whole stretches of a
/// table, and every other id that falls there would search to their end.
struct ScatteredId {
  std::size_t operator()(std::uint32_t id) const noexcept {
    return static_cast<std::size_t>((id * 0x9E3779B97F4A7C15ull) >> 32);
  }
};

/// The cut of an IncrementalCut and the only two ways to change it. A node's mark is 0 when it is out, else 1
/// and the number of its ceiling's triangles that members have removed: a leaf, which can go, has 1.
class IncrementalCut::State {
 public:
  explicit State(MultiTriangulation multitriangulation)
      : mt(std::move(multitriangulation)), marks_(mt.nodeCount(), 0) {
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) addTriangle(t);
  }

  bool isIn(std::uint32_t n) const { return marks_[n] != 0; }
  bool isLeaf(std::uint32_t n) const { return marks_[n] == 1; }
  std::uint32_t nodeCount() const { return nodes_; }
  std::uint16_t mark(std::uint32_t n) const { return marks_[n]; }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  bool hasTriangle(std::uint32_t t) const { return place_.contains(t); }

  /// Precondition: n is out and its floor in the front.
  void enter(std::uint32_t n) {
    const NodeId node(n);
    for (const std::uint32_t t : mt.floor(node)) {
      removeTriangle(t);
      if (const NodeId parent = mt.creator(TriangleId(t)); parent.isValid()) ++marks_[parent.index()];
    }
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i) addTriangle(mt.slotTriangle(node, i).index());
    marks_[n] = 1;
    ++nodes_;
    steps.push_back({node, true});
  }

  /// Precondition: n is a leaf.
  void leave(std::uint32_t n) {
    const NodeId node(n);
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i) removeTriangle(mt.slotTriangle(node, i).index());
    for (const std::uint32_t t : mt.floor(node)) {
      addTriangle(t);
      if (const NodeId parent = mt.creator(TriangleId(t)); parent.isValid()) --marks_[parent.index()];
    }
    marks_[n] = 0;
    --nodes_;
    steps.push_back({node, false});
  }

  const MultiTriangulation mt;
  std::vector<CutStep> steps;  ///< of the running or the last update
  std::size_t cursor = 0;      ///< where a scan that ran out of time goes on

 private:
  void addTriangle(std::uint32_t t) {
    place_[t] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
  }
  void removeTriangle(std::uint32_t t) {
    const auto at = place_.find(t);
    const std::uint32_t place = at->second, last = triangles_.back();
    place_.erase(at);
    triangles_.pop_back();
    if (last == t) return;
    triangles_[place] = last;
    place_[last] = place;
  }

  std::vector<std::uint16_t> marks_;
  std::uint32_t nodes_ = 0;
  std::vector<std::uint32_t> triangles_;
  tsl::robin_map<std::uint32_t, std::uint32_t, ScatteredId> place_;
};

}  // namespace arete
