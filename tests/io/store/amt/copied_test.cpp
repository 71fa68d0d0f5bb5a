// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are read piece by piece: the same parts as of mapped files, and an error where the file is
// changed meanwhile.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <thread>

#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "io/store/amt/surface_file.h"
#include "io/written_amt.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::areSame;
using test::built;
using test::expectSame;
using test::hills;
using test::TemporaryFolder;
using test::writtenTo;

constexpr AmtOpenOptions kCopied{.isCopied = true};

TEST(CopiedAmt, GivesThePartsOfAMappedFile) {
  const TemporaryFolder folder;
  for (const bool isPacked : {false, true}) {
    const std::string path = writtenTo(folder, isPacked);
    for (unsigned seed = 0; seed < 24; ++seed) {
      SCOPED_TRACE(fmt::format("packed {}, seed {}", isPacked, seed));
      std::mt19937 random(seed);
      const auto upTo = [&](double most) { return most * double(random()) / double(std::mt19937::max()); };
      const double left = upTo(200), top = upTo(160), inside = seed % 3 == 0 ? 0 : upTo(5),
                   outside = seed % 4 == 0 ? inside : std::numeric_limits<double>::infinity();
      const Box2 box{left, top, left + upTo(60), top + upTo(60)};
      const RequiredError wanted = requiredInPlan([&](const Box2& b) {
        return b.xMin <= box.xMax && b.xMax >= box.xMin && b.yMin <= box.yMax && b.yMax >= box.yMin ? inside
                                                                                                    : outside;
      });
      // Opened anew: nothing of it is loaded yet.
      const auto mapped = loadAmt(path, {.verify = AmtVerify::all, .open = {}, .wanted = wanted}),
                 copied = loadAmt(path, {.verify = AmtVerify::all, .open = kCopied, .wanted = wanted});
      ASSERT_TRUE(mapped && copied) << copied.error().describe();
      expectSame(*mapped, *copied);
      const auto unchecked = loadAmt(path, {.verify = AmtVerify::indices, .open = kCopied, .wanted = wanted});
      ASSERT_TRUE(unchecked);
      expectSame(*mapped, *unchecked);
    }
    const auto mapped = openAmt(path), copied = openAmt(path, kCopied);
    ASSERT_TRUE(mapped && copied);
    for (const std::uint64_t nodes : {1u, 100u, 5000u, 30000u, 1000000u})
      EXPECT_EQ(mapped->errorBeyond(nodes), copied->errorBeyond(nodes));
    expectSame(built(mapped->read()), built(copied->read()));
  }
}

TEST(CopiedAmt, IsAnErrorWhereTheFileIsChangedAfterItWasOpened) {
  const TemporaryFolder folder, other;
  const std::string rewritten = writtenTo(other, false, false),
                    rewrittenPacked = writtenTo(other, true, false);
  using Change = void (*)(const std::string& path, const std::string& other);
  const std::pair<const char*, Change> changes[] = {
      {"cut to 100 bytes", [](const std::string& p, const std::string&) { fs::resize_file(p, 100); }},
      {"cut to nothing", [](const std::string& p, const std::string&) { fs::resize_file(p, 0); }},
      {"cut in half",
       [](const std::string& p, const std::string&) { fs::resize_file(p, fs::file_size(p) / 2); }},
      {"without its last byte",
       [](const std::string& p, const std::string&) { fs::resize_file(p, fs::file_size(p) - 1); }},
      {"with another one's bytes",
       [](const std::string& p, const std::string& o) {
         std::ifstream from(o, std::ios::binary);
         const std::string bytes((std::istreambuf_iterator<char>(from)), {});
         std::fstream to(p, std::ios::binary | std::ios::in | std::ios::out);
         to << bytes;
       }},
  };
  for (const bool isPacked : {false, true})
    for (const bool isAll : {false, true})
      for (const auto& [name, change] : changes) {
        SCOPED_TRACE(fmt::format("{}, packed {}, all {}", name, isPacked, isAll));
        const std::string path = writtenTo(folder, isPacked);
        const auto file = openAmt(path, kCopied);
        ASSERT_TRUE(file);
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
        change(path, isPacked ? rewrittenPacked : rewritten);
        const RequiredError near = requiredInPlan([](const Box2& b) {
          return b.xMax >= 200 && b.yMax >= 160 ? 0 : std::numeric_limits<double>::infinity();
        });
        const auto model = file->read({.wanted = isAll ? RequiredError() : near});
        ASSERT_FALSE(model);
        EXPECT_EQ(model.error().code, ErrorCode::unreadable) << model.error().describe();
        EXPECT_EQ(model.error().culprit, path);
      }
}

TEST(CopiedAmt, AModelThatWasReadStaysAsItWas) {
  const TemporaryFolder folder;
  const std::string path = writtenTo(folder, false);
  const TerrainModel mapped = built(loadAmt(path));
  const std::string kept = folder.file("kept.amt");
  ASSERT_TRUE(writeAmt(kept, mapped));
  const TerrainModel copied = built(loadAmt(path, {.open = kCopied, .wanted = {}}));
  const TerrainModel same = built(loadAmt(kept));
  std::ofstream(path, std::ios::binary) << std::string(1000, 'x');  // in place: `mapped` is used no more
  expectSame(same, copied);
}

TEST(CopiedAmt, OfASurfaceIsTheSameModel) {
  const auto model = buildSurface(SurfaceMesh(shapes::globe(48, 30)));
  ASSERT_TRUE(model);
  const TemporaryFolder folder;
  for (const bool isPacked : {false, true}) {
    const std::string path = folder.file("globe.amt");
    ASSERT_TRUE(writeSurfaceAmt(path, *model, {}, {.isPacked = isPacked}));
    const auto container = AmtContainer::open(path, kCopied);
    ASSERT_TRUE(container);
    const auto copied = loadSurfaceAmt(*container), mapped = loadSurfaceAmt(path);
    ASSERT_TRUE(copied && mapped);
    EXPECT_TRUE(areSame(copied->mt.arrays().link, mapped->mt.arrays().link));
    EXPECT_EQ(copied->faceOf, mapped->faceOf);
    if (isPacked) continue;  // so small that all of it is read at once
    const auto open = AmtContainer::open(path, kCopied);
    ASSERT_TRUE(open);
    ASSERT_GT(fs::file_size(path), 140000u);  // more than is read when it is opened
    fs::resize_file(path, fs::file_size(path) / 2);
    EXPECT_FALSE(loadSurfaceAmt(*open));
  }
}

}  // namespace
}  // namespace arete
