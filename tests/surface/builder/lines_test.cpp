// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <span>

#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "surface/builder/build.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"
#include "surface/parted.h"

namespace arete {
namespace {

using parted::Part;
using parted::partAt;

SurfaceModel built(SurfaceMesh mesh) {
  Result<SurfaceModel> model = buildSurface(std::move(mesh));
  EXPECT_TRUE(model) << (model ? "" : model.error().describe());
  return model ? std::move(*model) : SurfaceModel{};
}

Cut within(const SurfaceModel& model, double error) {
  const Result<Cut> cut = takeCut(model.mt, UniformError(error));
  EXPECT_TRUE(cut);
  return *cut;
}

Cut anyCut(const MultiTriangulation& mt, std::mt19937_64& random) {
  NodeSet set(mt.nodeCount(), 0);
  const std::uint64_t some = random() % (mt.nodeCount() / 4 + 2);
  for (std::uint64_t i = 0; i < some && mt.nodeCount() > 0; ++i) set[random() % mt.nodeCount()] = 1;
  closeUpwards(mt, set);
  return front(mt, set);
}

double areaOf(const SurfaceMesh& mesh, std::uint32_t material) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (mesh.materialOf[t] == material)
      sum += norm(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])) / 2;
  }
  return sum;
}

/// A plate of n x n squares with a square of half its side in the middle.
SurfaceMesh plateWithASquare(std::uint32_t n, const parted::Carriers& carriers) {
  const TriangleMesh plate = shapes::sheet(n, n);
  std::vector<std::uint32_t> parts;
  for (const auto& [a, b, c] : plate.triangles) {
    const Vec3 p = (plate.positions[a] + plate.positions[b] + plate.positions[c]) / (3.0 * n);
    parts.push_back(std::abs(p.x - 0.5) < 0.25 && std::abs(p.y - 0.5) < 0.25 ? 1 : 0);
  }
  return parted::withParts(plate, parts, carriers);
}

TEST(Lines, OfASquareInAPlateTakeItsFourCorners) {
  for (const parted::Carriers& carriers :
       {parted::Carriers{.objects = true, .materials = true}, parted::Carriers{.materials = true},
        parted::Carriers{.materials = true, .labels = true},
        parted::Carriers{.materials = true, .charts = true}}) {
    const SurfaceModel model = built(plateWithASquare(12, carriers));
    EXPECT_TRUE(model.boundsLines);
    const SurfaceFront exact = surfaceOf(model, within(model, 1e-9 * model.diagonal));
    EXPECT_EQ(exact.mesh.triangles.size(), 10u);
    EXPECT_NEAR(areaOf(exact.mesh, 1), 36, 1e-9);
    EXPECT_NEAR(areaOf(exact.mesh, 0), 108, 1e-9);
    const SurfaceFront root = surfaceOf(model, frontOfPrefix(model.mt, 0));
    EXPECT_GT(areaOf(root.mesh, 1), 0) << "no part vanishes";
  }
}

TEST(Lines, OfLabelsAloneCount) {
  for (const ScalarType type : {ScalarType::int8, ScalarType::uint8, ScalarType::int16, ScalarType::uint32}) {
    SurfaceMesh mesh = plateWithASquare(12, {.materials = true});
    Attribute labels{.name = "class", .type = type};
    for (const std::uint32_t part : mesh.materialOf) labels.append(std::array{double(part) + 3});
    mesh.materialOf.clear();
    mesh.materials.clear();
    mesh.triangleAttributes = {labels};
    const SurfaceModel model = built(mesh);
    const SurfaceFront exact = surfaceOf(model, within(model, 1e-9 * model.diagonal));
    EXPECT_EQ(exact.mesh.triangles.size(), 10u);
  }
  // Numbers that are no labels make no lines, nor do equal ones.
  SurfaceMesh mesh = plateWithASquare(12, {.labels = true});
  Attribute heights{.name = "quality", .type = ScalarType::float32};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) heights.append(std::array{double(t) + 0.5});
  mesh.triangleAttributes = {heights};
  EXPECT_FALSE(built(mesh).boundsLines);
  Attribute equal{.name = "class", .type = ScalarType::int32};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) equal.append(std::array{7.0});
  mesh.triangleAttributes = {equal};
  EXPECT_FALSE(built(mesh).boundsLines);
}

