// SPDX-License-Identifier: GPL-3.0-or-later
//
// See feature_sweep.h for the sweeps. Here each vertex is attached to its first neighbour in the order of the
// sweep. Not all edges are needed: in a triangle with the order a, b, c the edge ab has joined a and b when c
// is reached, so c is joined with a only: two edges per triangle.
#include "terrain/features/features.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <unordered_set>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/features/feature_sweep.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::string_view kStage = "ranking features";

template <class Before>
std::uint32_t firstOf(const Triangle& t, const Before& before) {
  const std::uint32_t first = before(t[1], t[0]) ? t[1] : t[0];
  return before(t[2], first) ? t[2] : first;
}

/// Per vertex its first neighbour in the order, itself included.
template <class Before>
UninitializedVector<std::uint32_t> firstNeighbours(std::size_t count, std::span<const Triangle> triangles,
                                                   const Before& before) {
  UninitializedVector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Triangle& t : triangles) {
    const std::uint32_t first = firstOf(t, before);
    for (const std::uint32_t v : t)
      if (before(first, parent[v])) parent[v] = first;
  }
  return parent;
}

}  // namespace

std::string_view toString(Feature::Kind kind) {
  switch (kind) {
    case Feature::Kind::peak:
      return "peak";
    case Feature::Kind::pit:
      return "pit";
    case Feature::Kind::pass:
      return "pass";
  }
  return "unknown";
}

std::vector<Feature> rankFeatures(std::span<const double> heights, std::span<const Triangle> triangles,
                                  const FeatureOptions& options, const RunContext& context) {
  assert(heights.size() < std::numeric_limits<std::uint32_t>::max());
  assert(triangles.size() < (std::size_t(1) << 31));
  context.report(kStage, 0);
  std::vector<Feature> ranked = withThreads(context, [&] {
    FeatureParents parents;
    parallelInvoke(
        [&] { parents.lower = firstNeighbours(heights.size(), triangles, LowerVertex(heights)); },
        [&] { parents.higher = firstNeighbours(heights.size(), triangles, HigherVertex(heights)); });
    const auto linksOf = [&](const auto& before, const FeatureTrees& trees) {
      std::vector<FeatureLink> links;
      for (const Triangle& t : triangles) {
        const std::uint32_t tree = trees.tree(t[0]);
        if (trees.tree(t[1]) == tree && trees.tree(t[2]) == tree) continue;
        const std::uint32_t first = firstOf(t, before);
        for (const std::uint32_t v : t)
          if (trees.tree(v) != trees.tree(first)) links.push_back({v, first});
      }
      return links;
    };
    return rankFeaturesOf(heights, std::move(parents), linksOf, options, context);
  });
  if (!context.cancelled()) context.report(kStage, 1);
  return ranked;
}

std::vector<std::uint32_t> selectFeatures(std::span<const Feature> ranked, const FeatureOptions& options) {
  std::vector<std::uint32_t> samples;
  std::unordered_set<std::uint32_t> seen;
  for (const Feature& feature : ranked) {
    if (samples.size() >= options.count || feature.persistence < options.minimumPersistence) break;
    if (seen.insert(feature.sample).second) samples.push_back(feature.sample);
  }
  return samples;
}

}  // namespace arete
