// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "surface/diagnosis/diagnosis.h"
#include "surface/families.h"
#include "surface/parted.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr DecimateOperator kThatKeepTopology[] = {DecimateOperator::edge, DecimateOperator::halfEdge,
                                                  DecimateOperator::face, DecimateOperator::lindstromTurk};
constexpr DecimateOperator kAll[] = {DecimateOperator::edge,       DecimateOperator::halfEdge,
                                     DecimateOperator::vertexPair, DecimateOperator::face,
                                     DecimateOperator::cluster,    DecimateOperator::lindstromTurk};

DecimatedMesh decimated(const SurfaceMesh& mesh, const DecimateOptions& options) {
  Result<DecimatedMesh> result = decimate(mesh, options);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

DecimateOptions options(DecimateOperator method, std::size_t triangles) {
  DecimateOptions o;
  o.method = method;
  o.maxTriangles = static_cast<std::uint32_t>(triangles);
  return o;
}

TEST(Decimate, MeetsItsCountAndKeepsTheTopologyOfEveryFamily) {
  for (const std::uint64_t seed : {1u, 2u})
    for (const shapes::NamedMesh& family : shapes::families(seed))
      for (const DecimateOperator method : kThatKeepTopology) {
        SCOPED_TRACE(family.name + ", operator " + std::to_string(int(method)));
        const SurfaceMesh source(family.mesh);
        const DecimatedMesh result = decimated(source, options(method, source.triangles.size() / 3));
        EXPECT_LE(result.mesh.triangles.size(), source.triangles.size() / 3);
        ASSERT_TRUE(result.mesh.validate());
        const auto before = diagnose(source.shape(), {.selfIntersections = false}),
                   after = diagnose(result.mesh.shape(), {.selfIntersections = false});
        ASSERT_TRUE(before && after);
        ASSERT_EQ(before->components.size(), after->components.size());
        std::multiset<std::pair<std::int64_t, std::uint64_t>> was, is;
        for (const ComponentDiagnosis& c : before->components) was.emplace(c.eulerNumber, c.borders);
        for (const ComponentDiagnosis& c : after->components) is.emplace(c.eulerNumber, c.borders);
        EXPECT_EQ(was, is);
      }
}

TEST(Decimate, StopsWhereNoStepIsLeftThatKeepsTheSurface) {
  const SurfaceMesh torus(shapes::sheet(20, 14, true, true));
  for (const DecimateOperator method : kThatKeepTopology) {
    const DecimatedMesh result = decimated(torus, options(method, 1));
    EXPECT_GE(result.mesh.triangles.size(), 14u);  // the least torus
    EXPECT_LT(result.mesh.triangles.size(), 200u);
  }
}

TEST(Decimate, IsTheSameEachTimeAndForAnyPowerOfTwo) {
  SurfaceMesh mesh(shapes::shaken(shapes::globe(24, 12), 3, 0.02));
  SurfaceMesh scaled = mesh;
  for (Vec3& p : scaled.positions) p = p * 0x1p20;
  for (const DecimateOperator method : kAll) {
    const DecimatedMesh once = decimated(mesh, options(method, 120));
    EXPECT_EQ(once.mesh, decimated(mesh, options(method, 120)).mesh);
    EXPECT_EQ(once.mesh.triangles, decimated(scaled, options(method, 120)).mesh.triangles) << int(method);
  }
}

TEST(Decimate, LazyQueuesComputeFewerCostsAndEndAsGreedyOnesDo) {
  const SurfaceMesh mesh(shapes::shaken(shapes::globe(60, 30), 5, 0.01));
  DecimateOptions lazy = options(DecimateOperator::edge, 300), greedy = lazy, estimate = lazy;
  greedy.queue = DecimateQueue::greedy;
  estimate.queue = DecimateQueue::estimate;
  const DecimatedMesh a = decimated(mesh, lazy), b = decimated(mesh, greedy), c = decimated(mesh, estimate);
  EXPECT_LT(double(a.evaluations), 0.8 * double(b.evaluations));
  EXPECT_LT(c.evaluations, a.evaluations);
  for (const DecimatedMesh* one : {&a, &b, &c}) EXPECT_LE(one->mesh.triangles.size(), 300u);
}

TEST(Decimate, HalfEdgesAndOriginalClustersKeepTheirVerticesToTheBit) {
  const SurfaceMesh mesh(shapes::hills(24, 2));
  DecimateOptions clusters = options(DecimateOperator::cluster, 200);
  clusters.keepsClusterVertices = true;
  for (const DecimateOptions& o : {options(DecimateOperator::halfEdge, 200), clusters}) {
    const DecimatedMesh result = decimated(mesh, o);
    for (std::size_t v = 0; v < result.vertexOf.size(); ++v)
      EXPECT_EQ(result.mesh.positions[v], mesh.positions[result.vertexOf[v]]);
  }
}

TEST(Decimate, KeepsBordersToTheBitWhereItIsWanted) {
  const SurfaceMesh mesh(shapes::hills(20, 4));
  const auto borderOf = [](const TriangleMesh& m) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : m.triangles)
      for (std::size_t i = 0; i < 3; ++i) ++sides[std::minmax(t[i], t[(i + 1) % 3])];
    std::set<std::array<double, 3>> places;
    for (const auto& [edge, count] : sides)
      if (count == 1)
        for (const std::uint32_t v : {edge.first, edge.second})
          places.insert({m.positions[v].x, m.positions[v].y, m.positions[v].z});
    return places;
  };
  for (const DecimateOperator method : kThatKeepTopology) {
    DecimateOptions o = options(method, 300);
    o.keepsBorders = true;
    EXPECT_EQ(borderOf(decimated(mesh, o).mesh), borderOf(mesh)) << int(method);
  }
}

