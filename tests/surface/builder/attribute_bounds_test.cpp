// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a build states of attributes, held against every triangle of a cut: for a point of the source there is
// one point of the cut within the error whose attributes are all within what is stated. The oracle searches
// each triangle for the point where the worst of these ratios is least, a convex function, by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/front/attribute_criterion.h"
#include "surface/front/front.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Colours (bytes) and normals of vertices, coordinates of corners in two charts where x divides them.
SurfaceMesh painted(const TriangleMesh& shape, std::uint64_t seed, bool hasSeam) {
  SurfaceMesh mesh(shape);
  std::mt19937_64 random(seed);
  const auto phase = double(random() % 628) / 100;
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& p : shape.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double size = norm(high - low);
  Attribute color{.name = "color",
                  .meaning = AttributeMeaning::color,
                  .type = ScalarType::uint8,
                  .components = 3,
                  .isNormalized = true};
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  for (const Vec3& p : shape.positions) {
    const double u = (p.x - low.x) / size, v = (p.y - low.y) / size;
    color.append(std::array{127 + 120 * std::sin(9 * u + phase), 127 + 100 * std::cos(7 * v),
                            double(random() % 12) + (u + v > 0.7 ? 200 : 20)});
    const Vec3 n = unit(Vec3{std::sin(5 * u), std::cos(4 * v + phase), 1.5});
    normal.append(std::array{n.x, n.y, n.z});
  }
  mesh.vertexAttributes = {color, normal};
  if (!hasSeam) return mesh;
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (const bool isRight : {false, true})
    for (const Vec3& p : shape.positions)
      coords.append(std::array{(p.x - low.x) / size + 0.05 * std::sin(p.y) + (isRight ? 5 : 0),
                               (p.y - low.y) / size * (isRight ? 2 : 1)});
  const auto vertices = static_cast<std::uint32_t>(shape.positions.size());
  mesh.wedgeCount = 2 * vertices;
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += shape.positions[v].x / 3;
    mesh.wedges.push_back(t);
    if (x > (low.x + high.x) / 2)
      for (std::uint32_t& w : mesh.wedges.back()) w += vertices;
  }
  mesh.wedgeAttributes = {coords};
  return mesh;
}

/// The attributes that are bounded, in the units of the bounds: colour, normal, coordinates.
struct Looks {
  Vec3 color, normal;
  Vec2 coords;
};

/// Of the corners of each face.
std::vector<std::array<Looks, 3>> looksOf(const SurfaceMesh& mesh) {
  std::vector<std::array<Looks, 3>> all(mesh.triangles.size());
  for (std::size_t face = 0; face < all.size(); ++face)
    for (std::size_t c = 0; c < 3; ++c) {
      Looks& looks = all[face][c];
      for (const Attribute& a : mesh.vertexAttributes) {
        const auto n = a.numbers(mesh.triangles[face][c]);
        (a.name == "color" ? looks.color : looks.normal) = {n[0], n[1], n[2]};
      }
      for (const Attribute& a : mesh.wedgeAttributes) {
        const auto n = a.numbers(mesh.wedges[face][c]);
        looks.coords = {n[0], n[1]};
      }
    }
  return all;
}

Looks looksAt(const std::array<Looks, 3>& corners, const std::array<double, 3>& shares) {
  Looks looks;
  for (std::size_t c = 0; c < 3; ++c) {
    looks.color = looks.color + shares[c] * corners[c].color;
    looks.normal = looks.normal + shares[c] * corners[c].normal;
    looks.coords = looks.coords + shares[c] * corners[c].coords;
  }
  return looks;
}

struct Stated {
  double error = 0, color = 0, normal = 0, coords = 0;
};

/// The worst ratio of a distance to what is stated.
double ratioOf(const Looks& a, const Looks& b, double distance, const Stated& stated) {
  const auto over = [](double found, double most) { return found / most; };
  const Vec3 d = a.color - b.color;
  const double channel = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  const double angle =
      std::atan2(norm(cross(a.normal, b.normal)), dot(a.normal, b.normal)) * 180 / std::numbers::pi;
  return std::max({over(distance, stated.error), over(channel, stated.color), over(angle, stated.normal),
                   over(std::hypot(a.coords.x - b.coords.x, a.coords.y - b.coords.y), stated.coords)});
}

