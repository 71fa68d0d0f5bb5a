// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/builder/crease_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"

namespace arete {
namespace {

constexpr std::uint64_t kCreaseSeeds[] = {1, 20, 300};

SurfaceModel creased(const TriangleMesh& mesh, std::optional<double> degrees) {
  SurfaceBuildOptions options;
  options.creaseAngleDegrees = degrees;
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh), options);
  EXPECT_TRUE(model) << (model ? "" : model.error().describe());
  return model ? std::move(*model) : SurfaceModel{};
}

void expectCreaseLaws(const SurfaceModel& model) {
  const Status lawful = validateSurface(model);
  EXPECT_TRUE(lawful) << lawful.error().describe();
}

std::vector<Cut> cutsOfAllSizes(const MultiTriangulation& mt, std::uint64_t seed) {
  std::vector<Cut> cuts;
  for (const double share : {0.0, 0.01, 0.05, 0.2, 0.5, 0.8, 1.0})
    cuts.push_back(frontOfPrefix(mt, static_cast<std::uint32_t>(share * mt.nodeCount())));
  std::mt19937_64 random(seed);
  for (int i = 0; i < 5; ++i) {
    NodeSet set(mt.nodeCount(), 0);
    for (std::uint64_t n = random() % (mt.nodeCount() / 4 + 2); n > 0 && mt.nodeCount() > 0; --n)
      set[random() % mt.nodeCount()] = 1;
    closeUpwards(mt, set);
    cuts.push_back(front(mt, set));
  }
  return cuts;
}

/// A cube of side n with n x n squares a face, joined at its edges; its corners are moved by `by` along the
/// diagonal, and the squares' diagonals run at random.
TriangleMesh cubeOfSquares(std::uint32_t n, std::uint64_t seed) {
  TriangleMesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> numberOf;
  const auto vertex = [&](const std::array<std::uint32_t, 3>& p) {
    const auto [at, isNew] = numberOf.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
    return at->second;
  };
  std::mt19937_64 random(seed);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t level : {0u, n})
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto at = [&](std::uint32_t u, std::uint32_t v) {
            std::array<std::uint32_t, 3> p{};
            p[axis] = level;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            return vertex(p);
          };
          std::array<std::uint32_t, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          if (level == 0) std::swap(q[1], q[3]);
          if (random() % 2 == 0) std::rotate(q.begin(), q.begin() + 1, q.end());
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  return mesh;
}

/// A cylinder of so many sides with caps, of which the side is bent outwards.
TriangleMesh cappedTube(std::uint32_t around, std::uint32_t rings) {
  TriangleMesh mesh = shapes::sheet(around, rings, true);
  const auto bottom = static_cast<std::uint32_t>(mesh.positions.size()), top = bottom + 1;
  for (Vec3& p : mesh.positions) p.z = p.z / rings;
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t after = (i + 1) % around;
    mesh.triangles.push_back({bottom, after, i});
    mesh.triangles.push_back({top, rings * around + i, rings * around + after});
  }
  return mesh;
}