/// A flat sheet of two charts: texture coordinates are x and y, and 100 more on the right.
SurfaceMesh charts() {
  SurfaceMesh mesh(shapes::sheet(20, 16));
  Attribute texcoord{.name = "texcoord",
                     .meaning = AttributeMeaning::textureCoords,
                     .type = ScalarType::float64,
                     .components = 2};
  Attribute height{.name = "height", .type = ScalarType::float64};
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x;
    const std::uint32_t part = x > 27 ? 1 : 0;
    mesh.materialOf.push_back(part);
    mesh.wedges.push_back({t[0] + part * count, t[1] + part * count, t[2] + part * count});
  }
  mesh.wedgeCount = 2 * count;
  for (std::uint32_t w = 0; w < 2 * count; ++w) {
    const Vec3& p = mesh.positions[w % count];
    texcoord.append(std::vector<double>{p.x + (w < count ? 0 : 100), p.y});
  }
  for (const Vec3& p : mesh.positions) height.append(std::vector<double>{3 * p.x - 2 * p.y});
  mesh.wedgeAttributes = {texcoord};
  mesh.vertexAttributes = {height};
  mesh.materials = {{.name = "left"}, {.name = "right"}};
  return mesh;
}

TEST(Decimate, CarriesTextureCoordinatesAlongWithinTheirChart) {
  const SurfaceMesh mesh = charts();
  for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::halfEdge}) {
    const DecimatedMesh result = decimated(mesh, options(method, 60));
    ASSERT_TRUE(result.mesh.validate());
    EXPECT_LE(result.mesh.triangles.size(), 60u);
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = result.mesh.positions[result.mesh.triangles[t][c]];
        const auto uv = result.mesh.wedgeAttributes[0].numbers(result.mesh.wedges[t][c]);
        const bool isRight = result.mesh.materialOf[t] == 1;
        // Linear coordinates stay so, but that an averaged vertex lies beside the edge that it was.
        EXPECT_NEAR(uv[0], p.x + (isRight ? 100 : 0), method == DecimateOperator::halfEdge ? 0 : 3);
        EXPECT_NEAR(uv[1], p.y, method == DecimateOperator::halfEdge ? 0 : 3);
        EXPECT_EQ(isRight ? p.x >= 9 - 1e-9 : p.x <= 9 + 1e-9, true) << p.x;
      }
    // The seam is at x = 9 still, from side to side.
    std::set<double> ends;
    for (const Vec3& p : result.mesh.positions)
      if (p.x == 9) ends.insert(p.y);
    EXPECT_EQ(*ends.begin(), 0);
  }
}

TEST(Decimate, LosesNoAttributeOfCornersByAnyMethod) {
  for (const DecimateOperator method : kAll) {
    const DecimatedMesh result = decimated(charts(), options(method, 100));
    EXPECT_TRUE(result.lost.empty());
    ASSERT_TRUE(result.mesh.validate());
    ASSERT_EQ(result.mesh.wedgeAttributes.size(), 1u);
    ASSERT_EQ(result.mesh.wedges.size(), result.mesh.triangles.size());
  }
}

TEST(Decimate, ClustersHaveNoTriangleTwiceAndNoneWithoutArea) {
  const SurfaceMesh mesh(shapes::shaken(shapes::globe(40, 20), 2, 0.05));
  for (const std::uint32_t most : {600u, 60u, 24u}) {
    const DecimatedMesh result = decimated(mesh, options(DecimateOperator::cluster, most));
    EXPECT_LE(result.mesh.triangles.size(), most);
    std::set<std::array<std::uint32_t, 3>> seen;
    for (auto t : result.mesh.triangles) {
      std::ranges::sort(t);
      EXPECT_TRUE(t[0] < t[1] && t[1] < t[2]);
      EXPECT_TRUE(seen.insert(t).second);
    }
  }
}

