// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/builder/build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "engine/cut/cut.h"
#include "full_run.h"
#include "surface/families.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"

namespace arete {
namespace {

constexpr std::uint64_t kSeeds[] = {1, 20, 300};

SurfaceModel built(const TriangleMesh& mesh, const SurfaceBuildOptions& options = {}, int threads = 2) {
  RunContext context;
  context.threads = threads;
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh), options, context);
  EXPECT_TRUE(model) << model.error().message;
  return model ? std::move(*model) : SurfaceModel{};
}

/// Some nodes with all their ancestors.
Cut randomCut(const MultiTriangulation& mt, std::mt19937_64& random) {
  NodeSet set(mt.nodeCount(), 0);
  const std::uint64_t some = random() % (mt.nodeCount() / 4 + 2);
  for (std::uint64_t i = 0; i < some; ++i) set[random() % mt.nodeCount()] = 1;
  closeUpwards(mt, set);
  return front(mt, set);
}

// An oracle that shares no code with the build: the distance of a point from a triangle by clamped
// barycentric search over its sides and plane.
double distanceOf(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto toSegment = [&](const Vec3& u, const Vec3& v) {
    const Vec3 d = v - u;
    const double t = std::min(1.0, std::max(0.0, dot(p - u, d) / dot(d, d)));
    return norm(p - (u + t * d));
  };
  double least = std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
  const Vec3 n = cross(b - a, c - a);
  const Vec3 q = p - n * (dot(p - a, n) / dot(n, n));
  const auto inside = [&](const Vec3& u, const Vec3& v) { return dot(cross(v - u, q - u), n) >= 0; };
  if (inside(a, b) && inside(b, c) && inside(c, a)) least = std::min(least, norm(p - q));
  return least;
}

double distanceFrom(const MultiTriangulation& mt, const Cut& cut, const Vec3& p) {
  double least = 1e300;
  for (const auto& t : cut.triangles) {
    const auto at = [&](std::size_t i) { return mt.position(VertexId(cut.vertices[t[i]])); };
    least = std::min(least, distanceOf(p, at(0), at(1), at(2)));
  }
  return least;
}

/// Edges at which two triangles of a cut turn towards each other by more than 120 degrees.
std::size_t foldedEdges(const MultiTriangulation& mt, const Cut& cut) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normals;
  std::size_t folded = 0;
  for (const auto& t : cut.triangles) {
    const auto at = [&](std::size_t i) { return mt.position(VertexId(cut.vertices[t[i]])); };
    const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const auto [other, isFirst] = normals.try_emplace({std::min(a, b), std::max(a, b)}, normal);
      if (!isFirst && dot(normal, other->second) < -0.5 * norm(normal) * norm(other->second)) ++folded;
    }
  }
  return folded;
}

TEST(BuildSurface, FoldsNoRoughSurface) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : {shapes::shaken(shapes::sheet(80, 50, true, true), seed, 0.02),
                                     shapes::shaken(shapes::sheet(60, 60), seed, 0.2)}) {
      const SurfaceModel model = built(mesh);
      ASSERT_EQ(foldedEdges(model.mt, frontOfPrefix(model.mt, model.mt.nodeCount())), 0u) << seed;
      for (const double share : {0.1, 0.3, 1.0, 3.0}) {
        const Result<Cut> cut = takeCut(model.mt, UniformError(share / 100 * model.diagonal));
        ASSERT_TRUE(cut);
        if (cut->triangles.size() < 100) continue;
        EXPECT_EQ(foldedEdges(model.mt, *cut), 0u) << seed << ": " << cut->triangles.size();
      }
    }
}

