// SPDX-License-Identifier: GPL-3.0-or-later
//
// Laws 5 (orientation) and 7 are checked on the arrays. For law 8 the finest front is compared with the
// finest triangulation computed anew from the samples. Law 10 is checked by validate_errors.cpp. The other
// parts are checked on a set of fronts: the
// root, the finest, a series of prefixes of the nodes (uniform cuts), and fronts of random closed node sets.
#include "terrain/laws/validate_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/base/caught_failure.h"
#include "engine/laws/validate.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "terrain/model/plan_orientation.h"
#include "terrain/triangulation/finest_points.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {
namespace {

tl::unexpected<Error> broken(std::string what) {
  return failure(ErrorCode::brokenPromise, std::move(what));
}

std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9E3779B97F4A7C15ull);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

/// The first triangle without a positive area, or kNone.
std::uint32_t firstWithoutArea(const MultiTriangulation& mt) {
  constexpr std::uint32_t kNone = MultiTriangulation::kNone;
  const auto hasArea = [&](TriangleId t, NodeId creator) {
    const auto corners = mt.corners(t, creator);
    const auto at = [&](int i) { return mt.vertices().planPosition(VertexId(corners[i])); };
    return planOrientation(at(0), at(1), at(2)) > 0;
  };
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    if (!hasArea(TriangleId(t), {})) return t;
  return parallelReduce(
      IndexRange<std::uint32_t>(0, mt.nodeCount(), 4096), kNone,
      [&](const auto& range, std::uint32_t found) {
        for (std::uint32_t n = range.begin(); n != range.end(); ++n)
          for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i) {
            const TriangleId t = mt.slotTriangle(NodeId(n), i);
            if (t.index() < found && !hasArea(t, NodeId(n))) found = t.index();
          }
        return found;
      },
      [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); });
}

/// The part of law 5 about single triangles: checked exactly, on all triangles. (The engine's check tolerates
/// rounding.)
Status law5OfTriangles(const MultiTriangulation& mt) {
  const std::uint32_t t = firstWithoutArea(mt);
  if (t == MultiTriangulation::kNone) return {};
  return broken(fmt::format("law 5: triangle {} has no positive area", t));
}

Status law7(const TerrainModel& model) {
  const std::uint32_t rootVertices = model.mt.rootVertexCount();
  if (!model.isRaster) {
    for (const std::uint32_t v : model.options.fixedVertices)
      if (v >= rootVertices) return broken(fmt::format("law 7: the fixed vertex {} is not in the root", v));
    return {};
  }
  std::vector<std::uint32_t> roots(model.mt.vertices().samples.begin(),
                                   model.mt.vertices().samples.begin() + rootVertices);
  std::sort(roots.begin(), roots.end());
  for (const std::uint32_t v : model.options.fixedVertices)
    if (!std::binary_search(roots.begin(), roots.end(), v))
      return broken(fmt::format("law 7: the fixed vertex at sample {} is not in the root", v));
  return {};
}

/// Points: the finest front must have as many triangles as the Delaunay triangulation computed anew, and
/// every vertex. With cocircular points the triangles are not unique, but their number is. Law 9 is checked
/// on the same front where it applies.
Status law8OfPoints(const TerrainModel& model, const Cut& finest) {
  ARETE_TRY(const auto expected, finestPoints(model.pointSamples()));
  if (finest.triangles.size() != expected.triangles.size())
    return broken(fmt::format("law 8: the finest front has {} triangles, the points give {}",
                              finest.triangles.size(), expected.triangles.size()));
  std::vector<std::uint8_t> seen(model.mt.vertexCount(), 0);
  for (const auto& t : finest.triangles)
    for (const std::uint32_t v : t) seen[finest.vertices[v]] = 1;
  for (std::uint32_t v = 0; v < seen.size(); ++v)
    if (!seen[v]) return broken(fmt::format("law 8: no triangle of the finest front has vertex {}", v));
  return {};
}

/// The checksum is that of the decoded heights: a change of either without the other is found.
Status law8OfHeights(const TerrainModel& model, const RasterHeightfield& samples) {
  constexpr std::string_view kKind = "xxh3-128:";
  if (!model.sourceChecksum.starts_with(kKind)) return {};
  const std::string checksum = heightsChecksum(samples);
  if (checksum == model.sourceChecksum) return {};
  return broken(fmt::format("law 8: the heights have the checksum {}, those of the source had {}", checksum,
                            model.sourceChecksum));
}