/// The least of ratioOf() over a triangle: a grid, then steps in all directions that become smaller.
double leastRatio(const Vec3& p, const Looks& wanted, const SurfaceMesh& cut, std::size_t face,
                  const std::array<Looks, 3>& looks, const Stated& stated) {
  const auto& t = cut.triangles[face];
  const auto at = [&](double u, double v) {
    const std::array<double, 3> shares = {1 - u - v, u, v};
    const Vec3 q =
        shares[0] * cut.positions[t[0]] + shares[1] * cut.positions[t[1]] + shares[2] * cut.positions[t[2]];
    return ratioOf(wanted, looksAt(looks, shares), norm(q - p), stated);
  };
  double least = kInfinity, u = 0, v = 0;
  constexpr int kSide = 8;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; i + j <= kSide; ++j)
      if (const double r = at(double(i) / kSide, double(j) / kSide); r < least)
        least = r, u = double(i) / kSide, v = double(j) / kSide;
  int moves = 0;
  for (double step = 1.0 / kSide; step > 1e-7 && least > 1 && moves < 300; ++moves) {
    bool isBetter = false;
    for (int k = 0; k < 16; ++k) {
      const double angle = k * std::numbers::pi / 8;
      double x = std::clamp(u + step * std::cos(angle), 0.0, 1.0),
             y = std::clamp(v + step * std::sin(angle), 0.0, 1.0);
      if (x + y > 1) {
        const double over = (x + y - 1) / 2;
        x = std::clamp(x - over, 0.0, 1.0);
        y = 1 - x;
      }
      if (const double r = at(x, y); r < least * (1 - 1e-7)) least = r, u = x, v = y, isBetter = true;
    }
    if (!isBetter) step /= 2;
  }
  return least;
}

double boxDistance(const Vec3& p, const SurfaceMesh& cut, std::size_t face) {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const std::uint32_t v : cut.triangles[face]) {
    const Vec3& q = cut.positions[v];
    low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
  }
  return std::hypot(std::max({low.x - p.x, p.x - high.x, 0.0}), std::max({low.y - p.y, p.y - high.y, 0.0}),
                    std::max({low.z - p.z, p.z - high.z, 0.0}));
}

Stated statedBy(const SurfaceModel& model, const Cut& cut) {
  Stated stated{.error = cut.achievedError};
  const std::vector<double> errors = attributeErrorsOf(model, cut);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::string& name = model.attributeErrors[i].name;
    (name == "color" ? stated.color : name == "normal" ? stated.normal : stated.coords) = errors[i];
  }
  return stated;
}

TEST(AttributeBounds, HoldForAPointOfTheCutWithinTheErrorOfEveryPointOfTheSource) {
  const std::uint64_t seed = 81;
  std::mt19937_64 random(seed);
  std::size_t samples = 0;
  double closest = 0;
  for (const bool hasSeam : {false, true})
    for (const shapes::NamedMesh& m : shapes::families(seed)) {
      SCOPED_TRACE(m.name + (hasSeam ? ", two charts" : ""));
      const SurfaceMesh source = painted(m.mesh, seed, hasSeam);
      const auto sourceLooks = looksOf(source);
      const Result<SurfaceModel> model = buildSurface(source, {.boundsAttributes = true});
      ASSERT_TRUE(model) << model.error().describe();
      ASSERT_EQ(model->attributeErrors.size(), hasSeam ? 3u : 2u);
      ASSERT_TRUE(model->validate());
      for (const double part : {0.002, 0.01, 0.04}) {
        const Result<Cut> cut = takeCut(model->mt, UniformError(part * model->diagonal));
        ASSERT_TRUE(cut);
        const SurfaceFront front = surfaceOf(*model, *cut);
        const auto cutLooks = looksOf(front.mesh);
        Stated stated = statedBy(*model, *cut);
        // What the search does not find of a point.
        stated = {stated.error + 1e-4 * model->diagonal, stated.color + 0.05, stated.normal + 0.05,
                  stated.coords + 1e-4};
        for (int i = 0; i < 60; ++i) {
          const std::size_t face = random() % source.triangles.size();
          double u = double(random() % 1001) / 1000, v = double(random() % 1001) / 1000;
          if (u + v > 1) u = 1 - u, v = 1 - v;
          const std::array<double, 3> shares = {1 - u - v, u, v};
          Vec3 p;
          for (std::size_t c = 0; c < 3; ++c) p = p + shares[c] * source.positions[source.triangles[face][c]];
          const Looks wanted = looksAt(sourceLooks[face], shares);
          double least = kInfinity;
          for (std::size_t t = 0; t < front.mesh.triangles.size() && least > 1; ++t)
            if (boxDistance(p, front.mesh, t) <= stated.error * (1 + 1e-9) + 1e-12)
              least = std::min(least, leastRatio(p, wanted, front.mesh, t, cutLooks[t], stated));
          EXPECT_LE(least, 1.001) << "at " << p.x << " " << p.y << " " << p.z << " to " << part;
          closest = std::max(closest, least);
          ++samples;
        }
      }
    }
  std::printf("%zu points, at most %.4f of what is stated\n", samples, closest);
}

