// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points are corners and middles of sides, once for each side of a seam: where several triangles of the
// source have the same numbers at one place it is one point. Then points spread over the area. For each the
// triangles of the mesh within E are found once for all numbers; where a bound says that they have
// nothing nearer than what is found are skipped. Sums are added in the order of the points.
#include "measure/near_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_set>
#include <utility>

#include "engine/base/box3.h"
#include "engine/base/caught_failure.h"
#include "engine/base/triangle_bvh.h"
#include "engine/parallel/each_task.h"
#include "measure/least_on_triangle.h"
#include "measure/nearest_on_mesh.h"
#include "measure/surface_samples.h"
#include "measure/triangles_within.h"

namespace arete {
namespace {

constexpr std::size_t kPointsPerRun = 1024;
constexpr std::uint64_t kLeastSpread = 100'000, kSpreadPerTriangle = 2;
/// Of the diagonal, where the search for a chart that is farther begins.
constexpr double kReachFrom = 1.0 / 1024;
constexpr int kSteps = 20, kFineSteps = 40;
constexpr std::size_t kMany = 64;  // triangles within E
/// Of the largest number, or of 180 degrees: what is nearer is not searched further.
constexpr double kNumberSlack = 1e-12;

/// A point of the source: of a triangle, by the shares of its corners.
struct SourcePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> shares{};
};

std::uint64_t mixedInto(std::uint64_t hash, std::uint64_t more) {
  std::uint64_t x = (hash ^ more) + 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

/// Linear; numbers that are not interpolated are the heaviest corner's.
void numbersAt(const ComparedNumbers& of, const SourcePoint& x, std::vector<double>& numbers) {
  const std::size_t n = of.components;
  const double* const corners = of.ofSource.data() + std::size_t{3} * n * x.triangle;
  numbers.assign(n, 0);
  if (of.norm == NumbersNorm::equality) {
    const auto heaviest = static_cast<std::size_t>(std::ranges::max_element(x.shares) - x.shares.begin());
    std::copy_n(corners + heaviest * n, n, numbers.begin());
    return;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < n && x.shares[i] != 0; ++c) numbers[c] += x.shares[i] * corners[i * n + c];
}

/// What is found of one kind of numbers at a run of points, or at several runs.
struct NearTotals {
  NumbersFound found;
  double sum = 0, squares = 0, sumAtNearest = 0, squaresAtNearest = 0;
  std::uint64_t finite = 0, finiteAtNearest = 0;

  void take(double apart, double atNearest, const Vec3& x, const std::optional<Vec3>& y, bool isSpread) {
    ++found.points;
    found.unequal += std::isinf(apart);
    if (found.points == 1 || apart > found.largest) {
      found.largest = apart;
      found.worst = x;
      found.worstNear = y;
    }
    if (!isSpread) return;
    if (std::isfinite(apart)) {
      ++finite;
      sum += apart;
      squares += apart * apart;
    }
    if (std::isfinite(atNearest)) {
      ++finiteAtNearest;
      sumAtNearest += atNearest;
      squaresAtNearest += atNearest * atNearest;
    }
  }
  void add(const NearTotals& later) {
    if (later.found.points == 0) return;
    if (found.points == 0 || later.found.largest > found.largest) {
      found.largest = later.found.largest;
      found.worst = later.found.worst;
      found.worstNear = later.found.worstNear;
    }
    found.points += later.found.points;
    found.unequal += later.found.unequal;
    found.beyond += later.found.beyond;
    sum += later.sum;
    squares += later.squares;
    sumAtNearest += later.sumAtNearest;
    squaresAtNearest += later.squaresAtNearest;
    finite += later.finite;
    finiteAtNearest += later.finiteAtNearest;
  }
  NumbersFound figures() const {
    NumbersFound all = found;
    const auto n = static_cast<double>(std::max<std::uint64_t>(finite, 1)),
               m = static_cast<double>(std::max<std::uint64_t>(finiteAtNearest, 1));
    all.mean = sum / n;
    all.rms = std::sqrt(squares / n);
    all.meanAtNearest = sumAtNearest / m;
    all.rmsAtNearest = std::sqrt(squaresAtNearest / m);
    return all;
  }
};

Box3 commonBox(const TriangleMesh& a, const TriangleMesh& b) {
  Box3 box = Box3::empty();
  for (const TriangleMesh* mesh : {&a, &b})
    for (const auto& t : mesh->triangles)
      for (const std::uint32_t v : t) box.include(mesh->positions[v]);
  return box;
}

class NearNumbers {
 public:
  NearNumbers(const TriangleMesh& mesh, const TriangleMesh& source,
              const std::vector<ComparedNumbers>& compared, const NearNumbersOptions& options,
              const RunContext& context, double rounding)
      : source_(source),
        compared_(compared),
        context_(context),
        within_(options.within + rounding),
        rounding_(rounding),
        reach_(options.reachesOwn ? 2 * commonBox(mesh, source).diagonal() : 0),
        tree_(mesh),
        nearest_(mesh) {
    for (const ComparedNumbers& of : compared) {
      double most = of.norm == NumbersNorm::angle ? 180 : 0;
      for (const double x : of.ofMesh)
        if (of.norm != NumbersNorm::angle && std::isfinite(x)) most = std::max(most, std::abs(x));
      slack_.push_back(kNumberSlack * most);
    }
    takeCornersAndSides();
    spreadFrom_ = points_.size();
    takeSpread(options);
  }

  Result<std::vector<NumbersFound>> measure(const Vec3& origin) {
    const std::size_t runs = (points_.size() + kPointsPerRun - 1) / kPointsPerRun;
    std::vector<std::vector<NearTotals>> totals(runs, std::vector<NearTotals>(compared_.size()));
    ARETE_CHECK(forEachTask(runs, context_, "attributes", [&](std::size_t run) { take(run, totals[run]); }));
    std::vector<NumbersFound> found;
    for (std::size_t k = 0; k < compared_.size(); ++k) {
      NearTotals all;
      for (const auto& run : totals) all.add(run[k]);
      found.push_back(all.figures());
      found.back().worst = found.back().worst + origin;
      if (found.back().worstNear) *found.back().worstNear = *found.back().worstNear + origin;
    }
    return found;
  }

 private:
  Vec3 placeOf(const SourcePoint& x) const {
    const auto& t = source_.triangles[x.triangle];
    for (std::size_t i = 0; i < 3; ++i)
      if (x.shares[i] == 1) return source_.positions[t[i]];
    return x.shares[0] * source_.positions[t[0]] + x.shares[1] * source_.positions[t[1]] +
           x.shares[2] * source_.positions[t[2]];
  }

  void takeCornersAndSides() {
    std::unordered_set<std::uint64_t> seen;
    std::vector<double> numbers;
    const auto takeOnce = [&](const SourcePoint& x, std::uint64_t place) {
      std::uint64_t hash = mixedInto(0, place);
      for (const ComparedNumbers& of : compared_) {
        numbersAt(of, x, numbers);
        if (!of.partOfSource.empty()) hash = mixedInto(hash, of.partOfSource[x.triangle]);
        if (!of.chartOfSource.empty()) hash = mixedInto(hash, of.chartOfSource[x.triangle]);
        for (const double number : numbers) hash = mixedInto(hash, std::bit_cast<std::uint64_t>(number));
      }
      if (seen.insert(hash).second) points_.push_back(x);
    };
    for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
      const auto& v = source_.triangles[t];
      // What has no area shows nothing of its numbers.
      if (areaNormal({source_.positions[v[0]], source_.positions[v[1]], source_.positions[v[2]]}) == Vec3{})
        continue;
      for (std::size_t i = 0; i < 3; ++i) {
        SourcePoint corner{t, {}};
        corner.shares[i] = 1;
        takeOnce(corner, v[i]);
        const std::size_t next = (i + 1) % 3;
        SourcePoint middle{t, {}};
        middle.shares[i] = middle.shares[next] = 0.5;
        takeOnce(middle, (std::uint64_t{std::min(v[i], v[next])} + 1) << 32 | std::max(v[i], v[next]));
      }
    }
  }

  void takeSpread(const NearNumbersOptions& options) {
    const std::uint64_t count = options.samples > 0
                                    ? options.samples
                                    : std::max(kLeastSpread, kSpreadPerTriangle * source_.triangles.size());
    const SurfaceSamples samples(source_, count, options.seed);
    points_.reserve(points_.size() + count);
    std::uint32_t triangle = samples.triangleOf(0);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Vec3 p = samples.at(i, triangle);
      const auto& t = source_.triangles[triangle];
      points_.push_back({triangle, nearestWithShares(p, {source_.positions[t[0]], source_.positions[t[1]],
                                                         source_.positions[t[2]]})
                                       .shares});
    }
  }

