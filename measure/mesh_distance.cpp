// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both meshes are moved so that the middle of their common box is the origin: with the coordinates of a
// projected CRS, millions of metres, squares of lengths would lose the millimetres. Then the nearest point of
// the other mesh is computed for each vertex and each sample. Runs of vertices and of samples are independent
// tasks; their sums are added in order, so that no rounding depends on the number of threads.
//
// The largest of these distances is the start of the search for the farthest point
// (measure/farthest_point.h). Most triangles are decided by their corners; the rest are bisected
// where a farther point is possible. Tasks of the search do not share what they find: the result would depend
// on their timing.
#include "measure/mesh_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "engine/base/box3.h"
#include "engine/base/caught_failure.h"
#include "engine/parallel/each_task.h"
#include "measure/farthest_point.h"
#include "measure/nearest_on_mesh.h"
#include "measure/surface_samples.h"

namespace arete {
namespace {

constexpr std::uint64_t kPerRun = 4096;
constexpr std::size_t kTrianglesPerRun = 256;
constexpr std::uint64_t kSearchedPerSample = 4, kLeastSearched = 64, kMostSearched = 1 << 17;
constexpr double kSearchSlack = 1e-5;  // of the diagonal
constexpr std::uint64_t kSamplesPerTriangle = 10, kLeastSamples = 1'000'000;

/// A mesh moved to the common origin, and its figures.
struct Surface {
  TriangleMesh mesh;
  std::vector<std::uint8_t> isUsed;  // per vertex
  MeshSummary summary;
};

Box3 boxOf(const TriangleMesh& mesh) {
  Box3 box = Box3::empty();
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  return box;
}

Surface surfaceOf(const TriangleMesh& mesh, const Vec3& origin) {
  Surface surface;
  surface.mesh.triangles = mesh.triangles;
  surface.mesh.positions.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) surface.mesh.positions.push_back(p - origin);
  surface.isUsed.resize(mesh.positions.size());
  MeshSummary& summary = surface.summary;
  for (const auto& t : surface.mesh.triangles) {
    const Vec3 normal = areaNormal(
        {surface.mesh.positions[t[0]], surface.mesh.positions[t[1]], surface.mesh.positions[t[2]]});
    summary.degenerateTriangles += normal == Vec3{};
    for (const std::uint32_t v : t) surface.isUsed[v] = 1;
  }
  summary.triangles = mesh.triangles.size();
  summary.vertices = mesh.positions.size();
  summary.unusedVertices = static_cast<std::uint64_t>(std::ranges::count(surface.isUsed, 0));
  summary.area = surfaceArea(surface.mesh);
  summary.diagonal = boxOf(mesh).diagonal();
  return surface;
}

Status check(const TriangleMesh& mesh, const char* which) {
  if (const Status ok = mesh.validate(); !ok) return failure(ok.error().code, ok.error().message, which);
  if (mesh.triangles.empty()) return failure(ErrorCode::degenerate, "holds no triangle", which);
  return {};
}

Status check(const Surface& surface, const char* which) {
  if (surface.summary.area > 0) return {};
  return failure(ErrorCode::degenerate, "holds no triangle that has area", which);
}

/// Maximum and sums over a run of points, or over several runs.
struct RunTotals {
  double maximum = -1, sum = 0, sumSquares = 0;
  Vec3 worst, worstNearest;

