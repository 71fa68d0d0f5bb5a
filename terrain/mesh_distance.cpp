// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both meshes are moved so that the middle of their common box is the origin: at coordinates of a projected
// CRS, millions of metres, squares of lengths would lose the millimetres. Then each vertex and each sample of
// one mesh asks for the nearest point of the other. Blocks of vertices and of samples are tasks of their own;
// their sums are added in the order of the blocks, so that no rounding depends on the threads.
#include "terrain/mesh_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "terrain/measure_bands.h"
#include "terrain/nearest_on_mesh.h"
#include "terrain/surface_samples.h"

namespace arete {
namespace {

constexpr std::uint64_t kPerBlock = 4096;
constexpr std::uint64_t kSamplesPerTriangle = 10, kLeastSamples = 1'000'000;

struct Box3 {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-low.x, -low.y, -low.z};

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 middle() const {
    return {std::midpoint(low.x, high.x), std::midpoint(low.y, high.y), std::midpoint(low.z, high.z)};
  }
  double diagonal() const { return std::sqrt(space::squaredDistance(low, high)); }
};

/// A mesh moved to the common origin, and what is said of it.
struct Surface {
  TriangleMesh mesh;
  std::vector<std::uint8_t> isUsed;  // per vertex
  MeshSummary summary;
};

Box3 boxOf(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  return box;
}

Surface surfaceOf(const TriangleMesh& mesh, const Vec3& origin) {
  Surface surface;
  surface.mesh.triangles = mesh.triangles;
  surface.mesh.positions.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) surface.mesh.positions.push_back(space::minus(p, origin));
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
  // The fourth power is what the area of a triangle is compared in.
  if (!std::isfinite(std::pow(surface.summary.diagonal, 4)))
    return failure(ErrorCode::invalidData, "has coordinates too large to measure between", which);
  if (!(surface.summary.area > 0))
    return failure(ErrorCode::degenerate, "holds no triangle that has area", which);
  return {};
}

/// What one block found, or several in a row.
struct Part {
  double maximum = -1, sum = 0, sumSquares = 0;
  Vec3 worst, worstNearest;

  void take(const Vec3& p, const NearestOnMesh::Answer& answer) {
    sum += answer.distance;
    sumSquares += answer.distance * answer.distance;
    if (answer.distance <= maximum) return;
    maximum = answer.distance;
    worst = p;
    worstNearest = answer.point;
  }
  void add(const Part& later) {
    sum += later.sum;
    sumSquares += later.sumSquares;
    if (later.maximum <= maximum) return;
    maximum = later.maximum;
    worst = later.worst;
    worstNearest = later.worstNearest;
  }
};

std::size_t blocksOf(std::uint64_t items) {
  return static_cast<std::size_t>((items + kPerBlock - 1) / kPerBlock);
}

Part sum(std::span<const Part> parts) {
  Part all;
  for (const Part& part : parts) all.add(part);
  return all;
}

Result<DistanceOneWay> oneWay(const Surface& from, const NearestOnMesh& to, const SurfaceSamples& samples,
                              const char* stage, const RunContext& context,
                              std::vector<double>* vertexDistances) {
  const std::size_t vertices = from.mesh.positions.size(), vertexBlocks = blocksOf(vertices);
  std::vector<Part> parts(vertexBlocks + blocksOf(samples.count()));
  if (vertexDistances) vertexDistances->resize(vertices);

  const auto takeVertices = [&](std::size_t block, Part& part) {
    const std::size_t end = std::min<std::size_t>(vertices, (block + 1) * kPerBlock);
    for (std::size_t v = block * kPerBlock; v < end; ++v) {
      if (from.isUsed[v] == 0 && !vertexDistances) continue;
      const NearestOnMesh::Answer answer = to.nearest(from.mesh.positions[v]);
      if (vertexDistances) (*vertexDistances)[v] = answer.distance;
      if (from.isUsed[v] != 0) part.take(from.mesh.positions[v], answer);
    }
  };
  const auto takeSamples = [&](std::size_t block, Part& part) {
    const std::uint64_t begin = block * kPerBlock, end = std::min(samples.count(), begin + kPerBlock);
    std::uint32_t triangle = samples.triangleOf(begin);
    for (std::uint64_t i = begin; i < end; ++i) {
      const Vec3 p = samples.at(i, triangle);
      part.take(p, to.nearest(p));
    }
  };
  const Status done = measuring::forEachBand(parts.size(), context, stage, [&](std::size_t block) {
    if (block < vertexBlocks)
      takeVertices(block, parts[block]);
    else
      takeSamples(block - vertexBlocks, parts[block]);
  });
  if (!done) return tl::unexpected(done.error());

  Part atVertices = sum(std::span(parts).first(vertexBlocks));
  const Part atSamples = sum(std::span(parts).subspan(vertexBlocks));
  const auto n = static_cast<double>(samples.count());
  DistanceOneWay found;
  found.samples = samples.count();
  found.vertices = from.summary.vertices - from.summary.unusedVertices;
  found.mean = atSamples.sum / n;
  found.rms = std::sqrt(atSamples.sumSquares / n);
  found.maximumAtVertices = atVertices.maximum;
  atVertices.add(atSamples);
  found.maximum = atVertices.maximum;
  found.worst = atVertices.worst;
  found.worstNearest = atVertices.worstNearest;
  return found;
}

}  // namespace