TEST(AttributeBounds, AToleranceIsKeptByEveryTriangleAndOneThatNothingReachesChangesNothing) {
  const std::uint64_t seed = 82;
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> model = buildSurface(painted(m.mesh, seed, true), {.boundsAttributes = true});
    ASSERT_TRUE(model);
    const UniformError shape(0.03 * model->diagonal);
    const Result<Cut> alone = takeCut(model->mt, shape);
    ASSERT_TRUE(alone);
    for (std::size_t i = 0; i < model->attributeErrors.size(); ++i)
      for (const double most : {0.0, 5.0, 1e6}) {
        const AttributeCriterion both(shape, *model, {{i, most}});
        const Result<Cut> cut = takeCut(model->mt, both);
        ASSERT_TRUE(cut);
        const StatedAttributes stated = statedAttributes(*model, *cut, both);
        EXPECT_LE(stated.largest[i], most);
        EXPECT_GE(stated.error, cut->achievedError);
        EXPECT_LE(stated.error, 0.03 * model->diagonal);
        EXPECT_GE(cut->ids.size(), alone->ids.size());
        if (most == 1e6) {
          EXPECT_EQ(cut->ids, alone->ids);
        }
      }
  }
}

/// As versions before the distances have it.
SurfaceModel withoutDistances(SurfaceModel model) {
  model.attributeDistances.clear();
  for (AttributeErrors& errors : model.attributeErrors) errors.codes.resize(model.mt.triangleIdCount());
  return model;
}

TEST(AttributeBounds, HoldWithTolerancesWithinTheDistancesThatTheCutAllowsAndNeedFewerTrianglesThere) {
  const std::uint64_t seed = 83;
  std::mt19937_64 random(seed);
  std::size_t samples = 0, here = 0, before = 0;
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const SurfaceMesh source = painted(m.mesh, seed, true);
    const auto sourceLooks = looksOf(source);
    const Result<SurfaceModel> model = buildSurface(source, {.boundsAttributes = true});
    ASSERT_TRUE(model) << model.error().describe();
    ASSERT_EQ(model->attributeDistances.size(), 4u);
    const SurfaceModel earlier = withoutDistances(*model);
    ASSERT_TRUE(earlier.validate());
    for (const double part : {0.003, 0.011, 0.05}) {
      const UniformError shape(part * model->diagonal);
      const std::vector<AttributeTolerance> asked = {{random() % 3, 1 + double(random() % 10)}};
      const AttributeCriterion both(shape, *model, asked), ofEarlier(shape, earlier, asked);
      const Result<Cut> cut = takeCut(model->mt, both), old = takeCut(earlier.mt, ofEarlier);
      ASSERT_TRUE(cut && old);
      here += cut->ids.size();
      before += old->ids.size();
      EXPECT_LE(cut->ids.size(), old->ids.size());
      const StatedAttributes found = statedAttributes(*model, *cut, both);
      EXPECT_LE(found.error, part * model->diagonal);
      EXPECT_LE(found.largest[asked[0].index], asked[0].most);
      const SurfaceFront front = surfaceOf(*model, *cut);
      const auto cutLooks = looksOf(front.mesh);
      Stated stated{.error = found.error + 1e-4 * model->diagonal};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string& name = model->attributeErrors[i].name;
        (name == "color"    ? stated.color
         : name == "normal" ? stated.normal
                            : stated.coords) =
            found.largest[i] + (name == "color" || name == "normal" ? 0.05 : 1e-4);
      }
      for (int i = 0; i < 40; ++i) {
        const std::size_t face = random() % source.triangles.size();
        double u = double(random() % 1001) / 1000, v = double(random() % 1001) / 1000;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const std::array<double, 3> shares = {1 - u - v, u, v};
        Vec3 p;
        for (std::size_t c = 0; c < 3; ++c) p = p + shares[c] * source.positions[source.triangles[face][c]];
        const Looks wanted = looksAt(sourceLooks[face], shares);
        double least = kInfinity;
        for (std::size_t t = 0; t < front.mesh.triangles.size() && least > 1; ++t)
          if (boxDistance(p, front.mesh, t) <= stated.error * (1 + 1e-9) + 1e-12)
            least = std::min(least, leastRatio(p, wanted, front.mesh, t, cutLooks[t], stated));
        EXPECT_LE(least, 1.001) << "at " << p.x << " " << p.y << " " << p.z << " to " << part;
        ++samples;
      }
    }
  }
  std::printf("%zu points; %zu triangles, %zu within the triangles' own errors\n", samples, here, before);
}