  void take(std::size_t run, std::vector<NearTotals>& totals) const {
    std::vector<TrianglesWithin::Near> near, nearest;
    std::vector<double> numbers;
    std::vector<LeastOnTriangle> least;
    for (const ComparedNumbers& of : compared_) least.emplace_back(of.norm, of.components);
    const std::size_t end = std::min(points_.size(), (run + 1) * kPointsPerRun);
    for (std::size_t i = run * kPointsPerRun; i < end; ++i) {
      const SourcePoint& point = points_[i];
      const Vec3 x = placeOf(point);
      const bool isSpread = i >= spreadFrom_;
      // Those that hold the nearest point: several on a side.
      if (isSpread) tree_.find(x, nearest_.nearest(x).distance + rounding_, nearest);
      std::vector<LeastOnTriangle::Found> best(compared_.size(),
                                               {std::numeric_limits<double>::infinity(), x});
      // Where many are near, the nearest may do.
      const bool areFew = tree_.find(x, within_, near, kMany);
      for (double within = areFew ? within_ : within_ / 64;; within *= 4) {
        const bool isAll = within >= within_;
        if (!areFew) tree_.find(x, isAll ? within_ : within, near);
        bool isDone = true;
        for (std::size_t k = 0; k < compared_.size(); ++k) {
          if (partOf(k, point) == ComparedNumbers::kNotCompared) continue;
          numbersAt(compared_[k], point, numbers);
          best[k] = leastOf(k, point, numbers, x, near, least[k], best[k], isAll);
          isDone = isDone && best[k].apart <= slack_[k];
        }
        if (isAll || isDone) break;
      }
      for (std::size_t k = 0; k < compared_.size() && reach_ > 0; ++k)
        if (std::isinf(best[k].apart) && partOf(k, point) != ComparedNumbers::kNotCompared)
          if (const auto own = nearestOwn(k, point, x, near, least[k])) {
            best[k] = *own;
            ++totals[k].found.beyond;
          }
      for (std::size_t k = 0; k < compared_.size(); ++k) {
        if (partOf(k, point) == ComparedNumbers::kNotCompared) continue;
        numbersAt(compared_[k], point, numbers);
        const double atNearest = isSpread ? atNearestOf(k, numbers, nearest, least[k]) : 0;
        totals[k].take(best[k].apart, atNearest, x,
                       std::isfinite(best[k].apart) ? std::optional(best[k].place) : std::nullopt, isSpread);
      }
    }
  }