double MeshDistanceReport::hausdorff() const {
  return std::max(forward.maximum, backward.maximum);
}

double MeshDistanceReport::mean() const {
  return (forward.mean * first.area + backward.mean * second.area) / (first.area + second.area);
}

double MeshDistanceReport::rms() const {
  return std::sqrt((forward.rms * forward.rms * first.area + backward.rms * backward.rms * second.area) /
                   (first.area + second.area));
}

Result<MeshDistanceReport> measureDistance(const TriangleMesh& first, const TriangleMesh& second,
                                           const MeshDistanceOptions& options, const RunContext& context,
                                           std::vector<double>* vertexDistances) {
  for (const auto& [mesh, which] : {std::pair(&first, "first"), std::pair(&second, "second")})
    if (const Status ok = check(*mesh, which); !ok) return tl::unexpected(ok.error());
  Box3 box = boxOf(first);
  const Box3 other = boxOf(second);
  box.include(other.low);
  box.include(other.high);
  const Vec3 origin = box.middle();
  const std::array<Surface, 2> surfaces = {surfaceOf(first, origin), surfaceOf(second, origin)};
  for (const auto& [surface, which] : {std::pair(&surfaces[0], "first"), std::pair(&surfaces[1], "second")})
    if (const Status ok = check(*surface, which); !ok) return tl::unexpected(ok.error());

  const std::uint64_t samples = options.samples > 0
                                    ? options.samples
                                    : std::max({kLeastSamples, kSamplesPerTriangle * first.triangles.size(),
                                                kSamplesPerTriangle * second.triangles.size()});
  const auto measureOneWay = [&](int from, const char* stage,
                                 std::vector<double>* distances) -> Result<DistanceOneWay> {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "measuring was interrupted");
    const NearestOnMesh to(surfaces[1 - from].mesh);
    const SurfaceSamples spread(surfaces[from].mesh, samples, options.seed);
    Result<DistanceOneWay> found = oneWay(surfaces[from], to, spread, stage, context, distances);
    if (found) {
      found->worst = space::along(found->worst, origin, 1);
      found->worstNearest = space::along(found->worstNearest, origin, 1);
    }
    return found;
  };
  const Result<DistanceOneWay> forward = measureOneWay(0, "from the first to the second", vertexDistances);
  if (!forward) return tl::unexpected(forward.error());
  const Result<DistanceOneWay> backward = measureOneWay(1, "from the second to the first", nullptr);
  if (!backward) return tl::unexpected(backward.error());

  MeshDistanceReport report;
  report.first = surfaces[0].summary;
  report.second = surfaces[1].summary;
  report.forward = *forward;
  report.backward = *backward;
  report.seed = options.seed;
  for (const Vec3& p : {box.low, box.high})
    report.largestCoordinate =
        std::max({report.largestCoordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return report;
}

Status checkDistance(const MeshDistanceReport& report, double expectedDistance) {
  const double c = report.largestCoordinate;
  const double rounding = 16 * (std::nextafter(c, std::numeric_limits<double>::infinity()) - c);
  // Written so that a NaN fails.
  if (report.hausdorff() <= expectedDistance + rounding) return {};
  const bool isForward = report.forward.maximum >= report.backward.maximum;
  const DistanceOneWay& way = isForward ? report.forward : report.backward;
  return failure(
      ErrorCode::brokenPromise,
      fmt::format("the largest distance is {}, more than {}: from {} {} {} of the {} mesh", way.maximum,
                  expectedDistance, way.worst.x, way.worst.y, way.worst.z, isForward ? "first" : "second"));
}

}  // namespace arete
