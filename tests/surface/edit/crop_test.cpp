// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/crop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "surface/diagnosis/diagnosis.h"
#include "surface/diagnosis/sizes.h"
#include "surface/repair/weld.h"
#include "surface/shapes.h"

namespace arete {
namespace {

using Point = std::tuple<double, double, double>;

SurfaceMesh surface(TriangleMesh shape) {
  SurfaceMesh mesh;
  static_cast<TriangleMesh&>(mesh) = std::move(shape);
  return mesh;
}

/// A torus turned out of the axes, so that edges cross planes anywhere.
TriangleMesh turnedTorus(std::uint32_t columns = 24, std::uint32_t rows = 13) {
  TriangleMesh mesh = shapes::sheet(columns, rows, true, true);
  for (Vec3& p : mesh.positions)
    p = {0.8 * p.x - 0.6 * p.y, 0.36 * p.x + 0.48 * p.y - 0.8 * p.z, 0.48 * p.x + 0.64 * p.y + 0.6 * p.z};
  return mesh;
}

bool isIn(const Vec3& p, const Box3& box) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.low.z &&
         p.z <= box.high.z;
}

/// The tiles of a grid of planes, which cover all of space.
std::vector<Box3> tiles(const std::array<std::vector<double>, 3>& planes) {
  std::array<std::vector<double>, 3> bounds = planes;
  for (auto& b : bounds) {
    b.insert(b.begin(), -Box3::kInfinity);
    b.push_back(Box3::kInfinity);
  }
  std::vector<Box3> all;
  for (std::size_t x = 0; x + 1 < bounds[0].size(); ++x)
    for (std::size_t y = 0; y + 1 < bounds[1].size(); ++y)
      for (std::size_t z = 0; z + 1 < bounds[2].size(); ++z)
        all.push_back({{bounds[0][x], bounds[1][y], bounds[2][z]},
                       {bounds[0][x + 1], bounds[1][y + 1], bounds[2][z + 1]}});
  return all;
}

TEST(Crop, CutsStraightAlongTheBox) {
  const auto cropped = crop(surface(shapes::sheet(10, 10)), {{2.5, 1, -1}, {7.25, Box3::kInfinity, 1}});
  ASSERT_TRUE(cropped) << cropped.error().describe();
  EXPECT_TRUE(cropped->mesh.validate());
  EXPECT_DOUBLE_EQ(areaOf(cropped->mesh), 4.75 * 9);
  double left = 9, right = 0;
  for (const Vec3& p : cropped->mesh.positions) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    EXPECT_GE(p.y, 1);
  }
  EXPECT_EQ(left, 2.5);
  EXPECT_EQ(right, 7.25);
  EXPECT_GT(cropped->cutTriangles, 0u);
  for (std::size_t t = 0; t < cropped->mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = cropped->mesh.triangles[t];
    const auto& at = cropped->mesh.positions;
    EXPECT_GT(cross(at[b] - at[a], at[c] - at[a]).z, 0) << "turned";
  }
}

TEST(Crop, MakesNoVerticesWhereTheMeshHasThemOnTheBox) {
  const auto cropped = crop(surface(shapes::sheet(10, 10)), {{2, 3, -1}, {6, 8, 1}});
  ASSERT_TRUE(cropped);
  EXPECT_EQ(cropped->mesh.triangles.size(), 2u * 4 * 5);
  EXPECT_EQ(cropped->mesh.positions.size(), 5u * 6);
  EXPECT_EQ(cropped->cutVertices, 0u);
}

TEST(Crop, OfAnInfiniteBoxIsTheMesh) {
  const SurfaceMesh torus = surface(turnedTorus());
  const auto cropped = crop(torus, {});
  ASSERT_TRUE(cropped);
  EXPECT_TRUE(cropped->mesh == torus);
}

TEST(Crop, LeavesAManifoldWhoseBordersLieOnTheBox) {
  const Box3 box{{-2.1, -1.7, -0.9}, {3.1, 2.3, 1.3}};
  const auto cropped = crop(surface(turnedTorus()), box);
  ASSERT_TRUE(cropped);
  const TriangleMesh& mesh = cropped->mesh;
  for (const Vec3& p : mesh.positions) EXPECT_TRUE(isIn(p, box));
  const auto diagnosis = diagnose(mesh);
  ASSERT_TRUE(diagnosis);
  EXPECT_EQ(diagnosis->nonManifoldEdges.count + diagnosis->nonManifoldVertices.count, 0u);
  EXPECT_EQ(diagnosis->turnedEdges.count + diagnosis->tJunctions.count, 0u);
  EXPECT_EQ(diagnosis->degenerateTriangles.count + diagnosis->unusedVertices.count, 0u);
  EXPECT_EQ(diagnosis->doubleVertices.count, 0u);
  EXPECT_GT(diagnosis->borders.size(), 0u);
}

