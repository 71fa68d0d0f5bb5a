// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a plain file that a query reads, compared with the whole: the same cuts, every check, and
// nothing read that no answer depends on. (Heights, lines of sight, regions and focuses:
// query_footprint_test.cpp.)
#include "io/store/amt/part.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::hills;
using test::TemporaryFolder;
using test::tinyModel;

constexpr double kNothing = std::numeric_limits<double>::infinity();

RequiredError everywhere(double error) {
  return [error](const Box3&) { return error; };
}
RequiredError in(const Box2& box, double error) {
  return requiredInPlan([box, error](const Box2& b) {
    const bool meets = b.xMin <= box.xMax && b.xMax >= box.xMin && b.yMin <= box.yMax && b.yMax >= box.yMin;
    return meets ? error : kNothing;
  });
}

TerrainModel part(const std::string& path, const RequiredError& wanted, AmtVerify verify = AmtVerify::all) {
  return built(loadAmt(path, {.verify = verify, .open = {}, .wanted = wanted}));
}

std::string refusalOf(const std::string& path, const RequiredError& wanted) {
  const Result<TerrainModel> model = loadAmt(path, {.open = {}, .wanted = wanted});
  if (model) return {};
  EXPECT_EQ(model.error().culprit, path);
  EXPECT_EQ(model.error().code, ErrorCode::corrupt);
  return model.error().message;
}

/// Hills of 90 000 samples, more than eighty pages of nodes.
TerrainModel manyPages() {
  RasterHeightfield field = hills(300, 300, [](double z) { return std::round(4 * z) / 4; });
  field.georeference.geoTransform = {0, 30, 0, 0, 0, -30};
  return built(build(field));
}

void expectSameCut(const MultiTriangulation& whole, const MultiTriangulation& some,
                   const Criterion& criterion, CutMethod method) {
  const auto x = takeCut(whole, criterion, {.method = method}),
             y = takeCut(some, criterion, {.method = method});
  ASSERT_TRUE(x && y);
  EXPECT_EQ(x->ids, y->ids);
  EXPECT_EQ(x->triangles, y->triangles);
  EXPECT_EQ(x->vertices, y->vertices);
  EXPECT_EQ(x->achievedError, y->achievedError);
}

void expectKeepsTheLaws(const TerrainModel& some) {
  const Status laws = validate(some.mt, {.allowsFills = some.options.rimTolerance > 0});
  EXPECT_TRUE(laws) << laws.error().describe();
  const TemporaryFolder folder;
  ASSERT_TRUE(writeAmt(folder.file("part.amt"), some));
  const Result<TerrainModel> checked = loadAmt(folder.file("part.amt"));
  EXPECT_TRUE(checked) << checked.error().describe();
}

TEST(AmtPart, HasTheCutsOfTheWholeWithItsNumbersWhereTheSameIsWantedEverywhere) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  std::vector<TerrainModel> models = {manyPages()};
  for (const RasterFamily& family : rasterFamilies()) models.push_back(built(build(family.make(90, 80, 8))));
  for (const PointFamily& family : pointFamilies()) models.push_back(built(build(family.make(2000, 8))));
  for (const TerrainModel& whole : models) {
    SCOPED_TRACE(whole.source);
    ASSERT_TRUE(writeAmt(path, whole));
    const double largest = whole.mt.largestError() > 0 ? whole.mt.largestError() : 1;  // flat
    std::uint32_t before = whole.mt.nodeCount();
    for (const double least :
         {-1.0, std::nan(""), 0.0, 1e-30, 0.01 * largest, 0.2 * largest, largest, kNothing}) {
      SCOPED_TRACE(least);
      const TerrainModel some = part(path, everywhere(least));
      if (!(least > 0)) {
        EXPECT_EQ(some.mt.nodeCount(), whole.mt.nodeCount());
      }
      EXPECT_LE(some.mt.nodeCount(), before);
      before = some.mt.nodeCount();
      if (least >= largest) {
        EXPECT_EQ(before, 0u);
      }
      expectKeepsTheLaws(some);
      const double allowed = least > 0 ? least : 0;
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        expectSameCut(whole.mt, some.mt, UniformError(allowed), method);
        if (std::isinf(allowed)) continue;
        const RegionError corner(Region::box({0, 0, 9, 5}), whole.mt.arrays().metric, allowed,
                                 2 * allowed + 1);
        expectSameCut(whole.mt, some.mt, corner, method);
      }
    }
  }
}

