// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/diagnosis/diagnosis.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "surface/shapes.h"

namespace arete {
namespace {

MeshDiagnosis of(const TriangleMesh& mesh) {
  const Result<MeshDiagnosis> result = diagnose(mesh);
  EXPECT_TRUE(result) << result.error().message;
  return result.value_or(MeshDiagnosis{});
}

TEST(Diagnosis, KnowsTheTopologyOfSimpleShapes) {
  struct Case {
    const char* name;
    TriangleMesh mesh;
    std::int64_t euler;
    std::uint32_t borders;
    std::optional<std::int64_t> genus;
    bool isOrientable;
  };
  for (const Case& c :
       {Case{"sheet", shapes::sheet(5, 4), 1, 1, 0, true},
        Case{"tube", shapes::sheet(5, 4, true), 0, 2, 0, true},
        Case{"torus", shapes::sheet(5, 4, true, true), 0, 0, 1, true},
        Case{"tetrahedron", shapes::tetrahedron(), 2, 0, 0, true},
        Case{"Moebius strip", shapes::sheet(9, 2, true, false, true), 0, 1, std::nullopt, false}}) {
    SCOPED_TRACE(c.name);
    const MeshDiagnosis d = of(c.mesh);
    ASSERT_EQ(d.components.size(), 1u);
    const ComponentDiagnosis& component = d.components[0];
    EXPECT_TRUE(component.isManifold());
    EXPECT_EQ(component.eulerNumber, c.euler);
    EXPECT_EQ(component.borders, c.borders);
    EXPECT_EQ(component.genus, c.genus);
    EXPECT_EQ(component.isOrientable, c.isOrientable);
    EXPECT_EQ(component.triangles, c.mesh.triangles.size());
    EXPECT_EQ(component.vertices, c.mesh.positions.size());
    EXPECT_EQ(d.nonOrientable.count, c.isOrientable ? 0u : 1u);
    EXPECT_EQ(d.turnedEdges.count > 0, !c.isOrientable);
    EXPECT_EQ(d.selfIntersections->count, 0u);
    for (const MeshFindings* none :
         {&d.unusedVertices, &d.doubleVertices, &d.degenerateTriangles, &d.duplicateTriangles, &d.doubleSided,
          &d.nonManifoldEdges, &d.nonManifoldVertices, &d.tJunctions})
      EXPECT_EQ(none->count, 0u);
  }
}

TEST(Diagnosis, FindsEachFaultThatIsPut) {
  TriangleMesh mesh = shapes::sheet(4, 4);      // 25 vertices, 32 triangles
  mesh.positions.push_back({100, 100, 100});    // 25: unused
  mesh.positions.push_back(mesh.positions[7]);  // 26: where 7 is
  mesh.positions.push_back({0.5, 0, 0});        // 27: inside the border edge 0-1
  mesh.positions.push_back({0.5, -1, 0});       // 28
  mesh.positions.push_back({2, 2, 3});          // 29
  mesh.triangles.push_back(mesh.triangles[3]);  // 32: a duplicate
  std::swap(mesh.triangles[32][0], mesh.triangles[32][1]);
  std::swap(mesh.triangles[32][1], mesh.triangles[32][2]);
  mesh.triangles.push_back({0, 1, 2});     // 33: on one line
  mesh.triangles.push_back({5, 5, 6});     // 34: a vertex twice
  mesh.triangles.push_back({27, 28, 26});  // 35
  mesh.triangles.push_back(
      {mesh.triangles[9][0], mesh.triangles[9][2], mesh.triangles[9][1]});  // 36: the other side
  mesh.triangles.push_back({12, 13, 29});  // 37: a third triangle at an inner edge
  const MeshDiagnosis d = of(mesh);
  ASSERT_EQ(d.unusedVertices.count, 1u);
  EXPECT_EQ(d.unusedVertices.places[0].elements, (std::vector<std::uint32_t>{25}));
  ASSERT_EQ(d.doubleVertices.count, 1u);
  EXPECT_EQ(d.doubleVertices.places[0].elements, (std::vector<std::uint32_t>{7, 26}));
  ASSERT_EQ(d.duplicateTriangles.count, 1u);
  EXPECT_EQ(d.duplicateTriangles.places[0].elements, (std::vector<std::uint32_t>{3, 32}));
  ASSERT_EQ(d.doubleSided.count, 1u);
  EXPECT_EQ(d.doubleSided.places[0].elements, (std::vector<std::uint32_t>{9, 36}));
  ASSERT_EQ(d.degenerateTriangles.count, 2u);
  EXPECT_EQ(d.degenerateTriangles.places[0].elements, (std::vector<std::uint32_t>{33}));
  EXPECT_EQ(d.degenerateTriangles.places[1].elements, (std::vector<std::uint32_t>{34}));
  bool isEdgeFound = false;
  for (const MeshFinding& f : d.nonManifoldEdges.places)
    isEdgeFound = isEdgeFound || f.elements == std::vector<std::uint32_t>{12, 13};
  EXPECT_TRUE(isEdgeFound || d.nonManifoldEdges.count > 10);
  EXPECT_EQ(d.componentOf[34], d.components.size());
  EXPECT_GT(d.selfIntersections->count, 0u);
}

TEST(Diagnosis, FindsAVertexInsideABorderEdge) {
  TriangleMesh mesh;  // one triangle above a long edge, two below it
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}};
  const MeshDiagnosis d = of(mesh);
  ASSERT_EQ(d.tJunctions.count, 1u);
  EXPECT_EQ(d.tJunctions.places[0].elements, (std::vector<std::uint32_t>{3, 0, 1}));
}