  void take(const Vec3& p, const NearestOnMesh::Answer& answer) {
    sum += answer.distance;
    sumSquares += answer.distance * answer.distance;
    takeWorst(answer.distance, p, answer.point);
  }
  void takeWorst(double distance, const Vec3& p, const Vec3& nearest) {
    if (distance <= maximum) return;
    maximum = distance;
    worst = p;
    worstNearest = nearest;
  }
  void add(const RunTotals& later) {
    sum += later.sum;
    sumSquares += later.sumSquares;
    takeWorst(later.maximum, later.worst, later.worstNearest);
  }
};

std::size_t runsOf(std::uint64_t items, std::uint64_t perRun) {
  return static_cast<std::size_t>((items + perRun - 1) / perRun);
}

RunTotals sum(std::span<const RunTotals> runs) {
  RunTotals all;
  for (const RunTotals& run : runs) all.add(run);
  return all;
}

/// The distance from one mesh to the other.
class OneWay {
 public:
  OneWay(const Surface& from, const Surface& target, const MeshDistanceOptions& options,
         std::uint64_t samples, const RunContext& context)
      : from_(from),
        target_(target),
        options_(options),
        context_(context),
        to_(target.mesh),
        samples_(from.mesh, samples, options.seed),
        answers_(from.mesh.positions.size()) {}

  /// @param takesSamples  or the search alone, which knows the number of each triangle
  Result<DistanceOneWay> measure(const std::string& stage, std::vector<double>* vertexDistances,
                                 bool takesSamples = true) {
    const std::size_t vertexRuns = runsOf(answers_.size(), kPerRun);
    std::vector<RunTotals> runs(vertexRuns + (takesSamples ? runsOf(samples_.count(), kPerRun) : 0));
    Status done = forEachTask(runs.size(), context_, stage.c_str(), [&](std::size_t index) {
      if (index < vertexRuns)
        takeVertices(index, vertexDistances != nullptr, runs[index]);
      else
        takeSamples(index - vertexRuns, runs[index]);
    });
    if (!done) return tl::unexpected(done.error());
    // The distances of vertices are kept by vertex, for the caller and for the search, which begins from
    // them.
    if (vertexDistances) {
      vertexDistances->clear();
      for (const NearestOnMesh::Answer& answer : answers_) vertexDistances->push_back(answer.distance);
    }
    // Vertices bound the maximum only; means are taken over the samples, which are spread evenly over the
    // area.
    RunTotals all = sum(std::span(runs).first(vertexRuns));
    const RunTotals atSamples = sum(std::span(runs).subspan(vertexRuns));
    const auto n = static_cast<double>(samples_.count());
    DistanceOneWay found;
    found.samples = samples_.count();
    found.vertices = from_.summary.vertices - from_.summary.unusedVertices;
    found.mean = atSamples.sum / n;
    found.rms = std::sqrt(atSamples.sumSquares / n);
    found.maximumAtVertices = all.maximum;
    all.add(atSamples);

    // Without an accuracy nothing is known of the places between samples, and the upper bound is infinite.
    found.atMost = std::numeric_limits<double>::infinity();
    if (std::isfinite(options_.accuracy)) {
      std::vector<FarthestPoint> searched(runsOf(from_.mesh.triangles.size(), kTrianglesPerRun));
      done = forEachTask(searched.size(), context_, (stage + ", farthest").c_str(),
                         [&](std::size_t index) { searched[index] = search(index, all.maximum); });
      if (!done) return tl::unexpected(done.error());
      found.atMost = all.maximum;
      for (const FarthestPoint& run : searched) {
        all.takeWorst(run.distance, run.from, run.nearest);
        found.atMost = std::max(found.atMost, run.atMost);
      }
    }
    found.maximum = all.maximum;
    found.worst = all.worst;
    found.worstNearest = all.worstNearest;
    return found;
  }

 private:
  // A vertex without a triangle is not of the surface: it gets a distance only if distances of all vertices
  // are wanted.
  void takeVertices(std::size_t index, bool withUnused, RunTotals& run) {
    const std::size_t end = std::min<std::size_t>(answers_.size(), (index + 1) * kPerRun);
    for (std::size_t v = index * kPerRun; v < end; ++v) {
      if (from_.isUsed[v] == 0 && !withUnused) continue;
      answers_[v] = to_.nearest(from_.mesh.positions[v]);
      if (from_.isUsed[v] != 0) run.take(from_.mesh.positions[v], answers_[v]);
    }
  }