TEST(Decimate, JoinsPartsThatAreNearByVertexPairs) {
  // Two sheets, a hundredth of a step above each other at one side.
  TriangleMesh mesh = shapes::hills(8, 2), above = mesh;
  for (Vec3& p : above.positions) p.z += 0.001;
  shapes::append(mesh, above);
  const DecimatedMesh result = decimated(SurfaceMesh(mesh), options(DecimateOperator::vertexPair, 40));
  const auto found = diagnose(result.mesh.shape(), {.selfIntersections = false});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->components.size(), 1u);
}

// What was reported of other programs: zero-area faces are thrown away first, which tears holes.
TEST(Decimate, TearsNoHoleAtTrianglesWithoutArea) {
  // A globe; one triangle is split at the middle of a side, and so is its neighbour, but a sliver lies
  // between.
  TriangleMesh mesh = shapes::globe(16, 8);
  const Triangle t = mesh.triangles[20];
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back((mesh.positions[t[0]] + mesh.positions[t[1]]) / 2.0);
  mesh.triangles[20] = {t[0], middle, t[2]};
  mesh.triangles.push_back({middle, t[1], t[2]});
  mesh.triangles.push_back({t[0], t[1], middle});  // without area
  for (const DecimateOperator method : kThatKeepTopology) {
    const DecimatedMesh result = decimated(SurfaceMesh(mesh), options(method, 60));
    EXPECT_LE(result.mesh.triangles.size(), 60u);
    const auto found = diagnose(result.mesh.shape(), {.selfIntersections = false});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->components[0].borders, 0u) << int(method);
  }
}

// Any place of a plane is as good by its quadric: others turn triangles over there, or leave slivers without
// area.
TEST(Decimate, TurnsNoTriangleOfAPlaneOverAndKeepsItsArea) {
  const TriangleMesh sheet = shapes::sheet(24, 18);
  const auto areasOf = [](const TriangleMesh& m) {
    std::vector<double> areas;
    for (const auto& [i, j, k] : m.triangles)
      areas.push_back(cross(m.positions[j] - m.positions[i], m.positions[k] - m.positions[i]).z / 2);
    return areas;
  };
  double whole = 0;
  for (const double a : areasOf(sheet)) whole += a;
  for (const DecimateOperator method : kThatKeepTopology)
    for (const std::uint32_t most : {400u, 100u, 20u}) {
      const DecimatedMesh result = decimated(SurfaceMesh(sheet), options(method, most));
      double sum = 0;
      for (const double a : areasOf(result.mesh)) {
        EXPECT_GT(a, 0) << int(method);
        sum += a;
      }
      // Triangles at the border are the last ones that are contracted, and then it shrinks.
      if (method == DecimateOperator::face && most < 100) continue;
      EXPECT_NEAR(sum, whole, 1e-6 * whole) << int(method);
    }
}

TEST(Decimate, KeepsVerticesWithinReachOfTheSource) {
  // Nearly flat, so that planes are nearly parallel.
  TriangleMesh mesh = shapes::sheet(30, 30);
  for (Vec3& p : mesh.positions) p.z = 1e-7 * std::sin(3 * p.x + 5 * p.y);
  for (const DecimateOperator method : kAll) {
    const DecimatedMesh result = decimated(SurfaceMesh(mesh), options(method, 50));
    for (const Vec3& p : result.mesh.positions)
      EXPECT_TRUE(p.x > -1 && p.x < 31 && p.y > -1 && p.y < 31 && std::fabs(p.z) < 1) << int(method);
  }
}

TEST(Decimate, LeavesAMeshThatIsSmallEnoughAsItIs) {
  const SurfaceMesh mesh = charts();
  for (const DecimateOperator method : kAll) {
    const DecimatedMesh result = decimated(mesh, options(method, 1'000'000));
    EXPECT_EQ(result.mesh.positions.size(), mesh.positions.size());
    EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(result.steps, 0u);
    for (std::size_t v = 0; v < result.vertexOf.size(); ++v)
      EXPECT_EQ(result.mesh.positions[v], mesh.positions[result.vertexOf[v]]);
  }
}

