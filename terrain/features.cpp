// SPDX-License-Identifier: GPL-3.0-or-later
//
// Persistence of dimension 0, twice: the components of the sublevel sets (pits, upwards) and those of the
// superlevel sets (peaks, downwards). Vertices are swept in height order; each opens a component of its own
// and unites those of its neighbours swept before. Where two components meet, the one with the younger
// extremum dies (the elder rule), and the vertex that joined them is the pass (Edelsbrunner, Letscher,
// Zomorodian 2002; Edelsbrunner, Harer, "Computational Topology", 2010, chapter VII).
//
// The sweep needs not all edges: in a triangle swept in the order a, b, c the edge ab already unites a and b
// when c comes, so that c need only be joined with a. Two links per triangle, filed under the later vertex,
// replace an adjacency of six neighbours each way: 16 bytes per raster sample and sweep. The union-find keeps
// the extremum as the root of its component and halves paths: O(log n) amortised per operation without a
// second array.
#include "terrain/features.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_sort.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::string_view kStage = "ranking features";
constexpr std::size_t kVerticesPerReport = std::size_t(1) << 18;

/// Links of the later vertices of the triangles to the first, in the order of one sweep.
struct Links {
  std::vector<std::uint32_t> begin;  ///< per vertex, and the end
  std::vector<std::uint32_t> first;

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(first).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
  }
};

template <class Before>
Links linkTriangles(std::size_t vertexCount, std::span<const Triangle> triangles, const Before& before) {
  const auto firstOf = [&](const Triangle& t) { return std::min({t[0], t[1], t[2]}, before); };
  Links links;
  links.begin.assign(vertexCount + 2, 0);
  // Counted two places on and summed, begin[v + 1] is where v's links start; filling moves it to where they
  // end.
  for (const Triangle& t : triangles) {
    const std::uint32_t first = firstOf(t);
    for (const std::uint32_t v : t) {
      if (v != first) ++links.begin[v + 2];
    }
  }
  std::partial_sum(links.begin.begin(), links.begin.end(), links.begin.begin());
  links.first.resize(triangles.size() * 2);
  for (const Triangle& t : triangles) {
    const std::uint32_t first = firstOf(t);
    for (const std::uint32_t v : t) {
      if (v != first) links.first[links.begin[v + 1]++] = first;
    }
  }
  links.begin.pop_back();
  return links;
}

class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }

  void hang(std::uint32_t root, std::uint32_t under) { parent_[root] = under; }

 private:
  std::vector<std::uint32_t> parent_;
};

/// One sweep over `order`. `before` is the order as a comparison; `kind` is what its extrema are.
/// Appends the pairs to `found`; leaves the surviving extremum of each component as its root.
template <class Order, class Before>
bool sweep(const Order& order, const Before& before, Feature::Kind kind, std::span<const double> heights,
           std::span<const Triangle> triangles, const FeatureOptions& options, const RunContext& context,
           double fractionDone, Components& components, std::vector<Feature>& found) {
  const Links links = linkTriangles(heights.size(), triangles, before);
  std::size_t swept = 0;
  for (const std::uint32_t v : order) {
    if (swept++ % kVerticesPerReport == 0) {
      if (context.cancelled()) return false;
      context.report(kStage, fractionDone + 0.4 * double(swept) / double(heights.size()));
    }
    std::uint32_t own = components.find(v);
    for (const std::uint32_t earlier : links.of(v)) {
      std::uint32_t dying = components.find(earlier);
      if (dying == own) continue;
      if (before(dying, own)) std::swap(dying, own);
      components.hang(dying, own);
      const double persistence = std::abs(heights[v] - heights[dying]);
      if (persistence > 0 && persistence >= options.minimumPersistence) {
        found.push_back({kind, dying, heights[dying], persistence});
        found.push_back({Feature::Kind::pass, v, heights[v], persistence});
      }
    }
  }
  return true;
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
  std::vector<std::uint32_t> order;
  order.reserve(heights.size());
  for (std::uint32_t v = 0; v < heights.size(); ++v) {
    if (!std::isnan(heights[v])) order.push_back(v);
  }
  const int available = tbb::info::default_concurrency();
  const int threads = context.threads > 0 ? std::min(context.threads, available) : available;
  tbb::task_arena(threads).execute([&] { tbb::parallel_sort(order.begin(), order.end(), lower); });

  std::vector<Feature> found;
  std::vector<std::uint32_t> lowest;  // of each component, isolated samples among them
  {
    Components components(heights.size());
    if (!sweep(order, lower, Feature::Kind::pit, heights, triangles, options, context, 0.2, components,
               found))
      return {};
    for (const std::uint32_t v : order) {
      if (components.find(v) == v) lowest.push_back(v);
    }
  }
  std::reverse(order.begin(), order.end());
  Components components(heights.size());
  if (!sweep(order, higher, Feature::Kind::peak, heights, triangles, options, context, 0.6, components,
             found))
    return {};
  for (const std::uint32_t low : lowest) {
    const std::uint32_t high = components.find(low);
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