TEST(AttributeBounds, OfThePaintedHalvesOfAPlateKeepTheLineBetweenThem) {
  // 40 x 30 squares, black to the left of column 20 and white from it on: the fewest triangles that keep both
  // colours and the ramp between them are six.
  SurfaceMesh mesh(shapes::sheet(40, 30));
  Attribute color{.name = "color",
                  .meaning = AttributeMeaning::color,
                  .type = ScalarType::uint8,
                  .components = 3,
                  .isNormalized = true};
  for (const Vec3& p : mesh.positions) {
    const double c = p.x < 20 ? 0 : 255;
    color.append(std::array{c, c, c});
  }
  mesh.vertexAttributes = {color};
  const Result<SurfaceModel> model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model);
  const UniformError shape(0.001 * model->diagonal);
  const Result<Cut> cut = takeCut(model->mt, AttributeCriterion(shape, *model, {{0, 8}}));
  ASSERT_TRUE(cut);
  std::printf("%zu triangles\n", cut->ids.size());
  EXPECT_LE(cut->ids.size(), 8u);
  EXPECT_LE(statedAttributes(*model, *cut, AttributeCriterion(shape, *model, {{0, 8}})).largest[0], 8);
}

TEST(AttributeBounds, OfTangentsKeepTheirSign) {
  SurfaceMesh mesh(shapes::sheet(12, 12));
  Attribute tangent{.name = "tangent", .meaning = AttributeMeaning::tangent, .components = 4};
  for (const Vec3& p : mesh.positions) tangent.append(std::array{1.0, 0.0, 0.0, p.x < 6 ? 1.0 : -1.0});
  mesh.vertexAttributes = {tangent};
  const Result<SurfaceModel> model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model);
  const UniformError shape(model->diagonal);
  const Result<Cut> cut = takeCut(model->mt, AttributeCriterion(shape, *model, {{0, 1}}));
  ASSERT_TRUE(cut);
  EXPECT_LE(statedAttributes(*model, *cut, AttributeCriterion(shape, *model, {{0, 1}})).largest[0], 1);
  // A triangle that is coarser than the source's has one sign, and stands for one.
  for (const std::uint32_t t : cut->ids) {
    if (!model->mt.remover(TriangleId(t)).isValid()) continue;
    std::size_t negative = 0;
    for (const std::uint32_t v : model->mt.corners(TriangleId(t)))
      negative += model->attributes.vertexAttributes[0].numbers(v)[3] < 0 ? 1 : 0;
    EXPECT_TRUE(negative == 0 || negative == 3);
  }
  EXPECT_GT(cut->ids.size(), 12u);
}

TEST(AttributeBounds, AreNotThereWithoutTheOption) {
  const Result<SurfaceModel> model = buildSurface(painted(shapes::sheet(6, 6), 1, true));
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->attributeErrors.empty());
}

TEST(AttributeBounds, OfLabelsOfVerticesAreNothingOrUnbounded) {
  SurfaceMesh mesh(shapes::sheet(12, 12));
  Attribute label{.name = "id", .type = ScalarType::int32};
  for (const Vec3& p : mesh.positions) label.append(std::array{p.x < 6 ? 3.0 : 4.0});
  mesh.vertexAttributes = {label};
  const Result<SurfaceModel> model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model);
  const UniformError shape(model->diagonal);
  const Result<Cut> cut = takeCut(model->mt, AttributeCriterion(shape, *model, {{0, 0}}));
  ASSERT_TRUE(cut);
  EXPECT_EQ(statedAttributes(*model, *cut, AttributeCriterion(shape, *model, {{0, 0}})).largest[0], 0);
}

}  // namespace
}  // namespace arete