// Tiles meet to the bit: joined at equal positions, they are the closed surface again.
TEST(Crop, MakesTilesThatAreTheWholeWhenJoined) {
  const TriangleMesh torus = turnedTorus();
  const double area = areaOf(torus);
  // The second planes pass through vertices and along the diagonals of a sheet.
  for (const auto& [mesh, planes] :
       {std::pair{torus, std::array<std::vector<double>, 3>{{{-2.1, 0.3, 1.7}, {-0.7, 0.1}, {-0.2, 1.1}}}},
        std::pair{torus,
                  std::array<std::vector<double>, 3>{
                      {{torus.positions[7].x}, {torus.positions[7].y}, {torus.positions[7].z}}}},
        std::pair{shapes::sheet(6, 6, true, true),
                  std::array<std::vector<double>, 3>{{{0, 1. / 3}, {0, 0.1}, {0}}}}}) {
    TriangleMesh together;
    double sum = 0;
    for (const Box3& box : tiles(planes)) {
      const auto cropped = crop(surface(mesh), box);
      if (!cropped) continue;  // nothing is there
      for (const Vec3& p : cropped->mesh.positions) EXPECT_TRUE(isIn(p, box));
      sum += areaOf(cropped->mesh);
      shapes::append(together, cropped->mesh);
    }
    EXPECT_NEAR(sum, areaOf(mesh), 1e-12 * area);
    const auto welded = weld(together);
    ASSERT_TRUE(welded);
    const auto diagnosis = diagnose(welded->mesh, {.selfIntersections = false});
    ASSERT_TRUE(diagnosis);
    EXPECT_EQ(diagnosis->borders.size(), 0u);
    EXPECT_EQ(diagnosis->components.size(), 1u);
    EXPECT_EQ(diagnosis->components[0].eulerNumber, 0);
    EXPECT_TRUE(diagnosis->components[0].isManifold());
  }
}

// A grid whose diagonals run through the corners of the box, where roundings of several cuts meet.
TEST(Crop, MakesTilesOfScaledSheetsThatMeet) {
  for (const double scale : {0.1, 1.0 / 3, 0.7, 1e6 / 7, 1e-9}) {
    TriangleMesh sheet = shapes::sheet(9, 9);
    for (Vec3& p : sheet.positions)
      p = {p.x * scale + 1e3 * scale, p.y * scale - 3 * scale, p.x * p.y * scale};
    const Box3 whole{{sheet.positions.front().x, sheet.positions.front().y, -1e9},
                     {sheet.positions.back().x, sheet.positions.back().y, 1e9}};
    const double x = whole.low.x + (whole.high.x - whole.low.x) / 3,
                 y = whole.low.y + (whole.high.y - whole.low.y) / 3;
    TriangleMesh together;
    for (const Box3& box : tiles({{{x}, {y}, {}}})) {
      const auto cropped = crop(surface(sheet), box);
      ASSERT_TRUE(cropped);
      for (const Vec3& p : cropped->mesh.positions) EXPECT_TRUE(isIn(p, box));
      shapes::append(together, cropped->mesh);
    }
    const auto welded = weld(together);
    ASSERT_TRUE(welded);
    const auto diagnosis = diagnose(welded->mesh, {.selfIntersections = false});
    ASSERT_TRUE(diagnosis);
    EXPECT_EQ(diagnosis->borders.size(), 1u) << scale;
    EXPECT_EQ(diagnosis->components.size(), 1u) << scale;
  }
}

TEST(Crop, OfABoxWithinATriangleIsItsSection) {
  SurfaceMesh mesh = surface({{{-100, -100, 0}, {100, -100, 0}, {0, 200, 0}}, {{0, 1, 2}}});
  const auto cropped = crop(mesh, {{-1, -1, -1}, {1, 1, 1}});
  ASSERT_TRUE(cropped);
  EXPECT_DOUBLE_EQ(areaOf(cropped->mesh), 4);
  EXPECT_EQ(cropped->mesh.positions.size(), 4u);
  EXPECT_EQ(cropped->cutTriangles, 1u);
  EXPECT_EQ(cropped->vertexOf, std::vector<std::uint32_t>(4, SurfaceMesh::kNone));
}

