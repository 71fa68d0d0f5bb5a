// SPDX-License-Identifier: GPL-3.0-or-later
//
// A vertex is raised to where the residuals of its star, each with the vertex's weight there, sum to its
// target. With the target 0 that is a step of Gauss and Seidel's method towards least squares. Where every
// vertex has reached 0, the residuals sum to 0 around every vertex, and so on the whole, because the three
// weights of a sample sum to 1. Such a system is well conditioned whatever the mesh, so a few sweeps over all
// vertices suffice.
//
// A vertex never moves so far that a sample leaves its bound: every state is within the bounds. So that one
// sample at its bound does not stop all three vertices around it, residuals near their bounds count more and
// are reduced first. Bounds stop some vertices nevertheless (5 % of a coarse cut), and fixed vertices do not
// move. What these leave is in the means of the cells around them. The means are determined, from small cells
// to the whole, and the targets of the vertices in a cell are lowered by its mean until it is gone.
//
// Vertices without a common triangle move at the same time, so the result does not depend on the threads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/fit/neighbourhoods.h"
#include "terrain/fit/rows.h"
#include "terrain/fit/steps.h"

namespace arete {
namespace {

/// The largest |residual| / bound of samples that move: rounding does not break the bound.
constexpr double kWithin = 1 - 0x1p-36;
/// A smaller weight moves a sample by less than rounding does.
constexpr double kSmallestWeight = 1e-14;
/// From here, in bounds, a residual counts more: by kUrgency times what is beyond.
constexpr double kUrgent = 0.8, kUrgency = 20;
constexpr int kFirstSweeps = 8;     // towards least squares
constexpr int kSweepsOfARound = 2;  // after targets have changed
constexpr int kRounds = 4;          // for cells of one size
constexpr int kLastRounds = 24;     // for the whole
/// Means up to this, in bounds, stay in cells; on the whole.
constexpr double kNoMean = 1e-3, kNoMeanOfAll = 1e-4;
/// Another round must leave less than this part of the worst mean; on the whole.
constexpr double kWorthwhile = 0.8, kWorthwhileForAll = 0.99;
constexpr double kLargestTarget = 0.5;   // in bounds
constexpr double kVerticesOfACell = 64;  // of the smallest cells, on average
constexpr double kMostAcross = 64;       // cells

class MeanRemoval {
 public:
  MeanRemoval(FitMesh& mesh, const RunContext& context)
      : mesh_(mesh),
        context_(context),
        rows_(mesh),
        groups_(independentVertices(mesh)),
        target_(mesh.vertexCount(), 0) {}

  Status run() {
    const double smallest = std::sqrt(double(mesh_.vertexCount()) / kVerticesOfACell);
    const auto across = static_cast<std::uint32_t>(std::clamp(smallest, 1.0, kMostAcross));
    const double levels = 1 + std::floor(std::log2(double(across)));
    ARETE_CHECK(sweep(kFirstSweeps));
    double done = 1;
    for (std::uint32_t cells = across; cells > 1; cells /= 2) {
      context_.report("fitting", done++ / (levels + 1));
      ARETE_CHECK(removeMeans(cellsOf(mesh_, cells), kRounds, kNoMean, kWorthwhile));
    }
    context_.report("fitting", levels / (levels + 1));
    return removeMeans(cellsOf(mesh_, 1), kLastRounds, kNoMeanOfAll, kWorthwhileForAll);
  }

 private:
  Status sweep(int times) {
    for (int i = 0; i < times; ++i) {
      for (const std::vector<std::uint32_t>& group : groups_)
        parallelFor(IndexRange<std::size_t>(0, group.size(), 64), [&](const auto& range) {
          if (context_.cancelled()) return;
          for (std::size_t k = range.begin(); k != range.end(); ++k) mesh_.raise(group[k], riseOf(group[k]));
        });
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the fit was interrupted");
    }
    return {};
  }

  /// The heights of a triangle's corners.
  std::array<double, 3> heightsOf(std::uint32_t slot) const {
    const FitMesh::Corners& c = mesh_.triangle(slot).corners;
    return {mesh_.heights()[c[0]], mesh_.heights()[c[1]], mesh_.heights()[c[2]]};
  }

