// SPDX-License-Identifier: GPL-3.0-or-later
//
// Axes, grids and marks of orbits by their lines in space: where they lie, taken back to the file, and what
// their legends say.
#include "viewer/marks/space_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"
#include "viewer/marks/axes.h"
#include "viewer/marks/ground_grid.h"
#include "viewer/scene/terrain_subject.h"
#include "viewer/surface/surface_subject.h"

namespace arete {
namespace {

/// A box of corners at low and low + size, far from the origin if that is asked.
SurfaceModel boxFrom(const Vec3& low, const Vec3& size) {
  SurfaceMesh mesh(shapes::globe(24, 16));
  Box3 all = Box3::empty();
  for (const Vec3& p : mesh.positions) all.include(p);
  const Vec3 side = all.high - all.low;
  for (Vec3& p : mesh.positions)
    p = {low.x + (p.x - all.low.x) / side.x * size.x, low.y + (p.y - all.low.y) / side.y * size.y,
         low.z + (p.z - all.low.z) / side.z * size.z};
  return std::move(*buildSurface(std::move(mesh)));
}

TerrainModel ground() {
  RasterHeightfield field;
  field.columns = field.rows = 41;
  for (int i = 0; i < 41 * 41; ++i) field.heights.push_back(100 + float(i % 7));
  field.georeference.geoTransform = {409033, 30, 0, 3801477, 0, -30};
  field.georeference.hasGeoTransform = true;
  return std::move(*build(field));
}

/// The lines of a colour that are not letters: the longest is the axis.
std::pair<Vec3, Vec3> longestOf(const SpaceVertices& lines, std::size_t channel) {
  std::pair<Vec3, Vec3> longest{};
  for (std::size_t i = 0; i + 1 < lines.vertices.size(); i += 2) {
    const auto &a = lines.vertices[i], &b = lines.vertices[i + 1];
    const std::array<int, 3> ink{a.color.r, a.color.g, a.color.b};
    if (std::ranges::max_element(ink) - ink.begin() != std::ptrdiff_t(channel)) continue;
    if (norm(b.place - a.place) > norm(longest.second - longest.first)) longest = {a.place, b.place};
  }
  return longest;
}

TEST(Axes, RunAlongTheEdgesOfTheFilesBoxWhereverTheFileLiesAndHoweverItIsTurned) {
  const Vec3 size{4, 2, 1};
  for (const Vec3& low : {Vec3{-1, -1, -1}, Vec3{2'600'000, 1'200'000, 450}})
    for (const char* up : {"z", "y"})
      for (const Turn& turn : {Turn{}, Turn{30, 20, 10}}) {
        SCOPED_TRACE(testing::Message() << low.x << " " << up << " " << turn.heading);
        const SurfaceModel model = boxFrom(low, size);
        const auto form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model, up));
        const SurfaceSubject subject(form, turn);
        const MarkLines axes = axesOfFile(subject, Camera());
        const std::array<Vec3, 3> ends = {Vec3{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}};
        for (std::size_t a = 0; a < 3; ++a) {
          const auto [from, to] = longestOf(axes.lines, a);
          EXPECT_LT(norm(subject.inFile(from) - low), 1e-3) << a;
          EXPECT_LT(norm(subject.inFile(to) - (low + ends[a])), 1e-3) << a;
        }
        EXPECT_FALSE(axes.lines.isAlwaysSeen) << "models hide them";
      }
}

TEST(Axes, HaveTheNumbersAtTheirEndsAndTheDistanceOfTheirTicksInTheLegend) {
  const SurfaceModel model = boxFrom({-1, 10, 0}, {4, 2, 1});
  const SurfaceSubject subject(model, ZUpFrame(model));
  const auto entries = axesOfFile(subject, Camera()).legend.entries;
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].label, "X -1 to 3, ticks 0.5 apart");
  EXPECT_EQ(entries[1].label.substr(0, 10), "Y 10 to 12");
  EXPECT_EQ(entries[2].label.substr(0, 8), "Z 0 to 1");
  EXPECT_GT(entries[0].color.r, 150);
  EXPECT_GT(entries[1].color.g, entries[1].color.r);
  EXPECT_GT(entries[2].color.b, 150);
}

TEST(Axes, OfATerrainAreThoseOfItsMap) {
  const TerrainModel model = ground();
  const TerrainSubject subject(model);
  const MarkLines axes = axesOfFile(subject, Camera());
  const Box3 box = subject.fileBox();
  EXPECT_NEAR(box.low.x, 409048, 1e-6);  // the middle of the first column
  EXPECT_NEAR(box.high.y, 3801462, 1e-6);
  const auto [from, to] = longestOf(axes.lines, 1);
  EXPECT_NEAR(subject.inFile(to).y - subject.inFile(from).y, 1200, 1e-6);
  EXPECT_NEAR(subject.inFile(to).x, box.low.x, 1e-6);
}

TEST(Axes, OfAFlatSurfaceAreFiniteAllTheSame) {
  const SurfaceModel model = std::move(*buildSurface(SurfaceMesh(shapes::sheet(5, 5))));
  const SurfaceSubject subject(model, ZUpFrame(model));
  for (const auto& v : axesOfFile(subject, Camera()).lines.vertices)
    EXPECT_TRUE(std::isfinite(v.place.x + v.place.y + v.place.z));
  for (const auto& v : groundGrid(subject).lines.vertices)
    EXPECT_TRUE(std::isfinite(v.place.x + v.place.y + v.place.z));
}

