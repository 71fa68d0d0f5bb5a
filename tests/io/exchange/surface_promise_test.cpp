// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise of surfaces on real meshes: no point of the source is farther from a cut than its error, for
// uniform cuts and for random closed sets of nodes, plain and packed; held against measureDistance(), which
// shares no code with the build. ARETE_FULL=1 takes a thousand sets of meshes of less than 10 000 faces, and
// twenty of the others.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/cut/cut.h"
#include "full_run.h"
#include "io/exchange/mesh_formats.h"
#include "io/io_fixture.h"
#include "io/packed/surface/rounded_surface.h"
#include "surface/build/build.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"
#include "terrain/measure/mesh_distance.h"

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
    expectBound(model_, *cut, 0);
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

INSTANTIATE_TEST_SUITE_P(OfRealMeshes, SurfacePromise, ::testing::ValuesIn(kMeshes),
                         [](const auto& its) { return std::string(its.param.name); });

}  // namespace
}  // namespace arete
