// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise of surfaces on real meshes: no point of the source is farther from a cut than its error, for
// uniform cuts and for random closed sets of nodes, plain and packed, and displaced; held against
// measureDistance(), which shares no code with the build. ARETE_FULL=1 takes a thousand sets of meshes of
// less than 10 000 faces, and twenty of the others; ARETE_BRIEF=1 takes the former meshes alone.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/criteria/refine_order.h"
#include "engine/criteria/space_region.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/io_fixture.h"
#include "io/store/packed/surface/rounded_surface.h"
#include "measure/mesh_distance.h"
#include "surface/builder/build.h"
#include "surface/displacement/displaced_places.h"
#include "surface/displacement/find_displacement.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"

namespace arete {
namespace {

struct RealMesh {
  const char* name;
  const char* path;  ///< below the data folder
  int setsOfFull;
};

const RealMesh kMeshes[] = {{"fuze", "meshes/fuze.obj", 250},
                            {"spot", "meshes/spot.obj", 250},
                            {"featuretype", "meshes/featuretype.STL", 250},
                            {"pirate", "meshes/pirate.obj", 250},
                            {"bunny", "meshes/bunny.ply", 20},
                            {"horse", "meshes/horse.ply", 20}};

class SurfacePromise : public ::testing::TestWithParam<RealMesh> {
 protected:
  void SetUp() override {
    const std::string path = test::realData(GetParam().path);
    if (path.empty()) GTEST_SKIP() << "the real data is not there";
    const Result<MeshFile> file = readMesh(path);
    ASSERT_TRUE(file) << file.error().message;
    if (test::isBrief() && file->mesh.triangles.size() > 10'000)
      GTEST_SKIP() << "a mesh of more than 10 000 faces is tried without sanitizers";
    source_ = file->mesh.shape();
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(source_));
    ASSERT_TRUE(model) << model.error().message;
    model_ = *model;
  }

  /// That the cut of a model keeps its error against the source.
  /// @param samples  0: as many as measureDistance() takes by itself. Only then its search has queries enough
  /// to end
  ///                 within a thousandth, and the distance that is certain is compared too.
  void expectBound(const SurfaceModel& model, const Cut& cut, std::uint64_t samples) const {
    const SurfaceFront front = surfaceOf(model, cut);
    const auto apart = measureDistance(front.mesh.shape(), source_, {.samples = samples});
    ASSERT_TRUE(apart) << apart.error().message;
    const double rounding = 16 * std::ldexp(apart->largestCoordinate, -52);
    EXPECT_LE(apart->backward.maximum, cut.achievedError + rounding);
    if (samples == 0) {
      EXPECT_LE(apart->backward.atMost,
                cut.achievedError + rounding + std::max(cut.achievedError / 1000, 1e-5 * model.diagonal));
    }
  }

  TriangleMesh source_;
  SurfaceModel model_;
};

TEST_P(SurfacePromise, HoldsInUniformCuts) {
  const std::vector<double> shares = test::isFull() ? std::vector{0.05, 0.3, 2.0} : std::vector{0.3};
  for (const double share : shares) {
    const Result<Cut> cut = takeCut(model_.mt, UniformError(share / 100 * model_.diagonal));
    ASSERT_TRUE(cut);
    expectBound(model_, *cut, test::isBrief() ? 50'000 : 0);
  }
}

TEST_P(SurfacePromise, HoldsInRandomClosedNodeSets) {
  const MultiTriangulation& mt = model_.mt;
  const Result<SurfaceTopology> topology = SurfaceTopology::of(mt);
  ASSERT_TRUE(topology);
  const int sets = test::isFull() ? GetParam().setsOfFull : 3;
  std::mt19937_64 random(GetParam().path[7]);
  for (int i = 0; i < sets && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    NodeSet set(mt.nodeCount(), 0);
    // From a few nodes to a quarter of them, about as often in each octave.
    const double octave = std::log2(mt.nodeCount() / 4.0 + 2) * double(random() % 1000) / 999;
    for (auto some = static_cast<std::uint64_t>(std::exp2(octave)); some > 0; --some)
      set[random() % mt.nodeCount()] = 1;
    closeUpwards(mt, set);
    const Cut cut = front(mt, set);
    const Status valid = topology->check(cut);
    EXPECT_TRUE(valid) << valid.error().message;
    expectBound(model_, cut, 50'000);
  }
}

TEST_P(SurfacePromise, HoldsForTheSourceWhereVerticesAreRounded) {
  const auto rounded = packed::roundedSurface(model_.mt, 10);
  ASSERT_TRUE(rounded);
  SurfaceModel model = model_;
  model.mt = rounded->mt;
  for (const std::uint32_t nodes : {0u, model.mt.nodeCount() / 20, model.mt.nodeCount()})
    expectBound(model, frontOfPrefix(model.mt, nodes), 50'000);
}

TEST_P(SurfacePromise, HoldsDisplacedInEveryKindOfCut) {
  const Result<SurfaceDisplacement> displacement = findDisplacement(model_);
  ASSERT_TRUE(displacement);
  const MultiTriangulation& mt = model_.mt;
  const MetricFrame& metric = mt.arrays().metric;
  const int tolerances = test::isFull() ? 10 : 1;
  const auto expectDisplaced = [&](const Cut& cut, const BoundedCriterion& criterion) {
    SurfaceFront front = surfaceOf(model_, cut);
    front.mesh.positions = displacedPlaces(mt, *displacement, cut, promisedErrors(mt, cut, &criterion));
    const auto apart = measureDistance(front.mesh.shape(), source_, {.samples = 50'000});
    ASSERT_TRUE(apart);
    EXPECT_LE(apart->backward.maximum,
              cut.achievedError + 16 * std::ldexp(apart->largestCoordinate, -52) + 1e-9 * model_.diagonal);
  };
  Vec3 middle = mt.position(VertexId(mt.vertexCount() / 2));
  for (int i = 0; i < tolerances; ++i) {
    SCOPED_TRACE(i);
    const double error = model_.diagonal * 0.02 * std::exp2(-i), side = model_.diagonal / 5;
    const UniformError uniform(error);
    expectDisplaced(*takeCut(mt, uniform), uniform);

    CutOptions budget;
    budget.maxTriangles = mt.rootTriangleCount() + (mt.finestTriangleCount() / 20 >> i);
    budget.order = std::make_shared<LargestSquaresFirst>();
    const UniformError none(0);
    expectDisplaced(*takeCut(mt, none, budget), none);

    const auto box =
        std::make_shared<BoxRegion>(middle - Vec3{side, side, side}, middle + Vec3{side, side, side});
    const SpaceRegionError region(box, metric, error, 4 * error);
    expectDisplaced(*takeCut(mt, region), region);

    View view;
    view.eye = metric.toMetric(middle + Vec3{0, 0, model_.diagonal * (i + 1) / 5});
    view.forward = {0, 0, -1};
    view.up = {0, 1, 0};
    const ViewError camera({.view = view, .pixels = 3, .outsideError = model_.diagonal / 20}, metric);
    expectDisplaced(*takeCut(mt, camera), camera);
  }
}

INSTANTIATE_TEST_SUITE_P(OfRealMeshes, SurfacePromise, ::testing::ValuesIn(kMeshes),
                         [](const auto& its) { return std::string(its.param.name); });

}  // namespace
}  // namespace arete