/// An attribute that is a linear function of the place.
Attribute linear(const char* name, ScalarType type, std::span<const Vec3> places) {
  Attribute attribute{.name = name, .type = type};
  for (const Vec3& p : places) attribute.append(std::vector<double>{2 * p.x - 3 * p.y + p.z + 1});
  return attribute;
}

// What happened elsewhere: mikedh/trimesh#1125 and #1798 (colours of vertices and faces, texture coordinates
// lost by a slice), cnr-isti-vclab/meshlab#1498 (all attributes lost).
TEST(Crop, InterpolatesNumbersAndKeepsLabels) {
  SurfaceMesh mesh = surface(turnedTorus());
  mesh.vertexAttributes = {linear("height", ScalarType::float64, mesh.positions)};
  Attribute label{.name = "label", .type = ScalarType::int32};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) label.append(std::vector<double>{double(v)});
  mesh.vertexAttributes.push_back(label);
  std::vector<Vec3> corners;
  Attribute face{.name = "face", .type = ScalarType::uint16};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.wedges.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (const std::uint32_t v : mesh.triangles[t]) corners.push_back(mesh.positions[v]);
    face.append(std::vector<double>{double(t)});
  }
  mesh.wedgeCount = static_cast<std::uint32_t>(corners.size());
  mesh.wedgeAttributes = {linear("u", ScalarType::float64, corners)};
  mesh.triangleAttributes = {face};
  ASSERT_TRUE(mesh.validate());

  const auto cropped = crop(mesh, {{-2.1, -1.7, -0.9}, {3.1, 2.3, 1.3}});
  ASSERT_TRUE(cropped) << cropped.error().describe();
  const SurfaceMesh& part = cropped->mesh;
  ASSERT_TRUE(part.validate()) << part.validate().error().describe();
  ASSERT_GT(cropped->cutVertices, 20u);
  const auto expected = [](const Vec3& p) { return 2 * p.x - 3 * p.y + p.z + 1; };
  for (std::size_t v = 0; v < part.positions.size(); ++v) {
    EXPECT_NEAR(part.vertexAttributes[0].numbers(v)[0], expected(part.positions[v]), 1e-13);
    const auto label_ = static_cast<std::uint32_t>(part.vertexAttributes[1].numbers(v)[0]);
    if (cropped->vertexOf[v] != SurfaceMesh::kNone) {
      EXPECT_EQ(label_, cropped->vertexOf[v]);
    }
  }
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    EXPECT_EQ(part.triangleAttributes[0].numbers(t)[0], cropped->triangleOf[t]);
    const auto& source = mesh.triangles[cropped->triangleOf[t]];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = part.triangles[t][i];
      EXPECT_NEAR(part.wedgeAttributes[0].numbers(part.wedges[t][i])[0], expected(part.positions[v]), 1e-13);
      const auto labelThere = static_cast<std::uint32_t>(part.vertexAttributes[1].numbers(v)[0]);
      if (cropped->vertexOf[v] == SurfaceMesh::kNone)
        EXPECT_LT(labelThere, mesh.positions.size());
      else
        EXPECT_NE(std::ranges::find(source, labelThere), source.end());
    }
  }
}

TEST(Crop, SharesTheWedgesOfCutsBetweenNeighboursThatShareWedges) {
  SurfaceMesh mesh = surface(shapes::sheet(2, 2));
  mesh.wedgeCount = 9;
  mesh.wedges = mesh.triangles;
  mesh.wedgeAttributes = {linear("u", ScalarType::float32, mesh.positions)};
  const auto cropped = crop(mesh, {{0.5, 0.5, -1}, {1.5, 1.5, 1}});
  ASSERT_TRUE(cropped);
  EXPECT_EQ(cropped->mesh.wedgeCount, cropped->mesh.positions.size());
}

