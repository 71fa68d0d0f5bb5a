// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models that stay open, against what went wrong in other programs that read files in part: an error of one
// read that every later one gets too, a question that is stopped and ends those of other threads, data of a
// file that was replaced meanwhile beside those of the file before, and parts that lack what lies at their
// rims.
#include "io/query/parts/open_terrain.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "datasets/families.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/http_server.h"
#include "io/io_fixture.h"
#include "io/query/parts/asked_places.h"
#include "io/query/parts/parts_fixture.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

using test::got;
using test::HttpFault;
using test::HttpServer;
using test::TemporaryFolder;

/// One file of mountains in pages, its bytes, and all of its model.
struct Mountains {
  Mountains() {
    const auto& families = rasterFamilies();
    const auto fractal = std::ranges::find(families, std::string_view("fractal"), &RasterFamily::name);
    path = folder.file("mountains.amt");
    EXPECT_TRUE(writeAmt(path, got(build(fractal->make(420, 380, 5))), {}, {.isPaged = true}));
    std::ifstream file(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    whole = std::make_unique<LocatedTerrain>(got(loadAmt(path)));
  }
  TemporaryFolder folder;
  std::string path, bytes;
  std::unique_ptr<LocatedTerrain> whole;
};

const Mountains& mountains() {
  static const Mountains one;
  return one;
}

class OpenTerrainTest : public ::testing::Test {
 protected:
  void SetUp() override {
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "1");
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", "0.01");
  }
  void TearDown() override {
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", nullptr);
  }
  static std::shared_ptr<OpenTerrain> opened(const std::string& path) {
    return got(OpenTerrain::open(got(LastingFile::open(path))));
  }
  static Result<std::optional<GroundHeight>> heightAt(const OpenTerrain& terrain, Vec2 place,
                                                      const RunContext& context = {}) {
    const Vec2 plan = terrain.outline().toPlan(place);
    ARETE_TRY(const auto part, terrain.at(wantedAt({&plan, 1}, terrain.outline()), context));
    return part->heights.at(place);
  }
  static void expectHeight(const OpenTerrain& terrain, Vec2 place) {
    const auto mine = heightAt(terrain, place);
    const auto its = mountains().whole->heights.at(place);
    ASSERT_TRUE(mine) << mine.error().describe();
    ASSERT_EQ(mine->has_value(), its.has_value());
    if (its) {
      EXPECT_EQ((*mine)->height, its->height);
    }
  }
  static Vec2 placeOf(unsigned seed) {
    std::mt19937 random(seed);
    const TerrainModel& model = mountains().whole->model;
    return model.toSource({std::uniform_real_distribution(0.0, model.columns - 1.0)(random),
                           std::uniform_real_distribution(0.0, model.rows - 1.0)(random)});
  }
};

TEST_F(OpenTerrainTest, SaysOfTheWholeWhatTheWholeIs) {
  const auto terrain = opened(mountains().path);
  const TerrainModel& whole = mountains().whole->model;
  EXPECT_TRUE(terrain->isInParts());
  EXPECT_LT(terrain->outline().mt.nodeCount(), whole.mt.nodeCount() / 50);
  EXPECT_EQ(terrain->vertexCount(), whole.mt.vertexCount());
  EXPECT_EQ(terrain->triangleCount(), whole.mt.triangleCount());
  EXPECT_EQ(terrain->finestTriangleCount(), whole.mt.finestTriangleCount());
  EXPECT_EQ(terrain->relief(), reliefOf(whole));
  EXPECT_EQ(got(terrain->largestError()), whole.mt.largestError());
  const auto curve = terrain->statedCurve(5);
  ASSERT_TRUE(curve);
  const auto computed = got(errorCurve(whole.mt, toleranceLadder(whole.mt, 5)));
  ASSERT_EQ(curve->size(), computed.size());
  for (std::size_t i = 0; i < computed.size(); ++i) {
    EXPECT_EQ((*curve)[i].maxError, computed[i].maxError);
    EXPECT_EQ((*curve)[i].minimalTriangles, computed[i].minimalTriangles);
    EXPECT_EQ((*curve)[i].saturatedTriangles, computed[i].saturatedTriangles);
  }
}

TEST_F(OpenTerrainTest, AnswersAPlaceAsTheWholeDoesFromPartsThatAreKept) {
  const HttpServer server({{"m.amt", mountains().bytes}}, {});
  const auto local = opened(mountains().path), far = opened(server.address("m.amt"));
  for (unsigned seed = 1; seed <= 40; ++seed) {
    expectHeight(*local, placeOf(seed));
    expectHeight(*far, placeOf(seed));
  }
  const Vec2 plan = local->outline().toPlan(placeOf(40));
  const RequiredError wanted = wantedAt({&plan, 1}, local->outline());
  EXPECT_EQ(got(local->at(wanted)), got(local->at(wanted))) << "it is read once";
  EXPECT_EQ(got(far->at(wanted)), got(far->at(wanted)));
  EXPECT_LT(got(far->at(wanted))->model.mt.nodeCount(), mountains().whole->model.mt.nodeCount());
}

