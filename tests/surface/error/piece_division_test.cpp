// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/piece_division.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "surface/families.h"

namespace arete {
namespace {

HoleTriangulation fan(int corners) {
  HoleTriangulation triangles;
  for (int i = 1; i + 1 < corners; ++i) triangles.add(0, i, i + 1);
  return triangles;
}

/// A vertex of a rough fan: its faces are the original, the hole is filled from corner 0.
struct Star {
  TriangleMesh mesh;
  std::vector<Vec3> link;
  OriginalSurface original() const { return {mesh.positions, mesh.triangles, 10}; }
};

Star star(std::uint64_t seed, int corners) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  Star s;
  s.mesh.positions.push_back({0.1 * number(), 0.1 * number(), 0.3 * number()});
  for (int i = 0; i < corners; ++i) {
    const double at = 2 * std::numbers::pi * i / corners;
    s.link.push_back({std::cos(at) + 0.2 * number(), std::sin(at) + 0.2 * number(), 0.2 * number()});
    s.mesh.positions.push_back(s.link.back());
    s.mesh.triangles.push_back(
        {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % corners)});
  }
  return s;
}

/// Coordinates that are about those in the plan, and a number that has nothing to do with places.
SurfaceMesh painted(const Star& s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  SurfaceMesh mesh(s.mesh);
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2},
      heat{.name = "heat", .type = ScalarType::float64};
  for (const Vec3& p : mesh.positions) {
    coords.append(std::array{p.x + 0.3 * number(), p.y + 0.3 * number()});
    heat.append(std::array{number()});
  }
  mesh.vertexAttributes = {coords, heat};
  return mesh;
}

/// With and without attributes, which change what belongs where and not what holds there.
class PieceDivisionOfStars : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Attributes, PieceDivisionOfStars, ::testing::Bool());

TEST_P(PieceDivisionOfStars, CoversEveryPointWithinTheBoundOfItsTriangle) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const int corners = 4 + int(seed % 5);
    const Star s = star(seed, corners);
    const OriginalSurface original = s.original();
    const SurfaceMesh mesh = painted(s, seed);
    const AttributeField field = GetParam() ? AttributeField(mesh, 2) : AttributeField();
    PieceDivision division(original, field);
    division.clear();
    for (std::uint32_t f = 0; f < s.mesh.triangles.size(); ++f) division.add(f);
    const HoleTriangulation floor = fan(corners);
    std::vector<std::array<std::uint32_t, 3>> drawn;
    for (int t = 0; t < floor.size && GetParam(); ++t)
      drawn.push_back({floor.triangles[t][0] + 1u, floor.triangles[t][1] + 1u, floor.triangles[t][2] + 1u});
    division.divide(s.link, floor, (1u << floor.size) - 1, drawn);
    struct Part {
      int triangle;
      std::uint32_t face;
      FacePolygon polygon;
    };
    std::vector<Part> parts;
    for (int t = 0; t < floor.size; ++t) {
      const auto [i, j, m] = floor.triangles[t];
      const SpaceTriangle place{s.link[i], s.link[j], s.link[m]};
      division.takePieces(t).forEach([&](const Piece& piece) {
        parts.push_back({t, piece.face, {piece.polygon.begin(), piece.polygon.end()}});
        const SpaceTriangle face = original.face(piece.face);
        Vec3 middle;
        for (const FacePoint& p : piece.polygon) {
          EXPECT_LE(distanceToTriangle(placeOf(p, face), place), division.bound(t)) << "seed " << seed;
          middle = middle + placeOf(p, face) / double(piece.polygon.size());
        }
        EXPECT_LE(distanceToTriangle(middle, place), division.bound(t)) << "seed " << seed;
      });
      EXPECT_LE(division.rms(t), division.bound(t));
    }
    // Every point of every face is in one of its pieces, but for the rounding of new corners.
    std::mt19937_64 random(seed);
    for (std::uint32_t f = 0; f < s.mesh.triangles.size(); ++f)
      for (int k = 0; k < 40; ++k) {
        const auto u = static_cast<std::uint32_t>(random() % FacePoint::kOne);
        const FacePoint p{u, static_cast<std::uint32_t>(random() % (FacePoint::kOne - u))};
        const auto holds = [&](const FacePolygon& polygon) {
          for (std::size_t i = 0; i < polygon.size(); ++i) {
            const FacePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double turn =
                (double(b.u) - a.u) * (double(p.v) - a.v) - (double(b.v) - a.v) * (double(p.u) - a.u);
            if (turn < -4.0 * FacePoint::kOne) return false;
          }
          return true;
        };
        EXPECT_TRUE(std::ranges::any_of(
            parts, [&](const Part& part) { return part.face == f && holds(part.polygon); }))
            << "seed " << seed << ", face " << f;
      }
  }
}

TEST(PieceDivision, CutsWhatLiesAcrossAnEdgeOfTheFloorWhereThatIsFlat) {
  // A flat square around a middle vertex: no point is off the two triangles that fill it.
  Star s;
  s.link = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.mesh.positions = {{0.3, 0.4, 0}, s.link[0], s.link[1], s.link[2], s.link[3]};
  s.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const OriginalSurface original{s.mesh.positions, s.mesh.triangles, 1};
  PieceDivision division(original);
  division.clear();
  for (std::uint32_t f = 0; f < 4; ++f) division.add(f);
  division.divide(s.link, fan(4));
  for (int t = 0; t < 2; ++t) EXPECT_LT(division.bound(t), 1e-8);
}

TEST(PieceDivision, FollowsTheCoordinatesWhereTheyBendAcrossAnEdgeOfTheFloor) {
  // A flat square whose coordinates are bent: in them the way from corner 0 to corner 2 is not the diagonal.
  Star s;
  s.link = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.mesh.positions = {{0.5, 0.5, 0}, s.link[0], s.link[1], s.link[2], s.link[3]};
  s.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const OriginalSurface original{s.mesh.positions, s.mesh.triangles, 1};
  SurfaceMesh mesh(s.mesh);
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (std::size_t v = 0; v < 5; ++v)
    coords.append(v == 0 ? std::array{0.6, 0.4} : std::array{mesh.positions[v].x, mesh.positions[v].y});
  mesh.vertexAttributes = {coords};
  const AttributeField field(mesh, 1);
  PieceDivision division(original, field);
  division.clear();
  for (std::uint32_t f = 0; f < 4; ++f) division.add(f);
  const std::vector<std::array<std::uint32_t, 3>> drawn = {{1, 2, 3}, {1, 3, 4}};
  division.divide(s.link, fan(4), 3, drawn);
  // The middle lies on the diagonal in place and below it in the picture, half of both counts.
  EXPECT_GT(division.bound(0), 0.01);
  EXPECT_LT(division.bound(0), 0.1);
}

}  // namespace
}  // namespace arete