  void takeSamples(std::size_t index, RunTotals& run) const {
    const std::uint64_t begin = index * kPerRun, end = std::min(samples_.count(), begin + kPerRun);
    std::uint32_t triangle = samples_.triangleOf(begin);
    for (std::uint64_t i = begin; i < end; ++i) {
      const Vec3 p = samples_.at(i, triangle);
      run.take(p, to_.nearest(p));
    }
  }

  FarthestPoint search(std::size_t index, double known) const {
    FarthestPointOptions options;
    options.known = known;
    options.accuracy = options_.accuracy;
    options.slack = kSearchSlack * target_.summary.diagonal;
    options.shouldStop = [this] { return context_.cancelled(); };
    FarthestPoint farthest;
    const std::size_t end = std::min(from_.mesh.triangles.size(), (index + 1) * kTrianglesPerRun);
    for (std::size_t t = index * kTrianglesPerRun; t < end && !context_.cancelled(); ++t) {
      const auto& v = from_.mesh.triangles[t];
      const std::array answers = {answers_[v[0]], answers_[v[1]], answers_[v[2]]};
      // Four queries for each sample of the triangle.
      options.budget =
          std::min(kMostSearched,
                   kLeastSearched + kSearchedPerSample * samples_.countOf(static_cast<std::uint32_t>(t)));
      const auto& p = from_.mesh.positions;
      const FarthestPoint here =
          farthestPoint({p[v[0]], p[v[1]], p[v[2]]}, answers, target_.mesh, to_, options);
      options.known = std::max(options.known, here.distance);
      const double atMost = std::max(farthest.atMost, here.atMost);
      if (here.distance > farthest.distance) farthest = here;
      farthest.atMost = atMost;
    }
    return farthest;
  }

  const Surface& from_;
  const Surface& target_;
  const MeshDistanceOptions& options_;
  const RunContext& context_;
  NearestOnMesh to_;
  SurfaceSamples samples_;
  std::vector<NearestOnMesh::Answer> answers_;  // of the vertices
};

}  // namespace

void MeshDistanceReport::raise(double by) {
  for (DistanceOneWay* way : {&forward, &backward})
    for (double DistanceOneWay::*figure :
         {&DistanceOneWay::maximum, &DistanceOneWay::atMost, &DistanceOneWay::mean, &DistanceOneWay::rms,
          &DistanceOneWay::maximumAtVertices})
      way->*figure += by;
}

double MeshDistanceReport::hausdorff() const {
  return std::max(forward.maximum, backward.maximum);
}

double MeshDistanceReport::hausdorffAtMost() const {
  return std::max(forward.atMost, backward.atMost);
}

double MeshDistanceReport::mean() const {
  return (forward.mean * first.area + backward.mean * second.area) / (first.area + second.area);
}

double MeshDistanceReport::rms() const {
  return std::sqrt((forward.rms * forward.rms * first.area + backward.rms * backward.rms * second.area) /
                   (first.area + second.area));
}

namespace {

/// Two meshes around the middle of their common box.
struct Pair {
  Box3 box;
  Vec3 origin;
  std::array<Surface, 2> surfaces;
};

Result<Pair> pairOf(const TriangleMesh& first, const TriangleMesh& second) {
  for (const auto& [mesh, which] : {std::pair(&first, "first"), std::pair(&second, "second")})
    ARETE_CHECK(check(*mesh, which));
  Pair pair{boxOf(first), {}, {}};
  const Box3 other = boxOf(second);
  pair.box.include(other.low);
  pair.box.include(other.high);
  // Squared areas of triangles, fourth powers of lengths, are compared.
  if (!std::isfinite(std::pow(pair.box.diagonal(), 4)))
    return failure(ErrorCode::invalidData,
                   "the coordinates are too large, or too far apart, to measure between");
  const Vec3 &low = pair.box.low, &high = pair.box.high;
  pair.origin = {std::midpoint(low.x, high.x), std::midpoint(low.y, high.y), std::midpoint(low.z, high.z)};
  pair.surfaces = {surfaceOf(first, pair.origin), surfaceOf(second, pair.origin)};
  for (const auto& [surface, which] :
       {std::pair(&pair.surfaces[0], "first"), std::pair(&pair.surfaces[1], "second")})
    ARETE_CHECK(check(*surface, which));
  return pair;
}

std::uint64_t usualSamples(const TriangleMesh& first, const TriangleMesh& second) {
  return std::max({kLeastSamples, kSamplesPerTriangle * first.triangles.size(),
                   kSamplesPerTriangle * second.triangles.size()});
}

}  // namespace

