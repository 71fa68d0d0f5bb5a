// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/index_check.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;

/// The arrays of the tiny model (tests/io/amt_fixture.h), to be changed.
struct Changeable {
  TerrainModel model = test::tinyModel();
  std::vector<std::array<std::uint32_t, 3>> rootTriangles;
  std::vector<std::uint32_t> slotBegin, link, remover, floor, hint, samples;
  std::vector<std::uint16_t> saturated, blockError;
  std::vector<Sphere> sphere, blockSphere;

  Changeable() {
    const MtArrays& a = model.mt.arrays();
    rootTriangles.assign(a.rootTriangles.begin(), a.rootTriangles.end());
    slotBegin.assign(a.slotBegin.begin(), a.slotBegin.end());
    link.assign(a.link.begin(), a.link.end());
    remover.assign(a.remover.begin(), a.remover.end());
    floor.assign(a.floor.begin(), a.floor.end());
    hint.assign(a.creatorHint.begin(), a.creatorHint.end());
    samples.assign(a.vertices.samples.begin(), a.vertices.samples.end());
    saturated.assign(a.saturatedError.begin(), a.saturatedError.end());
    sphere.assign(a.sphere.begin(), a.sphere.end());
    blockError.assign(a.blockError.begin(), a.blockError.end());
    blockSphere.assign(a.blockSphere.begin(), a.blockSphere.end());
  }
  MultiTriangulation mt() const {
    MtArrays a = model.mt.arrays();
    a.rootTriangles = rootTriangles;
    a.slotBegin = slotBegin;
    a.link = link;
    a.remover = remover;
    a.floor = floor;
    a.creatorHint = hint;
    a.vertices.samples = samples;
    a.saturatedError = saturated;
    a.sphere = sphere;
    a.blockError = blockError;
    a.blockSphere = blockSphere;
    return {a, nullptr};
  }
};

TEST(IndexCheck, PassesWhatABuildMakes) {
  EXPECT_TRUE(checkMtIndices(test::tinyModel().mt, 9));
  for (const RasterFamily& family : rasterFamilies()) {
    const TerrainModel model = built(build(family.make(60, 50, 3)));
    const Status sound = checkMtIndices(model.mt, std::uint64_t{model.columns} * model.rows);
    EXPECT_TRUE(sound) << family.name << ": " << sound.error().describe();
  }
  for (const PointFamily& family : pointFamilies())
    EXPECT_TRUE(checkMtIndices(built(build(family.make(800, 3))).mt, 0)) << family.name;
}

TEST(IndexCheck, NamesTheChunkAndTheFirstCulprit) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::pair<const char*, std::function<void(Changeable&)>> changes[] = {
      {"chunk SLOT: the first slot is not 0", [](Changeable& c) { c.slotBegin[0] = 1; }},
      {"chunk SLOT: node 0 has the slots 0 to 2", [](Changeable& c) { c.slotBegin[1] = 2; }},
      {"chunk SLOT: the last node ends at slot 8", [](Changeable& c) { c.slotBegin[2] = 8; }},
      {"chunk RTRI: triangle 1", [](Changeable& c) { c.rootTriangles[1][2] = 4; }},
      {"chunk LINK: slot 2 names vertex 4", [](Changeable& c) { c.link[2] = 4; }},
      {"chunk LINK: slot 4 names vertex 3", [](Changeable& c) { c.link[4] = 3; }},
      {"chunk HINT: entry 0", [](Changeable& c) { c.hint[0] = 1; }},
      {"chunk RMVR: triangle 0 is removed by node 2", [](Changeable& c) { c.remover[0] = 2; }},
      {"chunk RMVR: triangle 6, of node 1", [](Changeable& c) { c.remover[6] = 0; }},
      {"chunk RMVR: 4 triangles are removed", [](Changeable& c) { c.remover[3] = 1; }},
      {"chunk FLOR: node 0 lists triangle 0", [](Changeable& c) { c.floor[1] = 0; }},
      {"chunk FLOR: node 1 lists triangle 3", [](Changeable& c) { c.floor[2] = 3; }},
      {"chunk SERR: node 0 has a smaller error", [](Changeable& c) { c.saturated[0] = c.saturated[1] - 1; }},
      {"chunk SPHR: node 1", [](Changeable& c) { c.sphere[1].radius = kNan; }},
      {"chunk SPHR: the sphere of node 0 does not hold", [](Changeable& c) { c.sphere[0].radius = 20; }},
      {"chunk BSPH: block 0", [](Changeable& c) { c.blockSphere[0].x = kNan; }},
      {"chunk BSPH: the sphere of block 1", [](Changeable& c) { c.blockSphere[1].radius = 1; }},
      {"chunk SAMP: vertex 5 is sample 9 of 9", [](Changeable& c) { c.samples[5] = 9; }},
  };
  for (const auto& [sentence, change] : changes) {
    Changeable arrays;
    change(arrays);
    const Status status = checkMtIndices(arrays.mt(), 9);
    ASSERT_FALSE(status) << sentence;
    EXPECT_EQ(status.error().code, ErrorCode::corrupt);
    EXPECT_EQ(status.error().message.rfind(sentence, 0), 0u)
        << status.error().message << "\nexpected " << sentence;
  }
}

TEST(IndexCheck, NamesTheSameCulpritForAnyNumberOfThreads) {
  const TerrainModel model = built(build(test::hills(300, 250, [](double z) { return std::round(z); })));
  MtArrays a = model.mt.arrays();
  std::vector<std::uint32_t> link(a.link.begin(), a.link.end());
  for (std::size_t s = link.size() / 3; s < link.size(); s += 1000) link[s] = 0xFFFFFFF0;
  a.link = link;
  const MultiTriangulation broken(a, nullptr);
  std::string first;
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    const Status status = checkMtIndices(broken, 300 * 250, context);
    ASSERT_FALSE(status);
    if (first.empty()) first = status.error().message;
    EXPECT_EQ(status.error().message, first);
  }
}

TEST(IndexCheck, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_EQ(checkMtIndices(test::tinyModel().mt, 9, context).error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