TEST(Crop, LeavesOutTheNamesOfWhatIsNotInTheBox) {
  SurfaceMesh mesh = surface(shapes::sheet(2, 1));
  mesh.objects = {"left", "right"};
  mesh.objectOf = {0, 0, 1, 1};
  mesh.materials = {{.name = "moss", .textures = {{"baseColor", "#0"}}},
                    {.name = "sand", .textures = {{"baseColor", "#1"}, {"normal", "sand.png"}}}};
  mesh.materialOf = {0, 0, 1, SurfaceMesh::kNone};
  mesh.groups = {"all"};
  mesh.groupOf = {0, 0, 0, 0};
  mesh.pictures = {{.name = "moss.png", .mimeType = "image/png", .bytes = {}},
                   {.name = "s.png", .mimeType = "image/png", .bytes = {}}};
  const auto cropped = crop(mesh, {{1.25, 0, -1}, {2, 1, 1}});
  ASSERT_TRUE(cropped);
  const SurfaceMesh& part = cropped->mesh;
  EXPECT_TRUE(part.validate());
  EXPECT_EQ(part.objects, std::vector<std::string>{"right"});
  EXPECT_EQ(part.groups, std::vector<std::string>{"all"});
  ASSERT_EQ(part.materials.size(), 1u);
  EXPECT_EQ(part.materials[0].name, "sand");
  ASSERT_EQ(part.pictures.size(), 1u);
  EXPECT_EQ(part.pictures[0].name, "s.png");
  EXPECT_EQ(part.materials[0].textures[0].picture, "#0");
  EXPECT_EQ(part.materials[0].textures[1].picture, "sand.png");
  EXPECT_NE(std::ranges::find(part.materialOf, SurfaceMesh::kNone), part.materialOf.end());
}

TEST(Crop, KeepsTrianglesWholeThatTouchTheBox) {
  const Box3 box{{2.5, 2.5, -1}, {4, 3.5, 1}};
  const auto cropped = crop(surface(shapes::sheet(10, 10)), box, {.keepsWhole = true});
  ASSERT_TRUE(cropped);
  EXPECT_EQ(cropped->cutVertices, 0u);
  // The squares 2 to 4 of x, where those from 4 on touch it, and 2 to 3 of y: all of their triangles but the
  // ones that keep away from the corners.
  std::set<std::uint32_t> kept(cropped->triangleOf.begin(), cropped->triangleOf.end());
  EXPECT_EQ(kept.size(), cropped->mesh.triangles.size());
  EXPECT_TRUE(kept.contains(2 * (2 * 10 + 2)));
  EXPECT_TRUE(kept.contains(2 * (3 * 10 + 4) + 1)) << "it touches along x = 4";
  EXPECT_FALSE(kept.contains(2 * (3 * 10 + 5)));
  EXPECT_FALSE(kept.contains(2 * (4 * 10 + 3)));
}

TEST(Crop, SaysWhereTheMeshIsIfNothingIsInTheBox) {
  const auto outside = crop(surface(shapes::sheet(4, 3)), {{10, 10, 10}, {11, 11, 11}});
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().code, ErrorCode::usage);
  EXPECT_EQ(outside.error().culprit, "box");
  EXPECT_NE(outside.error().message.find("x 0 to 4, y 0 to 3, z 0 to 0"), std::string::npos)
      << outside.error().message;
}

TEST(Crop, RefusesABoxWithoutAnInside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Box3& box :
       {Box3{{1, 0, 0}, {1, 1, 1}}, Box3{{0, 2, 0}, {1, 1, 1}}, Box3{{0, 0, nan}, {1, 1, 1}}}) {
    const auto refused = crop(surface(shapes::tetrahedron()), box);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().culprit, "box");
  }
  EXPECT_FALSE(crop(SurfaceMesh(), {}));
}

TEST(Crop, TakesCoordinatesAtTheEndOfTheirRange) {
  const double most = 1.7e308;
  const auto cropped = crop(surface({{{-most, -most, 0}, {most, -most, 0}, {0, most, 0}}, {{0, 1, 2}}}),
                            {{-1e307, -1e307, -1}, {1e307, 1e307, 1}});
  ASSERT_TRUE(cropped);
  for (const Vec3& p : cropped->mesh.positions) EXPECT_TRUE(isFinite(p));
}

TEST(Crop, TakesAnyTriangles) {
  std::mt19937_64 random(7);
  const auto number = [&] { return double(random() % 9) / 2; };
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const SurfaceMesh mesh = surface(shapes::anything(seed, 12, 20, 5));
    Box3 box{{number(), number(), number()}, {number(), number(), number()}};
    if (!(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z)) continue;
    for (const bool keepsWhole : {false, true}) {
      const auto cropped = crop(mesh, box, {.keepsWhole = keepsWhole});
      if (!cropped) continue;
      EXPECT_TRUE(cropped->mesh.validate());
      EXPECT_LE(areaOf(cropped->mesh), areaOf(mesh) * (1 + 1e-12));
      for (const Vec3& p : cropped->mesh.positions) EXPECT_TRUE(keepsWhole || isIn(p, box)) << seed;
    }
  }
}

}  // namespace
}  // namespace arete