Result<double> farthestDistance(const TriangleMesh& first, const TriangleMesh& second,
                                const RunContext& context, std::uint64_t samples) try {
  ARETE_TRY(const Pair pair, pairOf(first, second));
  const MeshDistanceOptions options;
  OneWay way(pair.surfaces[0], pair.surfaces[1], options, samples > 0 ? samples : usualSamples(first, second),
             context);
  ARETE_TRY(const DistanceOneWay found, way.measure("from the first to the second", nullptr, false));
  return found.atMost;
} catch (...) {
  return caughtFailure();
}

Result<MeshDistanceReport> measureDistance(const TriangleMesh& first, const TriangleMesh& second,
                                           const MeshDistanceOptions& options, const RunContext& context,
                                           std::vector<double>* vertexDistances) try {
  ARETE_TRY(const Pair pair, pairOf(first, second));
  const Box3& box = pair.box;
  const Vec3& origin = pair.origin;
  const std::array<Surface, 2>& surfaces = pair.surfaces;
  const std::uint64_t samples = options.samples > 0 ? options.samples : usualSamples(first, second);
  const auto measureOneWay = [&](int from, const char* stage,
                                 std::vector<double>* distances) -> Result<DistanceOneWay> {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "measuring was interrupted");
    OneWay way(surfaces[from], surfaces[1 - from], options, samples, context);
    Result<DistanceOneWay> found = way.measure(stage, distances);
    if (found) {
      found->worst = found->worst + origin;
      found->worstNearest = found->worstNearest + origin;
    }
    return found;
  };
  ARETE_TRY(const DistanceOneWay forward, measureOneWay(0, "from the first to the second", vertexDistances));
  ARETE_TRY(const DistanceOneWay backward, measureOneWay(1, "from the second to the first", nullptr));

  MeshDistanceReport report;
  report.first = surfaces[0].summary;
  report.second = surfaces[1].summary;
  report.forward = forward;
  report.backward = backward;
  report.seed = options.seed;
  for (const Vec3& p : {box.low, box.high})
    report.largestCoordinate =
        std::max({report.largestCoordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return report;
} catch (...) {
  return caughtFailure();
}

namespace {

/// E with the tolerance for rounding.
double accepted(const MeshDistanceReport& report, double expectedDistance) {
  const double c = report.largestCoordinate;
  return expectedDistance + 16 * (std::nextafter(c, std::numeric_limits<double>::infinity()) - c);
}

}  // namespace

bool isProven(const MeshDistanceReport& report, double expectedDistance, PromisedWay promised) {
  const double atMost = promised == PromisedWay::both ? report.hausdorffAtMost() : report.backward.atMost;
  return atMost <= accepted(report, expectedDistance);
}

Status checkDistance(const MeshDistanceReport& report, double expectedDistance, PromisedWay promised) try {
  const bool isOfBoth = promised == PromisedWay::both;
  const double largest = isOfBoth ? report.hausdorff() : report.backward.maximum;
  // Written so that a NaN fails.
  if (largest <= accepted(report, expectedDistance)) return {};
  const bool isForward = isOfBoth && report.forward.maximum >= report.backward.maximum;
  const DistanceOneWay& way = isForward ? report.forward : report.backward;
  return failure(
      ErrorCode::brokenPromise,
      fmt::format("the largest distance is {}, more than {}: from {} {} {} of the {} mesh", way.maximum,
                  expectedDistance, way.worst.x, way.worst.y, way.worst.z, isForward ? "first" : "second"));
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
