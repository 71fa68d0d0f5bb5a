// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/sided_nearest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/box3.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

/// What another triangle at a seam shows is nearer if it is nearer by this factor.
constexpr double kMuchNearer = 0.25;
/// Another side of a seam is at most this factor farther, or a share of the diagonal.
constexpr double kOtherSide = 3, kOtherSideOfDiagonal = 0.01;
constexpr std::size_t kSamplesOfRun = 1024;

/// By vertex with several wedges: the triangles at it.
class SeamStars {
 public:
  explicit SeamStars(const SurfaceMesh& cut) : starOf_(cut.positions.size()) {
    if (!cut.hasWedges()) return;
    std::vector<std::uint32_t> first(cut.positions.size(), MeshAttributes::kNone);
    std::vector<std::uint8_t> isOnSeam(cut.positions.size(), 0);
    for (std::size_t t = 0; t < cut.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint32_t& wedge = first[cut.triangles[t][c]];
        if (wedge == MeshAttributes::kNone) wedge = cut.wedges[t][c];
        if (wedge != cut.wedges[t][c]) isOnSeam[cut.triangles[t][c]] = 1;
      }
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t)
      for (const std::uint32_t v : cut.triangles[t])
        if (isOnSeam[v] != 0) starOf_[v].push_back(t);
  }
  const std::vector<std::uint32_t>& operator[](std::uint32_t vertex) const { return starOf_[vertex]; }

 private:
  std::vector<std::vector<std::uint32_t>> starOf_;
};

/// Numbers sorted by their charts.
std::vector<std::uint32_t> sortedByChart(const std::vector<std::uint32_t>& chartOf) {
  std::vector<std::uint32_t> order(chartOf.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return chartOf[i]; });
  return order;
}

}  // namespace

std::vector<NearestOfCut> sidedNearest(const SurfaceMesh& cut, const SourceSamples& samples,
                                       std::span<const std::uint32_t> chartOfSource,
                                       std::span<const std::uint32_t> chartOfCut,
                                       const ShownDistance& shown) {
  std::vector<NearestOfCut> nearest(samples.ofArea.size());
  const bool hasCharts = !chartOfSource.empty() && !chartOfCut.empty();
  std::vector<std::uint32_t> chartOfSample, chartOfTriangle;
  for (const SourceSamples::Where& at : samples.whereOfArea)
    chartOfSample.push_back(hasCharts ? chartOfSource[at.triangle] : 0);
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    chartOfTriangle.push_back(hasCharts ? chartOfCut[t] : 0);
  const std::vector<std::uint32_t> order = sortedByChart(chartOfSample),
                                   some = sortedByChart(chartOfTriangle);
  const SeamStars stars(cut);
  Box3 box = Box3::empty();
  for (const Vec3& p : cut.positions) box.include(p);
  const double slack = kOtherSideOfDiagonal * norm(box.high - box.low);

  std::size_t firstTriangle = 0;
  for (std::size_t begin = 0; begin < order.size();) {
    const std::uint32_t chart = chartOfSample[order[begin]];
    std::size_t end = begin;
    while (end < order.size() && chartOfSample[order[end]] == chart) ++end;
    while (firstTriangle < some.size() && chartOfTriangle[some[firstTriangle]] < chart) ++firstTriangle;
    std::vector<TriangleBvh::Corners> triangles;
    const std::size_t first = firstTriangle;
    for (; firstTriangle < some.size() && chartOfTriangle[some[firstTriangle]] == chart; ++firstTriangle)
      triangles.push_back(cut.triangles[some[firstTriangle]]);
    if (triangles.empty()) {
      begin = end;
      continue;
    }
    const TriangleBvh bvh(cut.positions, triangles);
    const auto find = [&](std::size_t i, std::uint32_t guess) {
      const std::uint32_t sample = order[i];
      const Vec3& p = samples.ofArea[sample];
      const TriangleBvh::Answer answer = bvh.nearest(p, guess);
      NearestOfCut& found = nearest[sample];
      found = {some[first + answer.triangle], answer.point.shares};
      if (!shown) return answer.triangle;
      const double most = kOtherSide * std::sqrt(answer.squaredDistance) + slack;
      double least = -1;
      const auto corners = cut.triangles[found.triangle];
      for (const std::uint32_t v : corners)
        for (const std::uint32_t t : stars[v]) {
          if (chartOfTriangle[t] != chart || t == found.triangle) continue;
          if (least < 0) least = kMuchNearer * shown(sample, found.triangle, found.shares);
          const auto& [a, b, c] = cut.triangles[t];
          const TrianglePoint point =
              nearestWithShares(p, {cut.positions[a], cut.positions[b], cut.positions[c]});
          if (norm(p - point.place) > most) continue;
          const double distance = shown(sample, t, point.shares);
          if (!(distance < least)) continue;
          least = distance;
          found = {t, point.shares};
        }
      return answer.triangle;
    };
    const std::size_t runs = (end - begin + kSamplesOfRun - 1) / kSamplesOfRun;
    parallelFor(std::size_t(0), runs, [&](std::size_t run) {
      std::uint32_t guess = TriangleBvh::kNone;
      const std::size_t last = std::min(end, begin + (run + 1) * kSamplesOfRun);
      for (std::size_t i = begin + run * kSamplesOfRun; i < last; ++i) guess = find(i, guess);
    });
    begin = end;
  }
  return nearest;
}

}  // namespace arete
