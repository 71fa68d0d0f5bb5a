// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/distance_by_chart.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "measure/mesh_distance.h"
#include "surface/model/charts.h"

namespace arete {
namespace {

/// The triangles of a mesh, chart by chart.
class ByChart {
 public:
  ByChart(const TriangleMesh& mesh, const std::vector<std::uint32_t>& chartOf)
      : mesh_(mesh), chartOf_(chartOf), order_(chartOf.size()), number_(mesh.positions.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t t) { return chartOf_[t]; });
  }

  /// The next chart; its triangles are taken.
  std::uint32_t chart() const { return chartOf_[order_[at_]]; }
  bool isDone() const { return at_ == order_.size(); }
  TriangleMesh take() {
    const std::uint32_t chart = this->chart();
    TriangleMesh part;
    std::vector<std::uint32_t> used;
    for (; !isDone() && chartOf_[order_[at_]] == chart; ++at_) {
      auto& corners = part.triangles.emplace_back(mesh_.triangles[order_[at_]]);
      for (std::uint32_t& v : corners) {
        if (number_[v] == 0) {
          part.positions.push_back(mesh_.positions[v]);
          used.push_back(v);
          number_[v] = static_cast<std::uint32_t>(used.size());
        }
        v = number_[v] - 1;
      }
    }
    for (const std::uint32_t v : used) number_[v] = 0;
    return part;
  }

 private:
  const TriangleMesh& mesh_;
  const std::vector<std::uint32_t>& chartOf_;
  std::vector<std::uint32_t> order_, number_;
  std::size_t at_ = 0;
};

std::vector<std::uint32_t> taken(const std::vector<std::uint32_t>& charts, const Cut& cut) {
  std::vector<std::uint32_t> some;
  if (charts.empty()) return some;
  for (const std::uint32_t id : cut.ids) some.push_back(charts[id]);
  return some;
}

}  // namespace

ChartsOfCut chartsOfCut(const SurfaceModel& model, const Cut& source, const Cut& cut) {
  const std::vector<std::uint32_t> charts = chartsOf(model);
  return {taken(charts, source), taken(charts, cut)};
}

Result<double> distanceByChart(const TriangleMesh& source, const TriangleMesh& mesh,
                               const ChartsOfCut& charts, const RunContext& context) {
  if (charts.ofSource.empty()) return farthestDistance(source, mesh, context);
  double atMost = 0;
  ByChart ofSource(source, charts.ofSource), ofMesh(mesh, charts.ofCut);
  while (!ofSource.isDone()) {
    while (!ofMesh.isDone() && ofMesh.chart() < ofSource.chart()) ofMesh.take();
    if (ofMesh.isDone() || ofMesh.chart() != ofSource.chart()) return std::numeric_limits<double>::infinity();
    const TriangleMesh from = ofSource.take(), to = ofMesh.take();
    // The search for the bound has as many steps in each triangle as the samples allow.
    constexpr std::uint64_t kSamples = 200'000;
    const std::uint64_t triangles = std::max(from.triangles.size(), to.triangles.size());
    const std::uint64_t samples = std::max(10 * triangles, kSamples * triangles / source.triangles.size());
    const Result<double> distance = farthestDistance(from, to, context, samples);
    if (!distance && distance.error().code == ErrorCode::degenerate)
      return std::numeric_limits<double>::infinity();
    if (!distance) return distance;
    atMost = std::max(atMost, *distance);
  }
  return atMost;
}

}  // namespace arete
