// SPDX-License-Identifier: GPL-3.0-or-later
//
// See feature_sweep.h for the sweeps. A sample with six valid neighbours has a closed star of six triangles.
// Which of the six neighbours are lower is a mask of six bits, and tables give the rest: one lower and one
// higher neighbour to be attached to, and whether the lower ones form several runs around the ring. Only then
// can the sample be a pass of either sweep: neighbours in one run are joined by the ring's own edges before
// the sample is reached, so an edge to one of each run is enough. Samples on the border and beside NODATA are
// few; for them the triangles of the surrounding cells are visited.

#include <array>
#include <bit>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/features/feature_sweep.h"
#include "terrain/model/raster_cells.h"

namespace arete {
namespace {

constexpr std::string_view kRasterStage = "ranking features";
constexpr unsigned kRing = 6, kMasks = 1 << kRing;

/// For each mask of a ring: its first bit (kRing where it has none), the bits where a run begins, and whether
/// there are several runs.
struct RingTables {
  std::array<std::uint8_t, kMasks> first{}, begins{};
  std::array<bool, kMasks> isPass{};

  constexpr RingTables() {
    for (unsigned mask = 0; mask < kMasks; ++mask) {
      first[mask] = static_cast<std::uint8_t>(mask == 0 ? kRing : unsigned(std::countr_zero(mask)));
      const unsigned turned = (mask << 1 | mask >> (kRing - 1)) % kMasks;
      begins[mask] = static_cast<std::uint8_t>(mask & ~turned);
      isPass[mask] = std::popcount(mask ^ turned) > 2;
    }
  }
};
constexpr RingTables kTables;

class Lattice {
 public:
  explicit Lattice(const RasterHeightfield& field) : field_(field), cells_(field), columns_(field.columns) {
    // Around the ring, beginning above. Neighbours with a smaller index come first: FeatureTrees resolves the
    // vertices in the order of their indices, so their roots are known already.
    ring_ = {-columns_, -columns_ - 1, -1, columns_, columns_ + 1, 1, 0};
  }

  FeatureParents parents() {
    const std::size_t count = field_.size();
    FeatureParents parents{UninitializedVector<std::uint32_t>(count),
                           UninitializedVector<std::uint32_t>(count)};
    const std::size_t rows = field_.rows;
    passesOfRow_.resize(rows);
    parallelFor(IndexRange<std::size_t>(0, rows, 8), [&](const auto& range) {
      for (std::size_t row = range.begin(); row != range.end(); ++row)
        scanRow(static_cast<std::uint32_t>(row), parents);
    });
    return parents;
  }

  /// From each sample that may join trees, edges to neighbours of other trees that come before it.
  template <class Before>
  std::vector<FeatureLink> links(const Before& before, const FeatureTrees& trees) const {
    std::vector<FeatureLink> links;
    const auto join = [&](std::uint32_t v, std::uint32_t u) {
      if (trees.tree(u) != trees.tree(v) && before(u, v)) links.push_back({v, u});
    };
    for (const std::vector<Pass>& passes : passesOfRow_)
      for (const Pass& pass : passes) {
        const std::uint32_t v = pass.sample;
        if (!pass.isRingWhole) {
          forNeighbours(v, [&](std::uint32_t u) { join(v, u); });
          continue;
        }
        unsigned mask = 0;
        for (unsigned bit = 0; bit < kRing; ++bit) mask |= unsigned(before(beside(v, bit), v)) << bit;
        for (unsigned begins = kTables.begins[mask]; begins != 0; begins &= begins - 1)
          join(v, beside(v, unsigned(std::countr_zero(begins))));
      }
    return links;
  }

 private:
  /// A sample that may join trees.
  struct Pass {
    std::uint32_t sample;
    bool isRingWhole;
  };

  void scanRow(std::uint32_t row, FeatureParents& parents) {
    std::vector<Pass>& passes = passesOfRow_[row];
    const double* const heights = field_.heights.data();
    const std::uint32_t begin = field_.index(0, row), end = begin + field_.columns;
    const bool isInside = row > 0 && row + 1 < field_.rows;
    for (std::uint32_t v = begin; v < end; ++v) {
      if (isInside && v > begin && v + 1 < end) {
        const double* const z = heights + v;
        const std::ptrdiff_t c = columns_;
        // Of equal heights the one with the smaller index is lower. NaN is neither lower nor higher.
        const unsigned lower = unsigned(z[-c] <= z[0]) | unsigned(z[-c - 1] <= z[0]) << 1 |
                               unsigned(z[-1] <= z[0]) << 2 | unsigned(z[c] < z[0]) << 3 |
                               unsigned(z[c + 1] < z[0]) << 4 | unsigned(z[1] < z[0]) << 5;
        const unsigned higher = unsigned(z[-c] > z[0]) | unsigned(z[-c - 1] > z[0]) << 1 |
                                unsigned(z[-1] > z[0]) << 2 | unsigned(z[c] >= z[0]) << 3 |
                                unsigned(z[c + 1] >= z[0]) << 4 | unsigned(z[1] >= z[0]) << 5;
        if ((lower | higher) == kMasks - 1) {
          parents.lower[v] = beside(v, kTables.first[lower]);
          parents.higher[v] = beside(v, kTables.first[higher]);
          if (kTables.isPass[lower]) passes.push_back({v, true});
          continue;
        }
      }
      parents.lower[v] = parents.higher[v] = v;
      if (heights[v] != heights[v]) continue;
      const LowerVertex isLower(field_.heights);
      forNeighbours(v, [&](std::uint32_t u) { (isLower(u, v) ? parents.lower : parents.higher)[v] = u; });
      passes.push_back({v, false});
    }
  }

  std::uint32_t beside(std::uint32_t v, unsigned bit) const {
    return static_cast<std::uint32_t>(std::ptrdiff_t(v) + ring_[bit]);
  }

  /// visit(u) for the neighbours of v in the triangulation; some are visited twice.
  template <class Visit>
  void forNeighbours(std::uint32_t v, const Visit& visit) const {
    const std::uint32_t column = v % field_.columns, row = v / field_.columns;
    for (const std::uint32_t r : {row - 1, row})
      for (const std::uint32_t c : {column - 1, column}) {
        // Column or row -1 wraps to the largest unsigned number, which is beyond the raster.
        if (c >= field_.columns - 1 || r >= field_.rows - 1) continue;
        cells_.forTriangles(c, r, cells_.valid(c, r), [&](const RasterCells::Corners& corners) {
          if (corners[0] != v && corners[1] != v && corners[2] != v) return;
          for (const std::uint32_t u : corners)
            if (u != v) visit(u);
        });
      }
  }

  const RasterHeightfield& field_;
  RasterCells cells_;
  std::ptrdiff_t columns_;
  std::array<std::ptrdiff_t, kRing + 1> ring_;
  std::vector<std::vector<Pass>> passesOfRow_;
};

}  // namespace

std::vector<Feature> rankFeatures(const RasterHeightfield& field, const FeatureOptions& options,
                                  const RunContext& context) {
  context.report(kRasterStage, 0);
  std::vector<Feature> ranked = withThreads(context, [&] {
    Lattice lattice(field);
    FeatureParents parents = lattice.parents();
    const auto linksOf = [&](const auto& before, const FeatureTrees& trees) {
      return lattice.links(before, trees);
    };
    return rankFeaturesOf(field.heights, std::move(parents), linksOf, options, context);
  });
  if (!context.cancelled()) context.report(kRasterStage, 1);
  return ranked;
}

}  // namespace arete
