// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked of a cut by an importance, and attributes of vertices that a displacement moves. The oracles
// search all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "io/query/surface/named_importance.h"
#include "io/query/surface/take_surface.h"
#include "surface/builder/build.h"
#include "surface/displacement/find_displacement.h"
#include "surface/families.h"

namespace arete {
namespace {

/// A globe with a number of its vertices that bends over it, another of floats, and normals.
SurfaceMesh warmGlobe() {
  SurfaceMesh mesh(shapes::globe(40, 24));
  Attribute heat{.name = "heat", .type = ScalarType::float64}, rank{.name = "rank"};
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  for (const Vec3& p : mesh.positions) {
    heat.append(std::array{2 + std::sin(4 * p.x) * std::cos(3 * p.y)});
    rank.append(std::array{p.z > 0.5 ? 8.0 : 1.0});
    normal.append(std::array{p.x, p.y, p.z});
  }
  mesh.vertexAttributes = {heat, rank, normal};
  return mesh;
}

struct Found {
  double distance = std::numeric_limits<double>::infinity(), heat = 0;
};

/// The nearest point of a mesh, and what the first attribute is there.
Found nearestOf(const SurfaceMesh& mesh, const Vec3& p) {
  Found found;
  for (const auto& t : mesh.triangles) {
    const SpaceTriangle place{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    const Vec3 q = nearestOnTriangle(p, place);
    if (!(norm(p - q) < found.distance)) continue;
    found = {norm(p - q), 0};
    const double area = norm(areaNormal(place));
    for (std::size_t k = 0; k < 3; ++k)
      found.heat += norm(cross(place[(k + 1) % 3] - q, place[(k + 2) % 3] - q)) / area *
                    mesh.vertexAttributes.front().numbers(t[k]).front();
  }
  return found;
}

TEST(NamedImportance, HoldsInEveryKindOfRequest) {
  const SurfaceMesh mesh = warmGlobe();
  const auto model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model);
  const Attribute& rank = mesh.vertexAttributes[1];
  std::vector<CutRequest> requests(4, {.maxError = 0.05, .importance = "rank"});
  requests[1].attributeErrors = {{"heat", 0.3, ""}};
  requests[2].maxTriangles = 1'000'000;
  requests[3].maxError.reset();
  requests[3].maxTriangles = 300;
  for (const CutRequest& request : requests) {
    const auto taken = takeSurface(*model, request);
    ASSERT_TRUE(taken) << taken.error().describe();
    ASSERT_TRUE(taken->importance);
    EXPECT_EQ(taken->importance->least, 1);
    EXPECT_EQ(taken->importance->largest, 8);
    EXPECT_LE(taken->importance->weighted, request.maxError.value_or(1));
    for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
      EXPECT_LE(rank.numbers(v).front() * nearestOf(taken->front.mesh, mesh.positions[v]).distance,
                taken->importance->weighted * (1 + 1e-9));
  }
  // The same without it allows more where it is important.
  const auto plain = takeSurface(*model, {.maxError = 0.05});
  ASSERT_TRUE(plain);
  double most = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    most = std::max(most, rank.numbers(v).front() * nearestOf(plain->front.mesh, mesh.positions[v]).distance);
  EXPECT_GT(most, 0.05);
}

TEST(NamedImportance, ThatIsNoNumberOfVerticesIsRefusedByName) {
  SurfaceMesh mesh = warmGlobe();
  Attribute ofFaces{.name = "part", .type = ScalarType::float64};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) ofFaces.append(std::array{1.5});
  mesh.triangleAttributes = {ofFaces};
  const auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  for (const auto& [name, sentence] : {std::pair{"normal", "has 3 numbers"},
                                       {"part", "is not a number of vertices"},
                                       {"weight", "is not an attribute"}}) {
    const auto refused = takeSurface(*model, {.maxError = 0.1, .importance = name});
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_EQ(refused.error().culprit, std::string("importance ") + name);
    EXPECT_NE(refused.error().message.find(sentence), std::string::npos) << refused.error().message;
  }
}

TEST(DisplacedAttributes, AreTheSourcesWhereVerticesAreDrawn) {
  const SurfaceMesh mesh = warmGlobe();
  auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  auto displacement = findDisplacement(*model);
  ASSERT_TRUE(displacement) << displacement.error().describe();
  model->displacement = std::move(*displacement);
  const auto taken = takeSurface(*model, {.maxTriangles = 150});
  ASSERT_TRUE(taken) << taken.error().describe();
  ASSERT_TRUE(taken->isDisplaced);
  ASSERT_EQ(taken->displacedAttributes.size(), 2u) << "whole numbers are labels";
  // The same places with what the source has at its vertices.
  SurfaceMesh stale = taken->front.mesh;
  Attribute& heat = stale.vertexAttributes.front();
  heat = emptyLike(heat);
  for (const std::uint32_t v : taken->front.vertexOf) heat.append(mesh.vertexAttributes.front().element(v));
  std::mt19937_64 random(11);
  double squares = 0, staleSquares = 0;
  constexpr int kSamples = 1500;
  for (int i = 0; i < kSamples; ++i) {
    const auto& t = mesh.triangles[random() % mesh.triangles.size()];
    Vec3 p{};
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      p = p + mesh.positions[t[k]] / 3.0;
      value += mesh.vertexAttributes.front().numbers(t[k]).front() / 3;
    }
    const Found now = nearestOf(taken->front.mesh, p), before = nearestOf(stale, p);
    squares += (now.heat - value) * (now.heat - value);
    staleSquares += (before.heat - value) * (before.heat - value);
  }
  std::printf("RMS %.4f, %.4f with the vertices' own; stated %.4f\n", std::sqrt(squares / kSamples),
              std::sqrt(staleSquares / kSamples), taken->displacedAttributes.front().after);
  EXPECT_LT(squares, 0.9 * staleSquares);
  EXPECT_NEAR(taken->displacedAttributes.front().after, std::sqrt(squares / kSamples),
              0.15 * std::sqrt(squares / kSamples));
  for (std::size_t v = 0; v < taken->front.mesh.positions.size(); ++v) {
    const auto n = taken->front.mesh.vertexAttributes[2].numbers(v);
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-3);
  }
}

TEST(FitOutcomes, StateWhatAttributesAreOffBy) {
  const auto model = buildSurface(warmGlobe());
  ASSERT_TRUE(model);
  const auto taken = takeSurface(*model, {.maxTriangles = 150, .fit = CutFit::rms});
  ASSERT_TRUE(taken);
  ASSERT_TRUE(taken->fit);
  ASSERT_EQ(taken->fit->attributes.size(), 2u) << "whole numbers are labels";
  for (const AttributeRms& of : taken->fit->attributes) {
    EXPECT_FALSE(of.hasGrown()) << of.name;
    EXPECT_GT(of.before, 0) << of.name;
  }
}

}  // namespace
}  // namespace arete