using SourceEdge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges of a cut by their vertices of the source.
std::set<SourceEdge> sourceEdgesOf(const SurfaceModel& model, const Cut& cut) {
  std::set<SourceEdge> edges;
  for (const auto& t : cut.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert(
          std::minmax(model.vertexOf[cut.vertices[t[i]]], model.vertexOf[cut.vertices[t[(i + 1) % 3]]]));
  return edges;
}

TEST(CreaseLines, OfACubeAreItsTwelveEdgesInEveryCut) {
  for (const std::uint64_t seed : kCreaseSeeds) {
    const std::uint32_t n = 7;
    const TriangleMesh mesh = cubeOfSquares(n, seed);
    const SurfaceModel model = creased(mesh, 45);
    EXPECT_EQ(model.creaseEdges, 12 * n);
    EXPECT_TRUE(model.boundsLines);
    expectCreaseLaws(model);
    for (const Cut& cut : cutsOfAllSizes(model.mt, seed)) {
      // Along each edge of the cube the cut's edges cover it without a gap.
      double covered = 0;
      for (const auto& [a, b] : sourceEdgesOf(model, cut)) {
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
        int extreme = 0;
        for (const auto& [x, y] : {std::pair(p.x, q.x), std::pair(p.y, q.y), std::pair(p.z, q.z)})
          extreme += x == y && (x == 0 || x == n) ? 1 : 0;
        if (extreme == 2) covered += norm(q - p);
      }
      EXPECT_EQ(covered, 12.0 * n) << "seed " << seed << ", " << cut.triangles.size() << " triangles";
    }
    EXPECT_EQ(frontOfPrefix(model.mt, 0).triangles.size(), 12u);
  }
}

TEST(CreaseLines, KeepARidgeThatShapeAloneRemoves) {
  // A low roof over a wide plate: to the shape its ridge is worth little.
  TriangleMesh roof = shapes::sheet(40, 12);
  for (Vec3& p : roof.positions) p.z = 0.5 * std::max(0.0, 1 - std::abs(p.y - 6));
  const auto ridge = [&](const SurfaceModel& model, const Cut& cut) {
    double covered = 0;
    for (const auto& [a, b] : sourceEdgesOf(model, cut)) {
      const Vec3 &p = roof.positions[a], &q = roof.positions[b];
      if (p.y == 6 && q.y == 6) covered += norm(q - p);
    }
    return covered;
  };
  const SurfaceModel asked = creased(roof, 40), without = creased(roof, std::nullopt);
  EXPECT_EQ(asked.creaseEdges, 40u) << "the foot is turned by 27 degrees, the ridge by 53";
  expectCreaseLaws(asked);
  const Cut root = frontOfPrefix(asked.mt, 0);
  EXPECT_EQ(ridge(asked, root), 40);
  EXPECT_LT(ridge(without, frontOfPrefix(without.mt, 0)), 40);
}

TEST(CreaseLines, OfACylinderAreItsRims) {
  const std::uint32_t around = 48, rings = 6;
  const TriangleMesh mesh = cappedTube(around, rings);
  const SurfaceModel model = creased(mesh, 45);
  EXPECT_EQ(model.creaseEdges, 2 * around);
  expectCreaseLaws(model);
  for (const Cut& cut : cutsOfAllSizes(model.mt, 5)) {
    // The caps are bounded by closed lines on which each vertex has one edge onwards.
    for (const double z : {0.0, 1.0}) {
      std::set<SourceEdge> directed;
      for (const auto& t : cut.triangles) {
        std::array<std::uint32_t, 3> v;
        for (std::size_t i = 0; i < 3; ++i) v[i] = model.vertexOf[cut.vertices[t[i]]];
        if (std::ranges::any_of(v, [&](std::uint32_t u) { return mesh.positions[u].z != z; })) continue;
        for (std::size_t i = 0; i < 3; ++i) directed.insert({v[i], v[(i + 1) % 3]});
      }
      std::map<std::uint32_t, int> onwards;
      for (const auto& [u, v] : directed)
        if (!directed.contains({v, u})) ++onwards[u];
      EXPECT_GE(onwards.size(), 3u) << cut.triangles.size();
      for (const auto& [v, count] : onwards) {
        EXPECT_EQ(count, 1) << v;
        EXPECT_LT(v, around * (rings + 1)) << "the middle of a cap is not on its rim";
      }
    }
  }
  // A side of the prism is turned by 7.5 degrees: beyond that all edges along it are creases.
  EXPECT_EQ(creased(mesh, 7).creaseEdges, 2 * around + around * rings);
  EXPECT_EQ(creased(mesh, 7.5).creaseEdges, 2 * around);
}

TEST(CreaseLines, AreNotMadeByNoiseBelowTheAngle) {
  for (const std::uint64_t seed : kCreaseSeeds) {
    const TriangleMesh noisy = shapes::shaken(shapes::sheet(20, 20), seed, 0.05);
    const SurfaceModel asked = creased(noisy, 45), without = creased(noisy, std::nullopt);
    EXPECT_EQ(asked.creaseEdges, 0u);
    EXPECT_FALSE(asked.hasWedges());
    EXPECT_FALSE(asked.boundsLines);
    EXPECT_EQ(frontOfPrefix(asked.mt, 0).triangles, frontOfPrefix(without.mt, 0).triangles);
    EXPECT_EQ(asked.mt.nodeCount(), without.mt.nodeCount());
  }
}

/// A plate of n x n squares with a ridge between the points `from` and `to` of the line y = n / 2.
TriangleMesh foldedPlate(std::uint32_t n, std::uint32_t from, std::uint32_t to) {
  TriangleMesh mesh = shapes::sheet(n, n);
  for (Vec3& p : mesh.positions)
    if (p.y == n / 2.0 && p.x > from && p.x < to) p.z = 1.5;
  return mesh;
}

TEST(CreaseLines, ThatEndInsideTheSurfaceStay) {
  for (const std::uint32_t length : {3u, 4u, 9u}) {
    const std::uint32_t n = 16, from = 4;
    TriangleMesh mesh = foldedPlate(n, from, from + length);
    const SurfaceModel model = creased(mesh, 60);
    EXPECT_GT(model.creaseEdges, 0u) << length;
    expectCreaseLaws(model);
    const std::set<SourceEdge> finest = sourceEdgesOf(model, frontOfPrefix(model.mt, model.mt.nodeCount()));
    SurfaceMesh source(mesh);
    const CreaseLines lines = makeCreasesLines(source, 60);
    EXPECT_EQ(lines.edges, model.creaseEdges);
    const Cut root = frontOfPrefix(model.mt, 0);
    std::set<std::uint32_t> kept;
    for (const std::uint32_t v : root.vertices) kept.insert(model.vertexOf[v]);
    for (const std::uint32_t v : lines.fixed) EXPECT_TRUE(kept.contains(v)) << length;
    EXPECT_LT(root.triangles.size(), finest.size());
  }
}

TEST(CreaseLines, OfOneEdgeKeepBothEnds) {
  // Two squares that are turned along one edge only: a slit of the angle.
  TriangleMesh mesh = shapes::sheet(10, 10);
  const std::uint32_t a = 5 * 11 + 4, b = a + 1, above = a + 11 + 1, below = a - 11;
  mesh.positions[above].z = mesh.positions[below].z = -0.3;
  SurfaceMesh source(mesh);
  const double angle = [&] {
    const auto normalOf = [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
      return cross(mesh.positions[v] - mesh.positions[u], mesh.positions[w] - mesh.positions[u]);
    };
    const Vec3 m = normalOf(a, b, above), n = normalOf(a, below, b);
    return std::atan2(norm(cross(m, n)), dot(m, n)) * 180 / std::numbers::pi;
  }();
  const CreaseLines lines = makeCreasesLines(source, angle - 1);
  EXPECT_EQ(lines.edges, 1u);
  EXPECT_EQ(lines.fixed, (std::vector<std::uint32_t>{a, b}));
  const SurfaceModel model = creased(mesh, angle - 1);
  for (const Cut& cut : cutsOfAllSizes(model.mt, 3))
    EXPECT_TRUE(sourceEdgesOf(model, cut).contains({a, b})) << cut.triangles.size();
  EXPECT_EQ(makeCreasesLines(source, angle).edges, 0u);
}

TEST(CreaseLines, HoldTheErrorsOfRoughSurfaces) {
  for (const std::uint64_t seed : std::span(kCreaseSeeds).first(test::isFull() ? 3 : 1))
    for (const auto& [name, mesh] : shapes::families(seed))
      for (const double degrees : {20.0, 60.0}) {
        SCOPED_TRACE(name);
        const SurfaceModel model = creased(mesh, degrees);
        const Status lawful = validateSurface(model, {.everySample = test::isFull()});
        EXPECT_TRUE(lawful) << lawful.error().describe();
      }
}

TEST(CreaseLines, DivideTheWedgesThatThereAre) {
  SurfaceMesh mesh(cubeOfSquares(3, 1));
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float32,
                   .components = 2};
  mesh.wedges = mesh.triangles;
  mesh.wedgeCount = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : mesh.positions) coords.append(std::array{p.x, p.y + 10 * p.z});
  mesh.wedgeAttributes = {coords};
  const SurfaceMesh before = mesh;
  const CreaseLines lines = makeCreasesLines(mesh, 45);
  EXPECT_EQ(lines.edges, 36u);
  ASSERT_TRUE(mesh.validate());
  // A corner has three wedges, a vertex inside an edge two.
  EXPECT_EQ(mesh.wedgeCount, 8u * 3 + 12 * 2 * 2 + 6 * 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(std::ranges::equal(mesh.wedgeAttributes[0].element(mesh.wedges[t][k]),
                                     before.wedgeAttributes[0].element(before.wedges[t][k])));
}

TEST(CreaseLines, OfABadAngleAreRefused) {
  for (const double degrees : {-1.0, 181.0, std::nan("")}) {
    SurfaceBuildOptions options;
    options.creaseAngleDegrees = degrees;
    const auto model = buildSurface(SurfaceMesh(shapes::tetrahedron()), options);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::usage);
    EXPECT_TRUE(model.error().culprit.starts_with("creaseAngleDegrees"));
  }
}

}  // namespace
}  // namespace arete
