// SPDX-License-Identifier: GPL-3.0-or-later
//
// A copy that gets the changes alone is held against the cut and the law of geomorphs, taken anew.
#include "viewer/fronts/morphing_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/criteria/view_error.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/fronts/cut_worker.h"

namespace arete {
namespace {

/// What graphics memory has after all changes.
struct Copy {
  std::vector<FrontChanges::Corners> corners;
  std::vector<FrontChanges::Range> ranges;
  FrontChanges::Own own;

  void apply(const FrontChanges& changes) {
    if (changes.newSize) corners.assign(*changes.newSize, {});
    std::size_t at = 0;
    for (const FrontChanges::Run& run : changes.runs)
      for (std::uint32_t i = 0; i < run.count; ++i) corners.at(run.first + i) = changes.corners.at(at++);
    if (changes.ranges) ranges = *changes.ranges;
    if (changes.own) own = *changes.own;
  }
  using Place = std::array<float, 3>;
  /// The drawn triangles, each from its least corner, sorted.
  std::vector<std::array<Place, 3>> triangles(const DrawnVertices& drawn) const {
    std::vector<std::array<Place, 3>> all;
    const auto add = [&](std::array<Place, 3> t) {
      std::ranges::rotate(t, std::ranges::min_element(t));
      all.push_back(t);
    };
    for (const FrontChanges::Range& r : ranges)
      for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
        std::array<Place, 3> t;
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k < 3; ++k) t[c][k] = drawn.positions.at(3 * corners[i][c] + k);
        add(t);
      }
    for (const FrontChanges::Range& r : own.ranges)
      for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
        std::array<Place, 3> t;
        for (std::size_t c = 0; c < 3; ++c) t[c] = own.vertices.at(own.corners[i][c]).position;
        add(t);
      }
    std::ranges::sort(all);
    return all;
  }
};

View viewOf(double diagonal, int frame) {
  const double turn = 0.02 * frame, distance = diagonal * (0.9 + 0.5 * std::sin(0.07 * frame));
  View view;
  view.eye = {distance * std::cos(turn), distance * std::sin(turn), 0.3 * distance};
  view.forward = -view.eye;
  view.widthPixels = 320;
  view.heightPixels = 200;
  return view;
}

/// Three materials, the last of which lets light through.
SurfaceModel threeMaterials() {
  SurfaceMesh mesh(shapes::shaken(shapes::globe(40, 30), 5, 0.02));
  mesh.materials = {Material{.name = "red"}, Material{.name = "green"}, Material{.name = "glass"}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.materialOf.push_back(static_cast<std::uint32_t>(t * 3 / mesh.triangles.size()));
  return *buildSurface(mesh);
}

TEST(MorphingFront, ACopyThatGetsOnlyTheChangesHasEveryTriangleWhereTheLawPutsIt) {
  const SurfaceModel model = threeMaterials();
  const ZUpFrame upright(model);
  const auto drawn = std::make_shared<const DrawnVertices>(drawnVertices(model, upright));
  MorphingFront front(model, upright, drawn, {false, false, true, false});
  Copy copy;
  IncrementalCut cut(model.mt);
  GeomorphedSurface moved(model.mt);
  std::uint32_t moving = 0;
  for (int frame = 0; frame < 60; ++frame) {
    SCOPED_TRACE(frame);
    MorphingFront::Asked asked;
    asked.view = viewOf(model.diagonal, frame);
    asked.pixels = frame % 30 < 15 ? 1 : 4;
    asked.moves = frame % 20 != 19;
    ASSERT_TRUE(front.update(asked));
    // Changes of some updates are taken together.
    const MorphCamera camera({.view = asked.view, .pixels = asked.pixels, .moves = asked.moves},
                             model.mt.metric());
    ASSERT_TRUE(
        cut.update(ViewError({.view = asked.view, .pixels = camera.tolerance().cut}, model.mt.metric())));
    moved.update(camera, cut);
    if (frame % 3 == 1) continue;
    const auto taken = front.take();
    ASSERT_TRUE(taken);
    copy.apply(taken->changes);
    EXPECT_EQ(taken->figures.triangles, cut.triangles().size());
    EXPECT_EQ(taken->figures.moving, moved.moving().size());
    moving += taken->figures.moving;
    std::vector<std::array<Copy::Place, 3>> expected;
    for (const std::uint32_t t : cut.triangles()) {
      std::array<Copy::Place, 3> corners;
      const auto ids = model.mt.corners(TriangleId(t));
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 offset = upright.turned(moved.offset(VertexId(ids[c])).vector());
        const float* const p = &drawn->positions[3 * ids[c]];
        corners[c] = {float(p[0] + offset.x), float(p[1] + offset.y), float(p[2] + offset.z)};
      }
      std::ranges::rotate(corners, std::ranges::min_element(corners));
      expected.push_back(corners);
    }
    std::ranges::sort(expected);
    EXPECT_EQ(copy.triangles(*drawn), expected);
  }
  EXPECT_GT(moving, 1000u);
}