/// How far a coordinate is from a multiple of a step, in steps.
double offMultiple(double coordinate, double step) {
  return std::abs(coordinate / step - std::round(coordinate / step));
}

TEST(GroundGrid, LiesAtRoundCoordinatesOfTheMapBelowTheTerrainAndAroundIt) {
  const TerrainModel model = ground();
  const TerrainSubject subject(model);
  const MarkLines grid = groundGrid(subject);
  EXPECT_EQ(grid.legend.entries.at(0).label, "squares of 100");
  Box3 all = Box3::empty();
  for (std::size_t i = 0; i < grid.lines.vertices.size(); i += 2) {
    const Vec3 a = subject.inFile(grid.lines.vertices[i].place),
               b = subject.inFile(grid.lines.vertices[i + 1].place);
    all.include(a);
    EXPECT_LT(a.z, 100);
    EXPECT_TRUE((offMultiple(a.x, 100) < 1e-6 && std::abs(a.x - b.x) < 1e-6) ||
                (offMultiple(a.y, 100) < 1e-6 && std::abs(a.y - b.y) < 1e-6))
        << a.x << " " << a.y;
  }
  EXPECT_NEAR(all.low.x, 409000, 1e-6);
  EXPECT_LE(all.low.y, subject.fileBox().low.y);
}

TEST(GroundGrid, IsLevelAndOfTheFilesNumbersUnlessTheSurfaceIsTurned) {
  const Vec3 low{1000.3, 0.2, 7.7};
  const SurfaceModel model = boxFrom(low, {4, 2, 3});
  for (const char* up : {"z", "y"}) {
    const SurfaceSubject subject(model, ZUpFrame(model, up));
    const MarkLines grid = groundGrid(subject);
    std::set<double> heights;
    for (std::size_t i = 0; i < grid.lines.vertices.size(); i += 2) {
      heights.insert(std::round(grid.lines.vertices[i].place.z * 1e9));
      const Vec3 a = subject.inFile(grid.lines.vertices[i].place);
      const double second = up[0] == 'z' ? a.y : a.z;
      EXPECT_TRUE(offMultiple(a.x, 0.5) < 1e-3 || offMultiple(second, 0.5) < 1e-3) << a.x << " " << second;
    }
    EXPECT_EQ(heights.size(), 1u);
  }
  // With its front raised no two of its axes are level: the numbers are the space's.
  const auto form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model));
  const SurfaceSubject turned(form, Turn{0, 30, 0});
  for (const auto& v : groundGrid(turned).lines.vertices) {
    EXPECT_LT(v.place.z, turned.box().low.z);
    EXPECT_GT(v.place.z, turned.box().low.z - 0.01 * turned.box().diagonal());
  }
}

TEST(SpaceMarks, AreLaidAndTakenAwayEachByItselfAndKeepWhatTheUserSet) {
  const SurfaceModel model = boxFrom({0, 0, 0}, {4, 2, 1});
  const SurfaceSubject subject(model, ZUpFrame(model));
  Layers layers;
  const auto lay = [&](const SpaceMarks& marks, bool hasOrbit) {
    laySpaceMarks(layers, marks, subject, Camera(),
                  hasOrbit ? std::optional(OrbitPlace{{1, 2, 3}, 10}) : std::nullopt);
  };
  lay({.axes = true, .grid = true, .orbit = true}, true);
  ASSERT_EQ(layers.list().size(), 3u);
  layers.find(SpaceMarks::kGrid)->opacity = 0.25;
  lay({.grid = true, .orbit = true}, false);
  ASSERT_EQ(layers.list().size(), 1u) << "free flight turns about nothing";
  EXPECT_EQ(layers.find(SpaceMarks::kGrid)->opacity, 0.25);
  lay({}, true);
  EXPECT_TRUE(layers.list().empty());
}

TEST(SpaceMarks, LeaveALayerOfTheUserWithTheSameNameAlone) {
  const SurfaceModel model = boxFrom({0, 0, 0}, {4, 2, 1});
  const SurfaceSubject subject(model, ZUpFrame(model));
  Layers layers;
  layers.put(SpaceMarks::kAxes, Contours{5});
  laySpaceMarks(layers, {.axes = true}, subject, Camera(), std::nullopt);
  ASSERT_EQ(layers.list().size(), 2u);
  EXPECT_TRUE(std::holds_alternative<Contours>(layers.find(SpaceMarks::kAxes)->content));
  laySpaceMarks(layers, {}, subject, Camera(), std::nullopt);
  EXPECT_EQ(layers.list().size(), 1u);
}

TEST(OrbitMark, IsAboutTheCentreAndAsLargeAsTheCameraIsFar) {
  const SpaceVertices mark = orbitMark({{10, 20, 30}, 100});
  Box3 all = Box3::empty();
  for (const auto& v : mark.vertices) all.include(v.place);
  EXPECT_NEAR((all.low.x + all.high.x) / 2, 10, 1e-9);
  EXPECT_NEAR((all.low.z + all.high.z) / 2, 30, 1e-9);
  EXPECT_NEAR(all.high.z - all.low.z, 14, 1e-9);
  EXPECT_FALSE(mark.isAlwaysSeen);
}

}  // namespace
}  // namespace arete
