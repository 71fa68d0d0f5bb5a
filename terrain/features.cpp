// SPDX-License-Identifier: GPL-3.0-or-later
//
// Persistence of dimension 0, twice: the components of the sublevel sets (pits, upwards) and those of the
// superlevel sets (peaks, downwards). Told upwards: a sweep by height opens a component at every vertex
// without a lower neighbour; where two components meet, the one with the younger extremum dies (the elder
// rule), and the vertex that joined them is the pass (Edelsbrunner, Letscher, Zomorodian 2002; Edelsbrunner,
// Harer, "Computational Topology", 2010, chapter VII).
//
// Most of the sweep decides nothing: a vertex joins the component of its lowest neighbour. So each vertex is
// hung under that neighbour at once, which makes trees, one for each extremum, and only edges between two
// trees are swept, in the order of their later ends. They are few, and nothing else needs sorting.
//
// Not all edges need be looked at: in a triangle with the order a, b, c the edge ab already unites a and b
// when c comes, so that c need only be joined with a: two links per triangle. The trees serve as union-find,
// with the extremum as the root and paths halved: O(log n) amortised per operation without a second array.
#include "terrain/features.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "engine/with_threads.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::string_view kStage = "ranking features";

template <class Before>
std::uint32_t firstOf(const Triangle& t, const Before& before) {
  const std::uint32_t first = before(t[1], t[0]) ? t[1] : t[0];
  return before(t[2], first) ? t[2] : first;
}

class Components {
 public:
  /// Every vertex under its first neighbour in the order, itself included.
  template <class Before>
  Components(std::size_t count, std::span<const Triangle> triangles, const Before& before) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (const Triangle& t : triangles) {
      const std::uint32_t first = firstOf(t, before);
      for (const std::uint32_t v : t)
        if (before(first, parent_[v])) parent_[v] = first;
    }
    for (std::uint32_t v = 0; v < count; ++v) parent_[v] = find(v);
  }

  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }

  /// The root of its tree, until trees are hung under each other.
  std::uint32_t parent(std::uint32_t v) const { return parent_[v]; }

  void hang(std::uint32_t root, std::uint32_t under) { parent_[root] = under; }

 private:
  std::vector<std::uint32_t> parent_;
};

/// One sweep. `before` is its order as a comparison; `kind` is what its extrema are. Appends the pairs to
/// `found`; leaves the surviving extremum of each component as its root.
template <class Before>
void sweep(Components& components, const Before& before, Feature::Kind kind, std::span<const double> heights,
           std::span<const Triangle> triangles, const FeatureOptions& options, const RunContext& context,
           std::vector<Feature>& found) {
  struct Link {
    std::uint32_t later, first;
  };
  std::vector<Link> links;
  for (const Triangle& t : triangles) {
    const std::uint32_t tree = components.parent(t[0]);
    if (components.parent(t[1]) == tree && components.parent(t[2]) == tree) continue;
    const std::uint32_t first = firstOf(t, before);
    for (const std::uint32_t v : t)
      if (components.parent(v) != components.parent(first)) links.push_back({v, first});
  }
  if (context.cancelled()) return;
  tbb::parallel_sort(links.begin(), links.end(),
                     [&](const Link& a, const Link& b) { return before(a.later, b.later); });
  for (const Link& link : links) {
    std::uint32_t staying = components.find(link.later), dying = components.find(link.first);
    if (dying == staying) continue;
    if (before(dying, staying)) std::swap(dying, staying);
    components.hang(dying, staying);
    const double persistence = std::abs(heights[link.later] - heights[dying]);
    if (persistence > 0 && persistence >= options.minimumPersistence) {
      found.push_back({kind, dying, heights[dying], persistence});
      found.push_back({Feature::Kind::pass, link.later, heights[link.later], persistence});
    }
  }
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
  const auto lower = [&](std::uint32_t a, std::uint32_t b) {
    return heights[a] < heights[b] || (heights[a] == heights[b] && a < b);
  };
  const auto higher = [&](std::uint32_t a, std::uint32_t b) { return lower(b, a); };

  context.report(kStage, 0);
  std::optional<Components> upwards, downwards;
  std::vector<Feature> found, peaks;
  withThreads(context, [&] {
    tbb::parallel_invoke(
        [&] {
          upwards.emplace(heights.size(), triangles, lower);
          sweep(*upwards, lower, Feature::Kind::pit, heights, triangles, options, context, found);
        },
        [&] {
          downwards.emplace(heights.size(), triangles, higher);
          sweep(*downwards, higher, Feature::Kind::peak, heights, triangles, options, context, peaks);
        });
  });
  if (context.cancelled()) return {};
  found.insert(found.end(), peaks.begin(), peaks.end());
  for (std::uint32_t low = 0; low < heights.size(); ++low) {
    if (std::isnan(heights[low]) || upwards->find(low) != low) continue;
    const std::uint32_t high = downwards->find(low);
    const double range = heights[high] - heights[low];
    if (range > 0 && range >= options.minimumPersistence) {
      found.push_back({Feature::Kind::pit, low, heights[low], range});
      found.push_back({Feature::Kind::peak, high, heights[high], range});
    }
  }
  std::sort(found.begin(), found.end(), [](const Feature& a, const Feature& b) {
    return std::tuple(-a.persistence, a.sample, a.kind) < std::tuple(-b.persistence, b.sample, b.kind);
  });
  context.report(kStage, 1);
  return found;
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