/// @param rows  where it is checked; nothing: everywhere
Status law8(const TerrainModel& model, const Cut& finest, const std::optional<ModelRows>& rows) {
  if (!model.isRaster) return law8OfPoints(model, finest);
  const RasterHeightfield samples = rows ? samplesInRows(model, *rows) : model.rasterSamples();
  if (!rows) ARETE_CHECK(law8OfHeights(model, samples));
  const std::uint32_t begin = rows ? rows->first * model.columns : 0;
  const auto end = static_cast<std::uint32_t>(begin + samples.heights.size());
  std::vector<std::array<std::uint32_t, 3>> found, expected = finestTriangulation(samples);
  found.reserve(finest.triangles.size());
  const auto smallestFirst = [](std::array<std::uint32_t, 3>& t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  };
  for (const auto& c : finest.triangles) {
    std::array<std::uint32_t, 3> t;
    for (int i = 0; i < 3; ++i) t[i] = model.mt.vertices().samples[finest.vertices[c[i]]];
    if (rows && std::ranges::any_of(t, [&](std::uint32_t s) { return s < begin || s >= end; })) continue;
    smallestFirst(t);
    found.push_back(t);
  }
  for (auto& t : expected) {
    for (std::uint32_t& sample : t) sample += begin;
    smallestFirst(t);
  }
  parallelSort(found.begin(), found.end());
  parallelSort(expected.begin(), expected.end());
  if (found.size() != expected.size())
    return broken(fmt::format("law 8: the finest front has {} triangles, the samples give {}", found.size(),
                              expected.size()));
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] != expected[i])
      return broken(fmt::format("law 8: the finest front lacks the triangle of samples {}, {}, {}",
                                expected[i][0], expected[i][1], expected[i][2]));
  return {};
}

}  // namespace

NodeSet randomClosedSet(const MultiTriangulation& mt, std::uint64_t seed, double fraction) {
  NodeSet set(mt.nodeCount(), 0);
  std::uint64_t state = seed;
  const auto drawn = static_cast<std::uint64_t>(std::ceil(fraction * mt.nodeCount()));
  for (std::uint64_t i = 0; i < drawn && mt.nodeCount() > 0; ++i) set[splitmix(state) % mt.nodeCount()] = 1;
  closeUpwards(mt, set);
  return set;
}

Status validateModel(const TerrainModel& model, const ValidateModelOptions& options,
                     const RunContext& context, ErrorsChecked* checked) try {
  const ValidateOptions engineOptions{.allowsFills = model.options.rimTolerance > 0};
  const bool isDelaunay = model.options.shape == HoleShape::delaunay && !engineOptions.allowsFills;
  context.report("validate", 0);
  ARETE_CHECK(validate(model.mt, engineOptions, context));
  ARETE_CHECK(law5OfTriangles(model.mt));
  ARETE_CHECK(law7(model));
  const MultiTriangulation& mt = model.mt;
  {
    const Cut finest = frontOfPrefix(mt, mt.nodeCount());
    ARETE_CHECK(law8(model, finest, options.rows));
    ARETE_TRY(const auto errors,
              validateErrors(model, finest, options.everyTriangle, options.seed, context, options.rows));
    if (checked) *checked = errors;
  }
  const DomainExtent domain = domainExtent(mt);
  const auto check = [&](const Cut& cut, const std::string& which) -> Status {
    Status s = validateFront(mt, cut, domain, engineOptions);
    if (s && isDelaunay) s = validateDelaunayFront(model, cut);
    if (!s) s.error().message += fmt::format(" ({})", which);
    return s;
  };
  // The root, the finest front and a series of uniform cuts between them.
  const std::uint32_t ladder = 6;
  for (std::uint32_t i = 0; i <= ladder; ++i) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the validation was interrupted");
    const auto nodes = static_cast<std::uint32_t>(std::uint64_t(mt.nodeCount()) * i * i / (ladder * ladder));
    ARETE_CHECK(check(frontOfPrefix(mt, nodes), fmt::format("the first {} nodes", nodes)));
    context.report("validate", 0.3 + 0.3 * i / ladder);
  }
  std::uint64_t state = options.seed;
  for (std::uint32_t i = 0; i < options.randomFronts; ++i) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the validation was interrupted");
    const std::uint64_t seed = splitmix(state);
    // From a few nodes to a tenth of them; with their ancestors the sets are much larger.
    const double fraction = std::pow(0.1, 1 + double(seed % 5));
    ARETE_CHECK(check(front(mt, randomClosedSet(mt, seed, fraction)),
                      fmt::format("random closed set, seed {}, fraction {}", seed, fraction)));
    context.report("validate", 0.6 + 0.4 * (i + 1) / options.randomFronts);
  }
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