  std::uint32_t partOf(std::size_t k, const SourcePoint& point) const {
    const auto& parts = compared_[k].partOfSource;
    return parts.empty() ? ComparedNumbers::kNoPart : parts[point.triangle];
  }

  std::span<const double> cornersOf(std::size_t k, std::uint32_t triangle) const {
    const std::size_t n = 3 * compared_[k].components;
    return std::span(compared_[k].ofMesh).subspan(n * triangle, n);
  }

  bool mayHold(std::size_t k, const SourcePoint& point, std::uint32_t triangle) const {
    constexpr std::uint32_t kAny = ComparedNumbers::kNoPart;
    const ComparedNumbers& of = compared_[k];
    const std::uint32_t part = partOf(k, point);
    if (part != kAny && !of.partOfMesh.empty() && of.partOfMesh[triangle] != part) return false;
    if (of.chartOfSource.empty() || of.chartOfMesh.empty()) return true;
    const std::uint32_t chart = of.chartOfSource[point.triangle], there = of.chartOfMesh[triangle];
    return chart == kAny || there == kAny || chart == there;
  }

  LeastOnTriangle::Found leastOf(std::size_t k, const SourcePoint& point, std::span<const double> numbers,
                                 const Vec3& x, std::span<const TrianglesWithin::Near> near,
                                 LeastOnTriangle& least, LeastOnTriangle::Found best, bool isFine) const {
    const ComparedNumbers& of = compared_[k];
    std::vector<std::pair<double, const TrianglesWithin::Near*>> order;
    for (const TrianglesWithin::Near& n : near) {
      if (!mayHold(k, point, n.triangle)) continue;
      order.emplace_back(least.atLeast(tree_.at(n.triangle), cornersOf(k, n.triangle), numbers, x, within_),
                         &n);
    }
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) {
      return a.first < b.first ||
             (a.first == b.first && a.second->squaredDistance < b.second->squaredDistance);
    });
    const auto search = [&](int steps) {
      for (const auto& [bound, n] : order) {
        if (best.apart <= slack_[k] || bound >= best.apart) break;
        const LeastOnTriangle::Found here = least.find(tree_.at(n->triangle), cornersOf(k, n->triangle),
                                                       numbers, x, within_, n->nearest, steps);
        if (here.apart < best.apart) best = here;
      }
    };
    search(kSteps);
    if (isFine && best.apart > of.expected && of.norm != NumbersNorm::equality) search(kFineSteps);
    return best;
  }

  /// At the nearest point of what it may be compared with; nothing if some of that is within E, or none is at
  /// all.
  std::optional<LeastOnTriangle::Found> nearestOwn(std::size_t k, const SourcePoint& point, const Vec3& x,
                                                   std::vector<TrianglesWithin::Near>& near,
                                                   LeastOnTriangle& least) const {
    std::vector<double> numbers;
    numbersAt(compared_[k], point, numbers);
    std::vector<TrianglesWithin::Near> own;
    for (double radius = within_; own.empty() && radius <= reach_;
         radius = std::max(4 * radius, kReachFrom * reach_)) {
      tree_.find(x, radius, near);
      for (const TrianglesWithin::Near& n : near)
        if (mayHold(k, point, n.triangle)) own.push_back(n);
      if (!own.empty() && radius == within_) return std::nullopt;
    }
    if (own.empty()) return std::nullopt;
    const auto first = std::ranges::min_element(own, {}, &TrianglesWithin::Near::squaredDistance);
    const double most = std::sqrt(first->squaredDistance) + rounding_;
    std::erase_if(own, [&](const auto& n) { return n.squaredDistance > most * most; });
    return LeastOnTriangle::Found{atNearestOf(k, numbers, own, least), own.front().nearest};
  }

  double atNearestOf(std::size_t k, std::span<const double> numbers,
                     std::span<const TrianglesWithin::Near> nearest, LeastOnTriangle& least) const {
    double apart = std::numeric_limits<double>::infinity();
    for (const TrianglesWithin::Near& n : nearest) {
      const auto there = least.at(tree_.at(n.triangle), cornersOf(k, n.triangle), n.nearest);
      apart = std::min(apart, numbersApart(compared_[k].norm, numbers, there));
    }
    return apart;
  }

  const TriangleMesh& source_;
  const std::vector<ComparedNumbers>& compared_;
  const RunContext& context_;
  double within_, rounding_, reach_;
  TrianglesWithin tree_;
  NearestOnMesh nearest_;
  std::vector<SourcePoint> points_;
  std::size_t spreadFrom_ = 0;
  std::vector<double> slack_;
};