TEST(Diagnosis, CountsAllButKeepsAsManyPlacesAsAreAskedFor) {
  const TriangleMesh mesh = shapes::anything(3, 20, 400, 4);
  const auto few = diagnose(mesh, {.mostPlaces = 3}), all = diagnose(mesh, {.mostPlaces = 1'000'000});
  ASSERT_TRUE(few && all);
  EXPECT_EQ(few->selfIntersections->count, all->selfIntersections->count);
  EXPECT_EQ(few->selfIntersections->places.size(), 3u);
  EXPECT_EQ(all->selfIntersections->places.size(), all->selfIntersections->count);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(few->selfIntersections->places[i], all->selfIntersections->places[i]);
}

TEST(Diagnosis, OfAnythingAddsUpAndIsTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = shapes::anything(seed, 15, 40, 4);
    RunContext one, four;
    one.threads = 1;
    four.threads = 4;
    const auto a = diagnose(mesh, {}, one), b = diagnose(mesh, {}, four);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->selfIntersections->places, b->selfIntersections->places);
    std::uint64_t triangles = 0, wide = 0, turned = 0;
    for (const ComponentDiagnosis& c : a->components) {
      triangles += c.triangles;
      wide += c.nonManifoldEdges;
      turned += c.turnedEdges;
      EXPECT_EQ(c.eulerNumber, std::int64_t(c.vertices) - std::int64_t(c.edges) + std::int64_t(c.triangles));
      EXPECT_GE(c.genus.value_or(0), 0);
    }
    EXPECT_EQ(wide, a->nonManifoldEdges.count);
    EXPECT_EQ(turned, a->turnedEdges.count);
    std::uint64_t withRepeat = 0;
    for (const auto& t : mesh.triangles) withRepeat += t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? 1 : 0;
    EXPECT_EQ(triangles + withRepeat, mesh.triangles.size());
  }
}

TEST(Diagnosis, RefusesIndicesAndCoordinatesThatAreNone) {
  TriangleMesh mesh = shapes::tetrahedron();
  mesh.triangles.push_back({0, 1, 4});
  EXPECT_EQ(diagnose(mesh).error().code, ErrorCode::invalidData);
  mesh = shapes::tetrahedron();
  mesh.positions[1].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(diagnose(mesh).error().code, ErrorCode::invalidData);
}

TEST(Diagnosis, OfNothingIsEmpty) {
  const MeshDiagnosis d = of({});
  EXPECT_TRUE(d.components.empty() && d.borders.empty());
  EXPECT_EQ(d.diagonal, 0);
}

}  // namespace
}  // namespace arete