TEST(BuildSurface, LaysNoTriangleOverAGapOfTheBorder) {
  // A sheet with a comb of deep slits.
  TriangleMesh comb = shapes::sheet(81, 41);
  std::erase_if(comb.triangles, [&](const auto& t) {
    double x = 0, y = 0;
    for (const std::uint32_t v : t) x += comb.positions[v].x / 3, y += comb.positions[v].y / 3;
    return y > 10 && std::fmod(x, 10) > 6;
  });
  const SurfaceModel model = built(comb);
  const Cut finest = frontOfPrefix(model.mt, model.mt.nodeCount());
  for (const std::uint32_t most : {600u, 200u}) {
    const Result<Cut> cut = takeCut(model.mt, UniformError(0), {.maxTriangles = most});
    ASSERT_TRUE(cut);
    double farthest = 0;
    for (const auto& t : cut->triangles) {
      const auto at = [&](std::size_t i) { return model.mt.position(VertexId(cut->vertices[t[i]])); };
      for (const Vec3& p : {(at(0) + at(1) + at(2)) / 3.0, (at(0) + at(1)) / 2.0, (at(1) + at(2)) / 2.0,
                            (at(2) + at(0)) / 2.0})
        farthest = std::max(farthest, distanceFrom(model.mt, finest, p));
    }
    EXPECT_LT(farthest, 1.01) << most;
  }
}

TEST(BuildSurface, KeepsTheLawsOnEveryFamily) {
  for (const std::uint64_t seed : kSeeds)
    for (const auto& [name, mesh] : shapes::families(seed)) {
      SCOPED_TRACE(name);
      const SurfaceModel model = built(mesh);
      const Status valid = validateSurface(model);
      EXPECT_TRUE(valid) << valid.error().message;
      EXPECT_EQ(model.mt.finestTriangleCount(), mesh.triangles.size());
    }
}

TEST(BuildSurface, KeepsTheTopologyInEveryClosedNodeSet) {
  for (const auto& [name, mesh] : shapes::families(7)) {
    SCOPED_TRACE(name);
    const SurfaceModel model = built(mesh);
    const Result<SurfaceTopology> topology = SurfaceTopology::of(model.mt);
    ASSERT_TRUE(topology);
    std::mt19937_64 random(7);
    for (int i = 0; i < 20 && model.mt.nodeCount() > 0; ++i) {
      const Status valid = topology->check(randomCut(model.mt, random));
      ASSERT_TRUE(valid) << valid.error().message;
    }
  }
}

TEST(BuildSurface, BoundsTheDistanceOfEveryPointOfTheSourceFromEveryCut) {
  for (const std::uint64_t seed : kSeeds)
    for (const auto& [name, mesh] : shapes::families(seed)) {
      SCOPED_TRACE(name);
      const SurfaceModel model = built(mesh);
      std::mt19937_64 random(seed);
      for (int i = 0; i < 3 && model.mt.nodeCount() > 0; ++i) {
        const Cut cut = i == 0 ? frontOfPrefix(model.mt, 0) : randomCut(model.mt, random);
        for (const auto& t : mesh.triangles) {
          const double u = double(random() % 1000) / 999, v = (1 - u) * (double(random() % 1000) / 999);
          const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
          for (const Vec3& p : {a, (a + b + c) / 3.0, a + u * (b - a) + v * (c - a)})
            ASSERT_LE(distanceFrom(model.mt, cut, p), cut.achievedError + 1e-12);
        }
      }
    }
}

TEST(BuildSurface, StatesErrorsThatAreHardlyLargerThanTheDistancesFound) {
  // Every vertex of a globe is at a corner of pieces, where the largest distances are.
  const TriangleMesh mesh = shapes::shaken(shapes::globe(40, 20), 5, 0.01);
  const SurfaceModel model = built(mesh);
  for (const std::uint32_t nodes : {0u, 20u, 100u, 300u}) {
    const Cut cut = frontOfPrefix(model.mt, nodes);
    double found = 0;
    for (const Vec3& p : mesh.positions) found = std::max(found, distanceFrom(model.mt, cut, p));
    EXPECT_LE(found, cut.achievedError);
    EXPECT_LE(cut.achievedError, 1.5 * found) << nodes;
  }
}