/// A disc of so many points around in a larger one, or in a square; radii by ring and angle.
template <class RadiusAt>
SurfaceMesh discInADisc(std::uint32_t around, std::uint32_t rings, std::uint32_t inner, bool isSquare,
                        const RadiusAt& radius) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> parts;
  mesh.positions.push_back({0, 0, 0});
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around, x = std::cos(angle), y = std::sin(angle);
      const double wide = isSquare && r == rings ? 1 / std::max(std::abs(x), std::abs(y)) : 1;
      mesh.positions.push_back({wide * radius(r, angle) * x, wide * radius(r, angle) * y, 0});
    }
  const auto at = [&](std::uint32_t r, std::uint32_t i) { return 1 + (r - 1) * around + i % around; };
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    parts.push_back(1);
    for (std::uint32_t r = 1; r < rings; ++r) {
      mesh.triangles.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
      mesh.triangles.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
      parts.insert(parts.end(), 2, r < inner ? 1 : 0);
    }
  }
  return parted::withParts(mesh, parts, {.materials = true});
}

/// The segments that [DouglasPeucker1973] leaves of a closed line within a distance.
std::size_t douglasPeucker(const std::vector<Vec3>& line, double error) {
  std::vector<Vec3> closed = line;
  closed.push_back(line.front());
  std::size_t far = 1;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (norm(line[i] - line[0]) > norm(line[far] - line[0])) far = i;
  const auto segments = [&](const auto& self, std::size_t from, std::size_t to) -> std::size_t {
    double most = 0;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vec3 d = closed[to] - closed[from];
      const double t = std::clamp(dot(closed[i] - closed[from], d) / dot(d, d), 0.0, 1.0);
      const double away = norm(closed[i] - closed[from] - d * t);
      if (away > most) most = away, at = i;
    }
    return most <= error ? 1 : self(self, from, at) + self(self, at, to);
  };
  return std::max<std::size_t>(3, segments(segments, 0, far) + segments(segments, far, line.size()));
}

std::size_t lineEdges(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::uint32_t>> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      sides[{std::min(a, b), std::max(a, b)}].insert(mesh.materialOf[t]);
    }
  return static_cast<std::size_t>(
      std::ranges::count_if(sides, [](const auto& s) { return s.second.size() > 1; }));
}

/// A polygon in a square, without a vertex inside: its triangles are a fan or a strip; outside each edge has
/// one with a corner of the square.
SurfaceMesh polygonInASquare(std::uint32_t around, bool isFan) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / around;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (const Vec3& corner : {Vec3{2, 2, 0}, Vec3{-2, 2, 0}, Vec3{-2, -2, 0}, Vec3{2, -2, 0}})
    mesh.positions.push_back(corner);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t part) {
    mesh.triangles.push_back({a, b, c});
    parts.push_back(part);
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around, corner = i * 4 / around, after = next * 4 / around;
    add(i, around + corner, next, 0);
    if (after != corner) add(next, around + corner, around + after, 0);
  }
  for (std::uint32_t low = 0, high = around - 1; high - low > 1;) {
    const bool takesLow = isFan || (low + high) % 2 == 1;
    if (takesLow) {
      add(isFan ? 0 : low, isFan ? high - 1 : low + 1, high, 1);
      isFan ? --high : ++low;
    } else {
      add(low, high - 1, high, 1);
      --high;
    }
  }
  return parted::withParts(mesh, parts, {.materials = true});
}

