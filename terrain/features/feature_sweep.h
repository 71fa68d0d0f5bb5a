// SPDX-License-Identifier: GPL-3.0-or-later
//
// Persistence of dimension 0, twice: of the components of the sublevel sets (pits, upwards) and of the
// superlevel sets (peaks, downwards). Upwards: a sweep by height opens a component at every vertex without a
// lower neighbour; where two components meet, the one with the younger extremum ends (the elder rule), and
// the vertex that joins them is the pass [EdelsbrunnerLetscherZomorodian2002], [EdelsbrunnerHarer2010].
//
// Most vertices of the sweep only join the component of a lower neighbour. So each vertex is attached to one
// lower neighbour in advance, which makes trees, one for each extremum, and only edges between two trees are
// swept, in the order of their later ends. These are few, and nothing else needs sorting. The trees serve as
// union-find with the extremum as the root and path halving [TarjanVanLeeuwen1984]: O(log n) amortised per
// operation without a second array.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "engine/parallel/run_context.h"
#include "terrain/features/features.h"

namespace arete {

/// The order of the upward sweep: by height, then by index.
class LowerVertex {
 public:
  explicit LowerVertex(std::span<const double> heights) : heights_(heights) {}
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    return heights_[a] < heights_[b] || (heights_[a] == heights_[b] && a < b);
  }

 private:
  std::span<const double> heights_;
};

/// The order of the downward sweep, the reverse of LowerVertex.
class HigherVertex {
 public:
  explicit HigherVertex(std::span<const double> heights) : lower_(heights) {}
  bool operator()(std::uint32_t a, std::uint32_t b) const { return lower_(b, a); }

 private:
  LowerVertex lower_;
};

/// The trees of a sweep, and the union-find structure made of them.
class FeatureTrees {
 public:
  FeatureTrees() = default;
  /// @param parent  per vertex a neighbour that comes before it in the sweep, or itself
  explicit FeatureTrees(UninitializedVector<std::uint32_t> parent) : parent_(std::move(parent)) {
    for (std::uint32_t v = 0; v < parent_.size(); ++v) parent_[v] = find(v);
  }

  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }

  /// The root of v's tree. Precondition: attach() has not been called.
  std::uint32_t tree(std::uint32_t v) const { return parent_[v]; }

  void attach(std::uint32_t root, std::uint32_t under) { parent_[root] = under; }

 private:
  UninitializedVector<std::uint32_t> parent_;
};

/// An edge between two trees, with its ends in the order of a sweep.
struct FeatureLink {
  std::uint32_t later, first;
};

/// Pairs extrema with their passes. Afterwards the root of each component is its surviving extremum.
/// @param links  edges between the trees; sorted here
/// @param before  the order of the sweep
/// @param kind  of the extrema: pit or peak
/// @param found  receives the pairs
template <class Before>
void sweepFeatures(FeatureTrees& trees, std::vector<FeatureLink>& links, const Before& before,
                   Feature::Kind kind, std::span<const double> heights, const FeatureOptions& options,
                   std::vector<Feature>& found) {
  parallelSort(links.begin(), links.end(),
               [&](const FeatureLink& a, const FeatureLink& b) { return before(a.later, b.later); });
  for (const FeatureLink& link : links) {
    std::uint32_t elder = trees.find(link.later), younger = trees.find(link.first);
    if (younger == elder) continue;
    if (before(younger, elder)) std::swap(younger, elder);
    trees.attach(younger, elder);
    const double persistence = std::abs(heights[link.later] - heights[younger]);
    if (persistence > 0 && persistence >= options.minimumPersistence) {
      found.push_back({kind, younger, heights[younger], persistence});
      found.push_back({Feature::Kind::pass, link.later, heights[link.later], persistence});
    }
  }
}

/// Per vertex a lower neighbour and a higher one, or itself where there is none.
struct FeatureParents {
  UninitializedVector<std::uint32_t> lower, higher;
};

/// rankFeatures() on any surface. Empty when cancelled.
/// @param linksOf  linksOf(before, trees) returns edges between trees that join the same components at the
/// same
///        time in the sweep as all edges do; called for both sweeps concurrently
template <class LinksOf>
std::vector<Feature> rankFeaturesOf(std::span<const double> heights, FeatureParents parents,
                                    const LinksOf& linksOf, const FeatureOptions& options,
                                    const RunContext& context) {
  std::vector<Feature> found, peaks;
  FeatureTrees upwards, downwards;
  const auto sweep = [&](FeatureTrees& trees, UninitializedVector<std::uint32_t>& parent, const auto& before,
                         Feature::Kind kind, std::vector<Feature>& pairs) {
    trees = FeatureTrees(std::move(parent));
    std::vector<FeatureLink> links = linksOf(before, trees);
    if (!context.cancelled()) sweepFeatures(trees, links, before, kind, heights, options, pairs);
  };
  parallelInvoke(
      [&] { sweep(upwards, parents.lower, LowerVertex(heights), Feature::Kind::pit, found); },
      [&] { sweep(downwards, parents.higher, HigherVertex(heights), Feature::Kind::peak, peaks); });
  if (context.cancelled()) return {};
  found.insert(found.end(), peaks.begin(), peaks.end());
  for (std::uint32_t low = 0; low < heights.size(); ++low) {
    if (upwards.tree(low) != low || std::isnan(heights[low])) continue;
    const std::uint32_t high = downwards.find(low);
    const double range = heights[high] - heights[low];
    if (range > 0 && range >= options.minimumPersistence) {
      found.push_back({Feature::Kind::pit, low, heights[low], range});
      found.push_back({Feature::Kind::peak, high, heights[high], range});
    }
  }
  std::sort(found.begin(), found.end(), [](const Feature& a, const Feature& b) {
    return std::tuple(-a.persistence, a.sample, a.kind) < std::tuple(-b.persistence, b.sample, b.kind);
  });
  return found;
}

}  // namespace arete