TEST(AmtPart, HasTheRegionsOfTheWholeWhetherCutsAreMinimalOrSaturated) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const TerrainModel whole = manyPages();
  ASSERT_TRUE(writeAmt(path, whole));
  const auto heightsOf = [](const MultiTriangulation& mt, const Cut& cut) {
    std::vector<double> heights;
    for (const std::uint32_t v : cut.vertices) heights.push_back(mt.position(VertexId(v)).z);
    return heights;
  };
  for (const Box2& box :
       {Box2{10, 10, 40, 30}, Box2{140, 150, 141, 151}, Box2{-5, -5, 3, 400}, Box2{500, 9, 501, 10}})
    for (const double error : {0.0, 0.5, 4.0}) {
      SCOPED_TRACE(fmt::format("{} {} within {}", box.xMin, box.yMin, error));
      const TerrainModel some = part(path, in(box, error));
      EXPECT_LT(some.mt.nodeCount(), whole.mt.nodeCount() / 2);
      expectKeepsTheLaws(some);
      const RegionError region(Region::box(box), whole.mt.arrays().metric, error, kNothing);
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto x = takeCut(whole.mt, region, {.method = method}),
                   y = takeCut(some.mt, region, {.method = method});
        ASSERT_TRUE(x && y);
        EXPECT_EQ(x->triangles, y->triangles);
        EXPECT_EQ(heightsOf(whole.mt, *x), heightsOf(some.mt, *y));
        EXPECT_EQ(x->achievedError, y->achievedError);
      }
    }
}

TEST(AmtPart, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, manyPages()));
  for (const RequiredError& wanted : {everywhere(1.5), in({10, 10, 40, 30}, 0.1)}) {
    RunContext one;
    one.threads = 1;
    const TerrainModel x = built(loadAmt(path, {.open = {}, .wanted = wanted}, one)), y = part(path, wanted);
    test::expectSameModel(x, y);
  }
}

TEST(AmtPart, SeesWhatWasAlteredWhereItReadsAndDoesNotLookElsewhere) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt"), changed = folder.file("changed.amt");
  ASSERT_TRUE(writeAmt(path, manyPages()));
  const AmtBytes good = AmtBytes::of(path);
  const auto changedAt = [&](const AmtTag& tag, double where) {
    AmtBytes bytes = good;
    const auto array = bytes.array<std::uint8_t>(tag);
    array[static_cast<std::size_t>(where * static_cast<double>(array.size() - 1))] ^= 1;
    bytes.save(changed);
  };
  const RequiredError coarse = everywhere(5);
  ASSERT_EQ(refusalOf(path, coarse), "");
  for (const AmtTag& tag :
       {amt_tag::kRootTriangles, amt_tag::kSlotBegin, amt_tag::kLink, amt_tag::kRemover, amt_tag::kError,
        amt_tag::kBelow, amt_tag::kAbove, amt_tag::kFloor, amt_tag::kSaturatedError, amt_tag::kSphere,
        amt_tag::kBlockError, amt_tag::kBlockSphere, amt_tag::kCreatorHint, amt_tag::kSamples,
        amt_tag::kHeights}) {
    const std::string name(tag.data(), tag.size());
    changedAt(tag, 0);
    EXPECT_NE(refusalOf(changed, coarse).find("chunk " + name), std::string::npos) << name;
    EXPECT_NE(refusalOf(changed, nullptr).find("chunk " + name), std::string::npos) << name;
  }
  for (const AmtTag& tag : {amt_tag::kLink, amt_tag::kRemover, amt_tag::kError, amt_tag::kSphere}) {
    changedAt(tag, 1);
    EXPECT_EQ(refusalOf(changed, coarse), "");
    EXPECT_NE(refusalOf(changed, everywhere(0)), "");
    EXPECT_NE(refusalOf(changed, nullptr), "");
  }
  changedAt(amt_tag::kSegmentChecksums, 0.5);
  EXPECT_EQ(refusalOf(changed, coarse), "has been altered: the checksum of chunk PSUM does not match");
  EXPECT_EQ(refusalOf(changed, nullptr), "has been altered: the checksum of chunk PSUM does not match");
}