TEST(BuildSurface, GivesTheSameArraysForAnyNumberOfThreads) {
  const TriangleMesh mesh = shapes::shaken(shapes::sheet(70, 50, true, true), 3, 0.01);
  const SurfaceModel one = built(mesh, {}, 1);
  for (const int threads : {2, 4}) {
    const SurfaceModel other = built(mesh, {}, threads);
    const MtArrays &a = one.mt.arrays(), &b = other.mt.arrays();
    EXPECT_TRUE(std::ranges::equal(a.rootTriangles, b.rootTriangles));
    EXPECT_TRUE(std::ranges::equal(a.link, b.link));
    EXPECT_TRUE(std::ranges::equal(a.remover, b.remover));
    EXPECT_TRUE(std::ranges::equal(a.error, b.error));
    EXPECT_TRUE(std::ranges::equal(a.columns.of(kRms), b.columns.of(kRms)));
    EXPECT_EQ(one.vertexOf, other.vertexOf);
    EXPECT_EQ(one.faceOf, other.faceOf);
  }
}

TEST(BuildSurface, GivesTheSameConnectivityAtAnyPowerOfTwo) {
  const TriangleMesh mesh = shapes::shaken(shapes::globe(40, 25), 11, 0.02);
  const SurfaceModel one = built(mesh);
  for (const int power : {-33, 33}) {
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.positions) p = p * std::ldexp(1.0, power);
    const SurfaceModel other = built(scaled);
    EXPECT_TRUE(std::ranges::equal(one.mt.arrays().link, other.mt.arrays().link)) << power;
    EXPECT_TRUE(std::ranges::equal(one.mt.arrays().rootTriangles, other.mt.arrays().rootTriangles)) << power;
  }
}

TEST(BuildSurface, KeepsBordersToTheBitWhereAsked) {
  const TriangleMesh mesh = shapes::hills(20, 3);
  const SurfaceModel model = built(mesh, {.keepsBorders = true});
  const auto bordersOf = [](const std::vector<std::array<std::uint32_t, 3>>& triangles,
                            const auto& numberOf) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = numberOf(t[i]), b = numberOf(t[(i + 1) % 3]);
        ++count[{std::min(a, b), std::max(a, b)}];
      }
    std::set<std::pair<std::uint32_t, std::uint32_t>> borders;
    for (const auto& [edge, n] : count)
      if (n == 1) borders.insert(edge);
    return borders;
  };
  const auto wanted = bordersOf(mesh.triangles, [](std::uint32_t v) { return v; });
  const SurfaceFront root = surfaceOf(model, frontOfPrefix(model.mt, 0));
  EXPECT_EQ(bordersOf(root.mesh.triangles, [&](std::uint32_t v) { return root.vertexOf[v]; }), wanted);
  EXPECT_LT(root.mesh.triangles.size(), mesh.triangles.size() / 4);
}

TEST(BuildSurface, SimplifiesBordersAlongThemselves) {
  const SurfaceModel model = built(shapes::sheet(20, 20));
  // A flat square: its corners stay while nothing else costs anything.
  std::uint32_t nodes = model.mt.nodeCount();
  while (nodes > 0 && frontOfPrefix(model.mt, nodes - 1).achievedError < 1e-6) --nodes;
  EXPECT_EQ(frontOfPrefix(model.mt, nodes).triangles.size(), 2u);
}

/// A sheet of two materials with texture coordinates that are cut apart between them; each wedge says its
/// vertex.
SurfaceMesh twoParts(std::uint32_t side) {
  SurfaceMesh mesh(shapes::hills(side, 1));
  mesh.materials.resize(2);
  Attribute attribute{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wedgeOf;
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x / 3;
    const std::uint32_t part = x < side / 2 ? 0 : 1;
    mesh.materialOf.push_back(part);
    auto& wedges = mesh.wedges.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [found, isNew] =
          wedgeOf.try_emplace({t[i], part}, static_cast<std::uint32_t>(wedgeOf.size()));
      if (isNew) attribute.append(std::vector<double>{double(t[i]), double(part)});
      wedges[i] = found->second;
    }
  }
  mesh.wedgeCount = static_cast<std::uint32_t>(wedgeOf.size());
  mesh.wedgeAttributes = {attribute};
  return mesh;
}