  /// visit(residual, weight), both divided by the bound, for the rows around a vertex that it moves.
  template <class Visit>
  void forRows(std::uint32_t vertex, const Visit& visit) const {
    mesh_.forStar(vertex, [&](std::uint32_t slot) {
      const FitMesh::Corners& corners = mesh_.triangle(slot).corners;
      const int own = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
      const std::array<double, 3> heights = heightsOf(slot);
      const auto rows = rows_.of(slot);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].weight[own] <= kSmallestWeight) continue;
        const double perBound = rows_.perBound(slot, i);
        visit(residualOf(rows[i], heights) * perBound, rows[i].weight[own] * perBound);
      }
    });
  }

  double riseOf(std::uint32_t vertex) const {
    double pull = 0, squares = 0;
    forRows(vertex, [&](double residual, double weight) {
      double urgency = 0, beyond = 0;
      if (std::abs(residual) > kUrgent) {
        urgency = kUrgency;
        beyond = residual - std::copysign(kUrgent, residual);
      }
      pull += weight * (target_[vertex] - residual - urgency * beyond);
      squares += weight * weight * (1 + urgency);
    });
    if (!(squares > 0)) return 0;
    double by = pull / squares;
    // The new height is rounded, by this at most.
    const double rounding =
        std::numeric_limits<double>::epsilon() * (std::abs(mesh_.heights()[vertex]) + std::abs(by));
    forRows(vertex, [&](double residual, double weight) {
      if (by > 0 && residual + weight * (by + rounding) > kWithin)
        by = std::max(0.0, (kWithin - residual) / weight - rounding);
      if (by < 0 && residual + weight * (by - rounding) < -kWithin)
        by = std::min(0.0, (-kWithin - residual) / weight + rounding);
    });
    return std::isfinite(by) ? by : 0;
  }

  /// Lowers the targets of cells by their means, as long as that reduces the worst of them.
  Status removeMeans(const FitCells& cells, int rounds, double enough, double worthwhile) {
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
      const std::vector<double> mean = means(cells);
      double worst = 0;
      for (const double m : mean) worst = std::max(worst, std::abs(m));
      if (worst <= enough || !(worst < worthwhile * last)) return {};
      last = worst;
      for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v) {
        const double above = mean[2 * std::size_t(cells.ofVertex[v]) + std::size_t(isLoose(v))];
        target_[v] = std::clamp(target_[v] - above, -kLargestTarget, kLargestTarget);
      }
      ARETE_CHECK(sweep(kSweepsOfARound));
    }
    return {};
  }

  bool isLoose(std::uint32_t vertex) const {
    return mesh_.bounds().at(mesh_.mtVertex(vertex)) > mesh_.bounds().everywhere;
  }

  /// Of each cell the mean residual / bound of its samples with the least bound, then of its loose ones.
  std::vector<double> means(const FitCells& cells) const {
    std::vector<double> sum(2 * std::size_t(cells.count), 0), count(sum);
    for (std::uint32_t t = 0; t < mesh_.slotCount(); ++t) {
      if (!mesh_.isLive(t)) continue;
      const std::array<double, 3> heights = heightsOf(t);
      const auto rows = rows_.of(t);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t at = 2 * std::size_t(cells.ofSlot[t]) + std::size_t(rows_.isLoose(t, i));
        sum[at] += residualOf(rows[i], heights) * rows_.perBound(t, i);
        count[at] += 1;
      }
    }
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] /= std::max(1.0, count[c]);
    return sum;
  }

  FitMesh& mesh_;
  const RunContext& context_;
  FitRows rows_;
  std::vector<std::vector<std::uint32_t>> groups_;
  std::vector<double> target_;  // per vertex: of the mean of residual / bound around it
};

}  // namespace

Status removeMeanErrors(FitMesh& mesh, const RunContext& context) {
  return withThreads(context, [&] { return MeanRemoval(mesh, context).run(); });
}

}  // namespace arete