TEST(AmtPart, NamesADamagedNodeByTheNumberThatItHasInTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const TerrainModel whole = manyPages();
  ASSERT_TRUE(writeAmt(path, whole));
  AmtBytes bytes = AmtBytes::of(path);
  // The link of the last node that the corner needs names a vertex that is younger.
  const Box2 corner{0, 0, 20, 20};
  const std::uint32_t last = whole.mt.nodeCount() - 1;
  std::uint32_t n = last;
  for (;; --n) {
    const Vec3 p = whole.mt.position(whole.mt.apex(NodeId(n)));
    if (p.x <= corner.xMax && p.y <= corner.yMax) break;
  }
  bytes.array<std::uint32_t>(amt_tag::kLink)[whole.mt.arrays().slotBegin[n]] = whole.mt.vertexCount() - 1;
  bytes.seal();
  bytes.save(path);
  const std::string message = refusalOf(path, in(corner, 0));
  EXPECT_EQ(message, refusalOf(path, nullptr));
  EXPECT_NE(message.find(fmt::format("not older than node {}'s", n)), std::string::npos) << message;
}

TEST(AmtPart, RefusesOrSurvivesWhateverTheBytesAre) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  RasterHeightfield field = hills(110, 100, [](double z) { return std::round(z) + 0.0; });
  field.georeference.geoTransform = {0, 30, 0, 0, 0, -30};
  ASSERT_TRUE(writeAmt(path, built(build(field))));
  const AmtBytes good = AmtBytes::of(path);
  const RequiredError required[] = {everywhere(3), in({5, 5, 12, 9}, 0), in({50, 50, 50, 50}, 0.7)};
  std::mt19937 random(9);
  int refused = 0, survived = 0;
  for (int round = 0; round < 500; ++round) {
    AmtBytes bytes = good;
    bytes.spoil(random);
    bytes.seal();
    bytes.save(path);
    for (const RequiredError& wanted : required) {
      const Result<TerrainModel> some = loadAmt(path, {.open = {}, .wanted = wanted});
      if (!some) {
        ++refused;
        EXPECT_EQ(some.error().code, ErrorCode::corrupt) << some.error().describe();
        continue;
      }
      ++survived;
      ASSERT_TRUE(writeAmt(folder.file("part.amt"), *some));
      const Result<TerrainModel> checked = loadAmt(folder.file("part.amt"));
      ASSERT_TRUE(checked) << round << ": " << checked.error().describe();
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(survived, 100);
}

TEST(AmtPart, IsAllOfAFileOfAnEarlierBuildWhichHasNoChecksumsOfSegments) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt"), earlier = folder.file("earlier.amt");
  const TerrainModel whole = manyPages();
  ASSERT_TRUE(writeAmt(path, whole));
  AmtBytes::of(path).withoutSegments().save(earlier);
  EXPECT_TRUE(openAmt(path)->hasSegments());
  EXPECT_FALSE(openAmt(earlier)->hasSegments());
  test::expectSameModel(part(earlier, everywhere(5)), whole);
  test::expectSameModel(part(earlier, nullptr), whole);
}

TEST(AmtPart, IsTheWholeMappedFileWhereNothingIsChecked) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const TerrainModel whole = manyPages();
  ASSERT_TRUE(writeAmt(path, whole));
  test::expectSameModel(part(path, everywhere(5), AmtVerify::none), whole);
  EXPECT_LT(part(path, everywhere(5), AmtVerify::indices).mt.nodeCount(), whole.mt.nodeCount());
}

TEST(AmtPart, RefusesAFileWhoseSegmentsAreNotAsManyAsItHas) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, tinyModel()));
  AmtBytes bytes = AmtBytes::of(path);
  bytes.chunk(amt_tag::kSegmentChecksums).bytes -= 8;
  bytes.sealHeader();
  bytes.save(path);
  EXPECT_NE(refusalOf(path, everywhere(0)).find("instead of"), std::string::npos);
}

TEST(AmtPart, StopsWhenAskedTo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, manyPages()));
  for (const RequiredError& wanted : {everywhere(0.5), in({10, 10, 40, 30}, 0)})
    for (const std::string stage : {"check checksums", "check indices"}) {
      std::atomic<bool> cancel = false;
      RunContext context;
      context.cancel = &cancel;
      context.progress = [&](std::string_view now, double) { cancel = cancel || now == stage; };
      const Result<TerrainModel> some = loadAmt(path, {.open = {}, .wanted = wanted}, context);
      ASSERT_FALSE(some);
      EXPECT_EQ(some.error().code, ErrorCode::interrupted);
      EXPECT_EQ(some.error().culprit, path);
    }
}

}  // namespace
}  // namespace arete