TEST(Lines, OfPolygonsWithoutAVertexInsideTakeHardlyMoreSegmentsThanDouglasPeucker) {
  for (const bool isFan : {false, true}) {
    const SurfaceMesh mesh = polygonInASquare(1000, isFan);
    const SurfaceModel model = built(mesh);
    EXPECT_EQ(model.mt.finestTriangleCount(), 998u + 1004u);
    const std::vector<Vec3> line(mesh.positions.begin(), mesh.positions.begin() + 1000);
    for (const double error : {0.0003, 0.003, 0.03}) {
      const std::size_t ours = lineEdges(surfaceOf(model, within(model, error)).mesh);
      const std::size_t theirs = douglasPeucker(line, error);
      EXPECT_LE(double(ours), 1.5 * double(theirs)) << (isFan ? "fan" : "strip") << " within " << error;
    }
  }
}

/// The one closed line between two materials.
std::vector<Vec3> lineOf(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      sides[{std::min(a, b), std::max(a, b)}].push_back(mesh.materialOf[t]);
    }
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  for (const auto& [edge, of] : sides)
    if (of.size() == 2 && of[0] != of[1]) {
      next[edge.first].push_back(edge.second);
      next[edge.second].push_back(edge.first);
    }
  std::vector<Vec3> line;
  const std::uint32_t first = next.begin()->first;
  std::uint32_t before = first, at = next[first][0];
  line.push_back(mesh.positions[first]);
  while (at != first) {
    EXPECT_EQ(next[at].size(), 2u);
    line.push_back(mesh.positions[at]);
    const std::uint32_t to = next[at][0] == before ? next[at][1] : next[at][0];
    before = at;
    at = to;
  }
  EXPECT_EQ(line.size(), next.size());
  return line;
}

TEST(Lines, OfStaircasesTakeHardlyMoreSegmentsThanDouglasPeucker) {
  // Faces of a grid that belong to the disc in which their square, or they themselves, have their middle.
  const std::uint32_t n = test::isFull() ? 160 : 60;
  for (const bool isBySquare : {true, false})
    for (const bool isMirrored : {false, true}) {
      TriangleMesh plate = shapes::sheet(n, n);
      if (isMirrored)
        for (std::uint32_t t = 0; t < plate.triangles.size(); t += 2) {
          const auto [a, b, c] = plate.triangles[t];
          const std::uint32_t d = plate.triangles[t + 1][2];
          plate.triangles[t] = {a, b, d};
          plate.triangles[t + 1] = {b, c, d};
        }
      std::vector<std::uint32_t> parts;
      for (std::size_t t = 0; t < plate.triangles.size(); ++t) {
        Vec3 p{};
        for (std::size_t of = isBySquare ? t / 2 * 2 : t, i = 0; i < (isBySquare ? 2 : 1); ++i)
          for (const std::uint32_t v : plate.triangles[of + i])
            p = p + plate.positions[v] / (isBySquare ? 6.0 : 3.0);
        parts.push_back(norm(p - Vec3{0.5 * n + 0.1, 0.5 * n + 0.2, 0}) < 0.35 * n ? 1 : 0);
      }
      const SurfaceMesh mesh = parted::withParts(plate, parts, {.materials = true});
      const std::vector<Vec3> line = lineOf(mesh);
      const SurfaceModel model = built(mesh);
      for (const double error : {0.1, 0.5, 0.8, 1.5, 3.0, 6.0}) {
        const std::size_t ours = lineEdges(surfaceOf(model, within(model, error)).mesh);
        const std::size_t theirs = douglasPeucker(line, error);
        EXPECT_LE(double(ours), 1.5 * double(theirs)) << isBySquare << isMirrored << " within " << error;
      }
    }
}