TEST_F(OpenTerrainTest, ReadsTheWholeOnceForAllThreadsThatAskForIt) {
  const auto terrain = opened(mountains().path);
  std::array<OpenTerrain::Located, 4> all;
  std::vector<std::thread> threads;
  for (auto& one : all) threads.emplace_back([&] { one = got(terrain->whole()); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& one : all) EXPECT_EQ(one, all[0]);
  EXPECT_EQ(all[0]->model.mt.nodeCount(), mountains().whole->model.mt.nodeCount());
  ExtractRequest request;
  request.criterion.maxError = 3;
  EXPECT_EQ(got(terrain->forRequest(request)).model.get(), &all[0]->model) << "and keeps it";
}

TEST_F(OpenTerrainTest, TakesTheCutsOfTheWholeOfItsParts) {
  const TerrainModel& whole = mountains().whole->model;
  for (const double error : {40.0, 8.0, 0.0}) {
    const auto terrain = opened(mountains().path);
    ExtractRequest request;
    request.criterion.maxError = error;
    const auto taken = got(terrain->forRequest(request));
    const Cut mine = got(takeCut(taken.model->mt, UniformError(error))),
              its = got(takeCut(whole.mt, UniformError(error)));
    EXPECT_EQ(mine.triangles, its.triangles);
    EXPECT_TRUE(mine.missing.empty());
    if (error > 8) {
      EXPECT_LT(taken.model->mt.nodeCount(), whole.mt.nodeCount() / 4);
    }
  }
}

TEST_F(OpenTerrainTest, AServerThatFailedIsAskedAgainByTheNextQuestion) {
  std::atomic<bool> isDown = false;
  const HttpServer server({{"m.amt", mountains().bytes}}, [&](const std::string&, int) {
    HttpFault fault;
    if (isDown) fault.status = 503;
    return fault;
  });
  const auto terrain = opened(server.address("m.amt"));
  isDown = true;
  for (int i = 0; i < 2; ++i) {
    const auto height = heightAt(*terrain, placeOf(3));
    ASSERT_FALSE(height);
    EXPECT_EQ(height.error().code, ErrorCode::unreadable);
    EXPECT_NE(height.error().describe().find(server.address("m.amt")), std::string::npos);
  }
  isDown = false;
  expectHeight(*terrain, placeOf(3));
}

TEST_F(OpenTerrainTest, AQuestionThatIsStoppedEndsNoOther) {
  std::atomic<bool> isSlow = false;
  const HttpServer server({{"m.amt", mountains().bytes}}, [&](const std::string&, int) {
    HttpFault fault;
    fault.drips = isSlow;
    return fault;
  });
  const auto terrain = opened(server.address("m.amt"));
  isSlow = true;
  std::atomic<bool> isStopped = false;
  RunContext context;
  context.cancel = &isStopped;
  Result<std::optional<GroundHeight>> stopped = std::optional<GroundHeight>();
  std::thread first([&] { stopped = heightAt(*terrain, placeOf(5), context); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  std::thread second([&] { expectHeight(*terrain, placeOf(6)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  isSlow = false;
  isStopped = true;
  first.join();
  second.join();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
  expectHeight(*terrain, placeOf(5));
}

TEST_F(OpenTerrainTest, AFileThatIsReplacedIsAnErrorUntilItIsThereAgain) {
  const TemporaryFolder folder;
  const std::string other = folder.file("other.amt");
  ASSERT_TRUE(
      writeAmt(other, got(build(test::hills(300, 250, [](double z) { return z; }))), {}, {.isPaged = true}));
  std::ifstream file(other, std::ios::binary);
  const std::string otherBytes((std::istreambuf_iterator<char>(file)), {});
  std::atomic<bool> isReplaced = false;
  const HttpServer server({{"m.amt", mountains().bytes}}, [&](const std::string&, int) {
    HttpFault fault;
    if (isReplaced) {
      fault.tag = "\"two\"";
      fault.content = otherBytes;
    }
    return fault;
  });
  const auto terrain = opened(server.address("m.amt"));
  isReplaced = true;
  for (int i = 0; i < 3; ++i) {
    const auto height = heightAt(*terrain, placeOf(7));
    ASSERT_FALSE(height);
    EXPECT_NE(height.error().message.find("replaced"), std::string::npos) << height.error().describe();
  }
  isReplaced = false;
  expectHeight(*terrain, placeOf(7));
}

TEST_F(OpenTerrainTest, ADamagedPageRefusesWhatNeedsItHoweverOftenItIsAsked) {
  const TemporaryFolder folder;
  const std::string path = folder.file("damaged.amt");
  std::string bytes = mountains().bytes;
  bytes[bytes.size() * 2 / 3] = static_cast<char>(bytes[bytes.size() * 2 / 3] ^ 0x55);
  std::ofstream(path, std::ios::binary) << bytes;
  const auto terrain = opened(path);
  int refused = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    if (const auto height = heightAt(*terrain, placeOf(seed)); !height) {
      EXPECT_EQ(height.error().code, ErrorCode::corrupt);
      EXPECT_NE(height.error().describe().find(path), std::string::npos);
      ++refused;
    } else {
      expectHeight(*terrain, placeOf(seed));
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 75);
  const auto all = terrain->whole();
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, ErrorCode::corrupt);
}

TEST_F(OpenTerrainTest, AFileThatIsNotInPagesIsReadWhole) {
  const TemporaryFolder folder;
  for (const bool isPacked : {false, true}) {
    const std::string path = folder.file("whole.amt");
    ASSERT_TRUE(writeAmt(path, mountains().whole->model, {}, {.isPacked = isPacked}));
    const auto terrain = opened(path);
    EXPECT_FALSE(terrain->isInParts());
    EXPECT_EQ(terrain->outline().mt.nodeCount(), mountains().whole->model.mt.nodeCount());
    expectHeight(*terrain, placeOf(9));
  }
}

}  // namespace
}  // namespace arete