TEST(Decimate, MakesNoCrossingsWhereTheyAreForbidden) {
  // Two balls, one inside the other and nearly as large: coarse ones would cross.
  TriangleMesh mesh = shapes::globe(40, 20), inner = shapes::shaken(shapes::globe(36, 18), 3, 0.002);
  for (Vec3& p : inner.positions) p = p * 0.975;
  for (auto& t : inner.triangles) std::swap(t[1], t[2]);
  shapes::append(mesh, inner);
  ASSERT_EQ(diagnose(mesh, {})->selfIntersections->count, 0u);
  for (const DecimateOperator method :
       {DecimateOperator::edge, DecimateOperator::halfEdge, DecimateOperator::face}) {
    DecimateOptions o = options(method, 300);
    EXPECT_GT(diagnose(decimated(SurfaceMesh(mesh), o).mesh.shape(), {})->selfIntersections->count, 0u);
    o.forbidsCrossings = true;
    const DecimatedMesh result = decimated(SurfaceMesh(mesh), o);
    EXPECT_EQ(diagnose(result.mesh.shape(), {})->selfIntersections->count, 0u) << int(method);
    EXPECT_LT(result.mesh.triangles.size(), mesh.triangles.size() / 2);
  }
}

TEST(Decimate, RefusesSizesBeyondItsNumbersAndResultsWithoutTriangles) {
  for (const double scale : {1e-200, 1e200}) {
    SurfaceMesh mesh(shapes::globe(8, 4));
    for (Vec3& p : mesh.positions) p = p * scale;
    for (const DecimateOperator method : kAll) EXPECT_FALSE(decimate(mesh, options(method, 20)));
  }
  EXPECT_FALSE(decimate(SurfaceMesh(shapes::tetrahedron({0, 0, 0})), options(DecimateOperator::cluster, 2)));
}

TEST(Decimate, RefusesWhatIsNoSurfaceOrNoCount) {
  SurfaceMesh fan(shapes::tetrahedron({0, 0, 0}));
  EXPECT_FALSE(decimate(fan, options(DecimateOperator::edge, 0)));
  fan.triangles.push_back(fan.triangles[0]);  // an edge of three triangles
  const auto refused = decimate(fan, options(DecimateOperator::lindstromTurk, 2));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("mesh repair"), std::string::npos);
  EXPECT_TRUE(decimate(fan, options(DecimateOperator::edge, 2)));
}

TEST(Decimate, LeavesSomethingOfEveryPart) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const parted::RandomSurface surface = parted::randomSurface(seed);
    for (const DecimateOperator method : kThatKeepTopology) {
      SCOPED_TRACE(surface.name + ", operator " + std::to_string(int(method)));
      SurfaceMesh source = surface.mesh;
      if (method == DecimateOperator::lindstromTurk) {  // carries no corners
        source.wedges.clear();
        source.wedgeAttributes.clear();
        source.wedgeCount = 0;
      }
      const Result<DecimatedMesh> result = decimate(source, options(method, 1));
      if (!result) continue;  // no surface
      std::set<parted::Part> before, after;
      for (std::size_t t = 0; t < source.triangles.size(); ++t) before.insert(parted::partAt(source, t));
      for (std::size_t t = 0; t < result->mesh.triangles.size(); ++t)
        after.insert(parted::partAt(result->mesh, t));
      EXPECT_EQ(before, after);
      EXPECT_LE(result->mesh.triangles.size(), source.triangles.size());
    }
  }
}

TEST(Decimate, SimplifiesLinesBetweenPartsAlongThemselves) {
  // A square in a plate; and two halves with a straight line between them.
  const TriangleMesh plate = shapes::sheet(12, 12);
  for (const bool isSquare : {true, false})
    for (const parted::Carriers& carriers :
         {parted::Carriers{.materials = true}, parted::Carriers{.labels = true}})
      for (const DecimateOperator method : kThatKeepTopology) {
        SCOPED_TRACE(std::to_string(isSquare) + std::to_string(carriers.labels) + ", operator " +
                     std::to_string(int(method)));
        std::vector<std::uint32_t> parts;
        for (const auto& [a, b, c] : plate.triangles) {
          const Vec3 p = (plate.positions[a] + plate.positions[b] + plate.positions[c]) / 3.0;
          parts.push_back(isSquare ? (std::abs(p.x - 6) < 3 && std::abs(p.y - 6) < 3 ? 1 : 0)
                                   : (p.x < 6 ? 1 : 0));
        }
        const SurfaceMesh source = parted::withParts(plate, parts, carriers);
        const DecimatedMesh result = decimated(source, options(method, 60));
        std::map<parted::Part, double> area;
        for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
          const auto& [a, b, c] = result.mesh.triangles[t];
          const auto& at = result.mesh.positions;
          area[parted::partAt(result.mesh, t)] += norm(cross(at[b] - at[a], at[c] - at[a])) / 2;
        }
        ASSERT_EQ(area.size(), 2u);
        EXPECT_LE(result.mesh.triangles.size(), 60u);
        const double expected = isSquare ? 36 : 72;
        EXPECT_NEAR(std::min(area.begin()->second, area.rbegin()->second), expected, 1e-6);
      }
}

}  // namespace
}  // namespace arete
