// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices of seams and of lines between parts, fitted along the source's lines.
#include "surface/fit/fit_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/fit/attribute_fit.h"
#include "surface/fit/fit.h"
#include "surface/fit/held_vertices.h"
#include "surface/fit/line_samples.h"
#include "surface/front/front.h"
#include "surface/parted.h"

namespace arete {
namespace {

struct CutOfMesh {
  SurfaceMesh source, cut;
};

CutOfMesh cutOfMesh(SurfaceMesh mesh, double share) {
  const auto most = static_cast<std::uint32_t>(share * double(mesh.triangles.size()));
  const auto model = buildSurface(std::move(mesh));
  if (!model) throw std::runtime_error(model.error().message);
  const auto cut =
      takeCut(model->mt, UniformError(0), {.maxTriangles = std::max(most, model->mt.rootTriangleCount())});
  if (!cut) throw std::runtime_error(cut.error().message);
  return {finestSurfaceOf(*model).mesh, surfaceOf(*model, *cut).mesh};
}

std::vector<std::uint8_t> heldBeside(const SurfaceMesh& cut, const FitLines& lines) {
  std::vector<std::uint8_t> isHeld = heldVertices(cut, false);
  for (std::size_t v = 0; v < lines.mayMove.size(); ++v)
    if (lines.mayMove[v] != 0) isHeld[v] = 0;
  return isHeld;
}

using Place = std::tuple<double, double, double>;
Place placeOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}

/// By edge, as its places: the parts of its faces.
using PartsAt = std::map<std::pair<Place, Place>, std::vector<parted::Part>>;
PartsAt partsAtEdges(const SurfaceMesh& mesh) {
  PartsAt at;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      Place a = placeOf(mesh.positions[mesh.triangles[t][i]]),
            b = placeOf(mesh.positions[mesh.triangles[t][(i + 1) % 3]]);
      if (b < a) std::swap(a, b);
      at[{a, b}].push_back(parted::partAt(mesh, t));
    }
  return at;
}
bool isLine(const PartsAt& at, const Vec3& a, const Vec3& b) {
  const auto found = at.find(std::minmax(placeOf(a), placeOf(b)));
  return found != at.end() && found->second.size() == 2 && found->second[0] != found->second[1];
}

TEST(FitLines, AreWaysAlongLinesOfTheSourceBetweenVerticesOfTheCut) {
  std::size_t moving = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const parted::RandomSurface random = parted::randomSurface(seed);
    SCOPED_TRACE(random.name);
    const CutOfMesh f = cutOfMesh(random.mesh, 0.4);
    const FitLines lines = fitLines(f.cut, f.source);
    const PartsAt ofSource = partsAtEdges(f.source), ofCut = partsAtEdges(f.cut);
    for (const FitLines::Edge& edge : lines.edges) {
      const Vec3 &a = f.cut.positions[edge.ends[0]], &b = f.cut.positions[edge.ends[1]];
      EXPECT_TRUE(isLine(ofCut, a, b));
      ASSERT_GE(edge.way.size(), 2u);
      EXPECT_EQ(edge.way.front(), a);
      EXPECT_EQ(edge.way.back(), b);
      for (std::size_t i = 0; i + 1 < edge.way.size(); ++i)
        EXPECT_TRUE(isLine(ofSource, edge.way[i], edge.way[i + 1]));
      for (std::size_t end = 0; end < 2; ++end) {
        const std::uint32_t next = edge.next[end];
        if (next == MeshAttributes::kNone) continue;
        EXPECT_EQ(std::ranges::count(lines.edges[next].ends, edge.ends[end]), 1);
      }
    }
    // Whatever moves has two edges of lines at its place in the source, and no border.
    std::map<Place, int> linesAt;
    for (const auto& [edge, parts] : ofSource) {
      const int counts = parts.size() == 2 ? (parts[0] != parts[1] ? 1 : 0) : 10;
      linesAt[edge.first] += counts;
      linesAt[edge.second] += counts;
    }
    for (std::size_t v = 0; v < lines.mayMove.size(); ++v)
      if (lines.mayMove[v] != 0) {
        ++moving;
        EXPECT_EQ(linesAt[placeOf(f.cut.positions[v])], 2);
      }
  }
  EXPECT_GT(moving, 100u);
}