TEST(BuildSurface, KeepsLinesBetweenPartsAndTheWedgesOfEverySide) {
  const SurfaceMesh mesh = twoParts(20);
  Result<SurfaceModel> model = buildSurface(mesh);
  ASSERT_TRUE(model) << model.error().message;
  const Status valid = validateSurface(*model);
  EXPECT_TRUE(valid) << valid.error().message;
  std::mt19937_64 random(4);
  for (int i = 0; i < 12; ++i) {
    const Cut cut = i == 0 ? frontOfPrefix(model->mt, 0) : randomCut(model->mt, random);
    const SurfaceFront found = surfaceOf(*model, cut);
    const Status isWhole = found.mesh.validate();
    ASSERT_TRUE(isWhole) << isWhole.error().message;
    for (std::size_t t = 0; t < found.mesh.triangles.size(); ++t) {
      const std::uint32_t part = found.mesh.materialOf[t];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = found.mesh.triangles[t][c];
        const double x = found.mesh.positions[v].x;
        EXPECT_TRUE(part == 0 ? x <= 10 : x >= 10) << "a triangle crosses the line";
        const std::vector<double> wedge = found.mesh.wedgeAttributes[0].numbers(found.mesh.wedges[t][c]);
        EXPECT_EQ(wedge[0], found.vertexOf[v]);
        EXPECT_EQ(wedge[1], part);
      }
    }
  }
}

TEST(BuildSurface, MendsWhatLeavesTheSurfaceAsItIsAndCountsIt) {
  TriangleMesh mesh = shapes::globe(12, 6);
  const std::size_t faces = mesh.triangles.size();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);   // turned
  mesh.triangles.push_back(mesh.triangles[8]);             // duplicate
  mesh.triangles.push_back({3, 3, 4});                     // without area
  mesh.positions.push_back({9, 9, 9});                     // unused
  TriangleMesh touching = shapes::tetrahedron({0, 0, 1});  // at the globe's pole
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 1; i < 4; ++i) mesh.positions.push_back(touching.positions[i]);
  for (auto t : touching.triangles) {
    for (std::uint32_t& v : t) v = v == 0 ? 0 : first + v - 1;
    mesh.triangles.push_back(t);
  }
  const SurfaceModel model = built(mesh);
  EXPECT_EQ(model.mending, (SurfaceRepairs{.duplicateFaces = 1,
                                           .degenerateFaces = 1,
                                           .turnedFaces = 1,
                                           .addedVertices = 1,
                                           .unusedVertices = 1}));
  EXPECT_EQ(model.mt.finestTriangleCount(), faces + 4);
  EXPECT_EQ(std::ranges::count(model.vertexOf, 0u), 2) << "two fans remember one vertex";
  const Status valid = validateSurface(model);
  EXPECT_TRUE(valid) << valid.error().message;
}

TEST(BuildSurface, RefusesWhatItCannotMendByName) {
  TriangleMesh book;
  book.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto refused = [](const TriangleMesh& mesh) {
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh));
    return model ? std::string("built") : model.error().message;
  };
  EXPECT_EQ(refused(book),
            "1 edge has more than two faces, the first one between the vertices 0 and 1, counted from 0; "
            "repairing with "
            "`splitsSheets` makes several edges of each");
  const std::string moebius = refused(shapes::sheet(12, 3, true, false, true));
  EXPECT_NE(moebius.find("no turns make agree"), std::string::npos) << moebius;
  EXPECT_EQ(refused({}), "the mesh has no face");
  TriangleMesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(refused(flat), "no face of the mesh has an area");
}

TEST(BuildSurface, TakesFansOfManyFaces) {
  const SurfaceModel model = built(shapes::globe(test::isBrief() ? 4000 : 20000, 2));
  EXPECT_LT(model.mt.rootTriangleCount(), 30u);
  const Status valid = validateSurface(model);
  EXPECT_TRUE(valid) << valid.error().message;
}

TEST(BuildSurface, EndsWhereItIsInterrupted) {
  RunContext context;
  const std::atomic<bool> cancel = true;
  context.cancel = &cancel;
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(shapes::globe(30, 20)), {}, context);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