TEST(Lines, OfRoundPatchesTakeHardlyMoreSegmentsThanDouglasPeucker) {
  struct Case {
    const char* name;
    std::uint32_t around, rings, inner;
    double waves, depth, noise;
    bool isSquare = true;
  };
  const std::vector<Case> all = {{"circle", 1000, 3, 1, 0, 0, 0},
                                 {"coast", 1000, 4, 2, 5, 0.1, 0.01},
                                 {"one ring inside", 1000, 2, 1, 0, 0, 0},
                                 {"circle in a disc", 1000, 2, 1, 0, 0, 0, false},
                                 {"flower", 1000, 6, 3, 7, 0.2, 0},
                                 {"fine rings", 1000, 12, 6, 3, 0.05, 0},
                                 {"fine rings in a disc", 1000, 12, 6, 3, 0.05, 0, false}};
  for (const Case& c : std::span(all).first(test::isFull() ? all.size() : 4)) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(-1, 1);
    std::map<std::pair<std::uint32_t, double>, double> known;
    const SurfaceMesh mesh =
        discInADisc(c.around, c.rings, c.inner, c.isSquare, [&](std::uint32_t r, double angle) {
          const auto [at, isNew] = known.try_emplace({r, angle}, 0);
          if (isNew)
            at->second =
                r / double(c.inner) *
                (1 + (r == c.rings ? 0 : c.depth * std::sin(c.waves * angle) + c.noise * share(random)));
          return at->second;
        });
    std::vector<Vec3> line;
    for (std::uint32_t i = 0; i < c.around; ++i)
      line.push_back(mesh.positions[1 + (c.inner - 1) * c.around + i]);
    const SurfaceModel model = built(mesh);
    for (const double error : {0.0003, 0.001, 0.003, 0.01, 0.03, 0.1}) {
      const std::size_t ours = lineEdges(surfaceOf(model, within(model, error)).mesh);
      const std::size_t theirs = douglasPeucker(line, error);
      EXPECT_LE(double(ours), 1.5 * double(theirs)) << c.name << " within " << error;
      EXPECT_GE(ours, 3u);
    }
  }
}

TEST(Lines, OfRandomSurfacesStayWithinTheErrorOfEveryCut) {
  const std::uint64_t count = test::isFull() ? 2000 : test::isBrief() ? 20 : 120;
  std::size_t cuts = 0, reduced = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const parted::RandomSurface surface = parted::randomSurface(seed);
    SCOPED_TRACE(surface.name);
    const SurfaceModel model = built(surface.mesh);
    std::mt19937_64 random(seed);
    const SurfaceFront finest = finestSurfaceOf(model);
    const std::vector<parted::Sample> samples = parted::samplesOf(surface.mesh, random);
    std::vector<Cut> all = {frontOfPrefix(model.mt, 0), anyCut(model.mt, random),
                            within(model, 1e-9 * model.diagonal), within(model, 0.01 * model.diagonal),
                            within(model, 0.05 * model.diagonal)};
    const auto most = static_cast<std::uint32_t>(model.mt.rootTriangleCount() + random() % 30);
    const Result<Cut> budget = takeCut(
        model.mt, UniformError(0), {.maxTriangles = most, .order = std::make_shared<LargestSquaresFirst>()});
    ASSERT_TRUE(budget);
    all.push_back(*budget);
    for (const Cut& cut : all) {
      const SurfaceFront front = surfaceOf(model, cut);
      const auto found = parted::violation(samples, front.mesh, cut.achievedError);
      ASSERT_FALSE(found) << *found << ", " << cut.triangles.size() << " triangles";
      ++cuts;
      reduced += front.mesh.triangles.size() < finest.mesh.triangles.size() ? 1 : 0;
    }
    const Status valid = validateSurface(model, {.everySample = true});
    ASSERT_TRUE(valid) << valid.error().message;
  }
  EXPECT_GT(2 * reduced, cuts) << "most cuts are smaller";
  if (test::isFull())
    std::printf("%zu cuts of %zu surfaces, %zu of them smaller\n", cuts, std::size_t(count), reduced);
}

}  // namespace
}  // namespace arete