TriangleMesh about(const TriangleMesh& mesh, const Vec3& origin) {
  TriangleMesh moved{mesh.positions, mesh.triangles};
  for (Vec3& p : moved.positions) p = p - origin;
  return moved;
}

}  // namespace

Result<std::vector<NumbersFound>> measureNearNumbers(const TriangleMesh& mesh, const TriangleMesh& source,
                                                     const std::vector<ComparedNumbers>& compared,
                                                     const NearNumbersOptions& options,
                                                     const RunContext& context) try {
  for (const auto& [which, of] : {std::pair("first", &mesh), std::pair("second", &source)}) {
    if (const Status ok = of->validate(); !ok) return failure(ok.error().code, ok.error().message, which);
    if (!(surfaceArea(*of) > 0))
      return failure(ErrorCode::degenerate, "holds no triangle that has area", which);
  }
  const Box3 box = commonBox(mesh, source);
  if (!std::isfinite(std::pow(box.diagonal(), 4)))
    return failure(ErrorCode::invalidData,
                   "the coordinates are too large, or too far apart, to measure between");
  const Vec3 origin{std::midpoint(box.low.x, box.high.x), std::midpoint(box.low.y, box.high.y),
                    std::midpoint(box.low.z, box.high.z)};
  double largest = 0;
  for (const Vec3& p : {box.low, box.high})
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  // What a distance may be wrong by, as in checkDistance().
  const double rounding = 16 * (std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest);
  const TriangleMesh movedMesh = about(mesh, origin), movedSource = about(source, origin);
  NearNumbers near(movedMesh, movedSource, compared, options, context, rounding);
  return near.measure(origin);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