/// A ball whose chart above a wave has its coordinates ten further; both are affine in the place.
SurfaceMesh wavyBall() {
  const TriangleMesh shape = shapes::globe(56, 28);
  SurfaceMesh mesh(shape);
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (const double chart : {0.0, 10.0})
    for (const Vec3& p : shape.positions) coords.append(std::array{chart + 0.2 * p.x * p.x, 0.5 * p.y + p.z});
  const auto count = static_cast<std::uint32_t>(shape.positions.size());
  for (const auto& t : shape.triangles) {
    const Vec3 middle = (shape.positions[t[0]] + shape.positions[t[1]] + shape.positions[t[2]]) / 3.0;
    const std::uint32_t first = middle.z > 0.3 * std::sin(4 * std::atan2(middle.y, middle.x)) ? count : 0;
    mesh.wedges.push_back({first + t[0], first + t[1], first + t[2]});
  }
  mesh.wedgeCount = 2 * count;
  mesh.wedgeAttributes = {coords};
  return mesh;
}

TEST(FitLines, MoveSeamsNearerToTheSourceWithBothSidesAtOnePlaceOfIt) {
  const CutOfMesh f = cutOfMesh(wavyBall(), 0.06);
  const FitLines lines = fitLines(f.cut, f.source);
  ASSERT_FALSE(lines.isEmpty());
  const auto held = fitSurface(f.cut.shape(), heldVertices(f.cut, false), f.source.shape());
  const auto fit = fitSurface(f.cut.shape(), heldBeside(f.cut, lines), f.source.shape(), {}, {}, lines);
  ASSERT_TRUE(held && fit);
  EXPECT_EQ(fit->rmsBefore, held->rmsBefore);
  EXPECT_LT(fit->rmsAfter, 0.95 * held->rmsAfter);
  EXPECT_LT(fit->lineAfter, fit->lineBefore);

  SurfaceMesh moved = f.cut;
  moved.positions = fit->positions;
  const auto rms = fitAttributes(moved, f.cut.positions, f.source);
  ASSERT_TRUE(rms);
  std::vector<std::set<std::uint32_t>> wedgesOf(moved.positions.size());
  for (std::size_t t = 0; t < moved.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) wedgesOf[moved.triangles[t][c]].insert(moved.wedges[t][c]);
  std::size_t onSeam = 0;
  for (std::size_t v = 0; v < wedgesOf.size(); ++v) {
    if (wedgesOf[v].size() != 2 || moved.positions[v] == f.cut.positions[v]) continue;
    ++onSeam;
    std::vector<double> one = moved.wedgeAttributes[0].numbers(*wedgesOf[v].begin()),
                        other = moved.wedgeAttributes[0].numbers(*wedgesOf[v].rbegin());
    EXPECT_NEAR(std::abs(one[0] - other[0]), 10, 1e-12);
    EXPECT_NEAR(one[1], other[1], 1e-12);
  }
  EXPECT_GT(onSeam, 10u);
}

// The shape of a plate is exact whatever lies on it.
TEST(FitLines, MoveOnAPlateThatIsExact) {
  SurfaceMesh mesh(shapes::sheet(30, 30));
  for (Vec3& p : mesh.positions) p.z = 0;
  mesh.materials = {{.name = "a"}, {.name = "b"}};
  for (const auto& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    mesh.materialOf.push_back(std::hypot(middle.x - 15, middle.y - 15) < 11 ? 1 : 0);
  }
  const CutOfMesh f = cutOfMesh(mesh, 0.02);
  const FitLines lines = fitLines(f.cut, f.source);
  ASSERT_FALSE(lines.isEmpty());
  const auto fit = fitSurface(f.cut.shape(), heldBeside(f.cut, lines), f.source.shape(), {}, {}, lines);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->rmsAfter, 1e-6);
  for (const Vec3& p : fit->positions) EXPECT_NEAR(p.z, 0, 1e-6);
  EXPECT_GT(fit->steps, 0);
  // The vertices of a ring that is inscribed lie outside of it, as on a ball.
  const auto radius = [&](const std::vector<Vec3>& positions) {
    double sum = 0;
    for (std::size_t v = 0; v < positions.size(); ++v)
      if (lines.mayMove[v] != 0) sum += std::hypot(positions[v].x - 15, positions[v].y - 15);
    return sum;
  };
  EXPECT_GT(radius(fit->positions), radius(f.cut.positions));
}