TEST(MorphingFront, AtRestThereIsNothingToSend) {
  const SurfaceModel model = threeMaterials();
  const ZUpFrame upright(model);
  const auto drawn = std::make_shared<const DrawnVertices>(drawnVertices(model, upright));
  MorphingFront front(model, upright, drawn, {false, false, true, false});
  MorphingFront::Asked asked;
  asked.view = viewOf(model.diagonal, 7);
  ASSERT_TRUE(front.update(asked));
  const auto first = front.take();
  ASSERT_TRUE(first && first->changes.newSize && first->changes.own);
  ASSERT_TRUE(front.update(asked));
  const auto again = front.take();
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->changes.runs.empty());
  EXPECT_FALSE(again->changes.newSize || again->changes.own);
  EXPECT_EQ(again->figures.triangles, first->figures.triangles);
}

/// Where a place of the sheet is in the picture of its chart: a map that is affine.
std::array<double, 2> inPicture(const Vec3& p, bool isRight) {
  return isRight ? std::array{10 + 0.02 * p.x - 0.03 * p.z, 5 + 0.05 * p.y + 0.01 * p.z}
                 : std::array{0.03 * p.x + 0.01 * p.y, 0.04 * p.y + 0.02 * p.z};
}

// Coordinates that are affine in the place stay so on the way, the clamp included. Beside a seam the floor
// triangle nearest to a vertex may be on the other side: such a vertex has coordinates of its own side.
TEST(MorphingFront, CoordinatesOfAPictureMoveWithThePlaceOnTheirSideOfASeam) {
  SurfaceMesh mesh(shapes::hills(30, 3));
  std::vector<std::array<std::uint32_t, 3>> wedges;
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (const bool isRight : {false, true})
    for (const Vec3& p : mesh.positions) coords.append(inPicture(p, isRight));
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const double x = (mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x) / 3;
    wedges.push_back(t);
    if (x > 15)
      for (std::uint32_t& w : wedges.back()) w += vertices;
  }
  mesh.wedgeCount = 2 * vertices;
  mesh.wedges = wedges;
  mesh.wedgeAttributes = {coords};
  const Result<SurfaceModel> built = buildSurface(mesh);
  ASSERT_TRUE(built) << built.error().describe();
  const SurfaceModel& model = *built;
  ASSERT_TRUE(model.hasWedges());
  const ZUpFrame upright(model);
  const auto drawn = std::make_shared<const DrawnVertices>(drawnVertices(model, upright));
  MorphingFront front(model, upright, drawn, {false});
  std::size_t checked = 0, off = 0;
  for (int frame = 0; frame < 40; ++frame) {
    MorphingFront::Asked asked;
    asked.view = viewOf(model.diagonal, frame);
    asked.pixels = 6;
    ASSERT_TRUE(front.update(asked));
    const auto taken = front.take();
    ASSERT_TRUE(taken);
    if (!taken->changes.own) continue;
    for (const OwnVertex& v : taken->changes.own->vertices) {
      const Vec3 place = upright.toFile({v.position[0], v.position[1], v.position[2]});
      const bool isRight = v.textureCoords[0] > 8;
      const auto expected = inPicture(place, isRight);
      const double apart = std::hypot(v.textureCoords[0] - expected[0], 1 - v.textureCoords[1] - expected[1]);
      ++checked;
      off += apart > 1e-4 ? 1 : 0;
      EXPECT_LT(apart, 0.05) << "of " << expected[0] << " " << expected[1];
    }
  }
  EXPECT_GT(checked, 1000u);
  EXPECT_LT(off, checked / 50);
}

TEST(CutWorker, DoesTheLastJobOfEachOwnerAndNoneAfterAStop) {
  CutWorker worker;
  std::array<int, 50> owners{}, last{};
  for (int round = 1; round <= 100; ++round)
    for (std::size_t o = 0; o < owners.size(); ++o)
      worker.post(&owners[o], [&last, o, round] { last[o] = round; });
  for (std::size_t o = 0; o < owners.size(); ++o) {
    if (o % 2 == 0) continue;
    worker.stop(&owners[o]);
    const int done = last[o];
    EXPECT_LE(done, 100);
    last[o] = -1;
    EXPECT_EQ(last[o], -1);
  }
  // One job behind all others.
  std::mutex mutex;
  std::condition_variable condition;
  bool isDone = false;
  worker.post(&worker, [&] {
    const std::lock_guard lock(mutex);
    isDone = true;
    condition.notify_all();
  });
  std::unique_lock lock(mutex);
  condition.wait(lock, [&] { return isDone; });
  for (std::size_t o = 0; o < owners.size(); ++o) EXPECT_EQ(last[o], o % 2 == 0 ? 100 : -1);
}

}  // namespace
}  // namespace arete