// Three materials that meet at a vertex, and lines that end at the border.
TEST(FitLines, LeaveWhatMeetsOrEndsToTheBit) {
  SurfaceMesh mesh(shapes::hills(24, 5));
  mesh.materials = {{.name = "a"}, {.name = "b"}, {.name = "c"}};
  for (const auto& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    const double turn = std::atan2(middle.y - 12, middle.x - 12) + 0.04 * middle.x;
    mesh.materialOf.push_back(turn < -1 ? 0 : turn < 1.2 ? 1 : 2);
  }
  const CutOfMesh f = cutOfMesh(mesh, 0.15);
  const FitLines lines = fitLines(f.cut, f.source);
  ASSERT_FALSE(lines.isEmpty());
  const auto fit = fitSurface(f.cut.shape(), heldBeside(f.cut, lines), f.source.shape(), {}, {}, lines);
  ASSERT_TRUE(fit);
  std::vector<std::set<std::uint32_t>> materials(f.cut.positions.size());
  std::set<std::uint32_t> onBorder;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (std::size_t t = 0; t < f.cut.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = f.cut.triangles[t][c], w = f.cut.triangles[t][(c + 1) % 3];
      materials[v].insert(f.cut.materialOf[t]);
      ++sides[std::minmax(v, w)];
    }
  for (const auto& [edge, count] : sides)
    if (count == 1) onBorder.insert({edge.first, edge.second});
  std::size_t ends = 0, moved = 0;
  for (std::uint32_t v = 0; v < materials.size(); ++v) {
    if (materials[v].size() < 2) continue;
    if (materials[v].size() == 3 || onBorder.contains(v)) {
      ++ends;
      EXPECT_EQ(fit->positions[v], f.cut.positions[v]);
    } else if (!(fit->positions[v] == f.cut.positions[v])) {
      ++moved;
    }
  }
  EXPECT_GE(ends, 4u);
  EXPECT_GT(moved, 5u);
}

TEST(LineSamples, StayOnTheirLineWhereAnotherIsNearer) {
  // Two lines of three vertices, of which the second lies where the first one's way was.
  const std::vector<Vec3> positions = {{0, 1, 0}, {5, 1, 0}, {10, 1, 0}, {0, 0, 0}, {5, 0, 0}, {10, 0, 0}};
  constexpr std::uint32_t kNone = MeshAttributes::kNone;
  FitLines lines;
  lines.edges = {{{0, 1}, {kNone, 1}, {{0, 0, 0}, {8, 0, 0}}},
                 {{1, 2}, {0, kNone}, {{8, 0, 0}, {10, 0, 0}}},
                 {{3, 4}, {kNone, 3}, {{0, 2, 0}, {5, 2, 0}}},
                 {{4, 5}, {2, kNone}, {{5, 2, 0}, {10, 2, 0}}}};
  LineSamples samples(lines, 0.1, [](const Vec3& p) { return p; });
  EXPECT_NEAR(double(samples.all().size()), 200, 1);
  const double sum = samples.assign(positions);
  EXPECT_NEAR(sum, 100 * 1.0 + 100 * 4.0, 5);
  EXPECT_NEAR(samples.largest(), 2, 1e-12);
  for (const LineSamples::Sample& s : samples.all()) {
    EXPECT_EQ(s.edge < 2, s.place.y == 0);
    // They go on along the line to the edge that they are beside.
    EXPECT_EQ(s.edge % 2 == 0, s.place.x <= 5) << s.place.x;
  }
}

}  // namespace
}  // namespace arete
