// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file that is checked part by part has the answer of the whole: what is planted is found by both.
#include "io/query/parts/validate_parts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/query/parts/parts_fixture.h"

namespace arete {
namespace {

using test::got;
using test::TemporaryFolder;

constexpr ValidateModelOptions kFull{.randomFronts = 2, .everyTriangle = true};

class ValidateParts : public ::testing::Test {
 protected:
  static const RasterHeightfield& field() {
    static const RasterHeightfield one = [] {
      const auto& families = rasterFamilies();
      RasterHeightfield made =
          std::ranges::find(families, std::string_view("fractal"), &RasterFamily::name)->make(190, 170, 3);
      // Voids, one of them across the rims of parts, and an isolated sample in one.
      for (std::uint32_t row = 50; row < 80; ++row)
        for (std::uint32_t column = 60; column < 100; ++column)
          if (row != 64 || column != 70) made.heights[made.index(column, row)] = std::nan("");
      made.sourceChecksum = heightsChecksum(made);
      return made;
    }();
    return one;
  }
  static const TerrainModel& model() {
    static const TerrainModel one = got(build(field()));
    return one;
  }
  AmtFile written(const TerrainModel& of) {
    const std::string path = folder_.file(fmt::format("{}.amt", ++files_));
    EXPECT_TRUE(writeAmt(path, of, {}, {.isPaged = true}));
    return got(openAmt(path));
  }
  static Status inParts(const AmtFile& file, std::uint32_t rows) {
    const auto found = validateInParts(file, {.laws = kFull, .mostRows = rows});
    return found ? Status() : Status(tl::unexpected(found.error()));
  }
  /// "law 10" of an error's message.
  static std::string lawOf(const Status& status) {
    return status ? "every law holds" : status.error().message.substr(0, status.error().message.find(':'));
  }

  TemporaryFolder folder_;
  int files_ = 0;
};

TEST_F(ValidateParts, HoldWhereTheWholeHoldsAndReadEveryPage) {
  const AmtFile file = written(model());
  ASSERT_TRUE(validateModel(got(file.read()), kFull));
  const std::size_t pages = got(file.pagesFor({})).size();
  EXPECT_GT(pages, 8u);
  for (const std::uint32_t rows : {1000u, 170u, 70u, 33u}) {
    const ValidatedParts found = got(validateInParts(file, {.laws = kFull, .mostRows = rows}));
    EXPECT_EQ(found.pages, pages) << rows;
    EXPECT_EQ(found.parts, rows >= 170 ? 1 : (169 + rows - 2) / (rows - 1)) << rows;
    EXPECT_TRUE(found.errors.areAll());
  }
}

TEST_F(ValidateParts, FindEveryStoredErrorThatIsTooSmallAsTheWholeDoes) {
  const MtArrays& a = model().mt.arrays();
  std::vector<std::uint32_t> large;  // triangles with an error
  for (std::uint32_t t = 0; t < a.error.size(); ++t)
    if (a.error[t] > 3000) large.push_back(t);
  ASSERT_GT(large.size(), 200u);
  int planted = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    const std::uint32_t t = large[large.size() * i / 9];
    struct Codes {
      std::vector<std::uint16_t> error, below, above;
    };
    const auto codes = std::make_shared<Codes>();
    codes->error.assign(a.error.begin(), a.error.end());
    codes->below.assign(a.columns.of(kBelow).begin(), a.columns.of(kBelow).end());
    codes->above.assign(a.columns.of(kAbove).begin(), a.columns.of(kAbove).end());
    codes->error[t] = static_cast<std::uint16_t>(codes->error[t] - 900);
    codes->below[t] = std::min(codes->below[t], codes->error[t]);
    codes->above[t] = std::min(codes->above[t], codes->error[t]);
    TerrainModel changed = model();
    MtArrays arrays = a;
    arrays.error = codes->error;
    arrays.columns.set(kBelow, codes->below);
    arrays.columns.set(kAbove, codes->above);
    changed.mt = MultiTriangulation(
        arrays,
        std::make_shared<std::pair<MultiTriangulation, std::shared_ptr<const Codes>>>(model().mt, codes));
    const AmtFile file = written(changed);
    const Status whole = validateModel(got(file.read()), kFull);
    planted += whole ? 0 : 1;
    for (const std::uint32_t rows : {80u, 21u}) {
      const Status parts = inParts(file, rows);
      EXPECT_EQ(lawOf(parts), lawOf(whole))
          << t << " in parts of " << rows << ": " << (parts ? "" : parts.error().message);
      if (!parts) {
        EXPECT_EQ(parts.error().code, ErrorCode::brokenPromise);
        EXPECT_NE(parts.error().message.find("rows "), std::string::npos) << parts.error().message;
      }
    }
  }
  EXPECT_GE(planted, 5) << "too few errors were planted that the whole finds";
}

TEST_F(ValidateParts, FindAHeightThatIsNotTheSources) {
  TerrainModel changed = model();
  changed.sourceChecksum.back() = changed.sourceChecksum.back() == '0' ? '1' : '0';
  const AmtFile file = written(changed);
  const Status whole = validateModel(got(file.read()), kFull);
  EXPECT_EQ(lawOf(whole), "law 8");
  for (const std::uint32_t rows : {170u, 40u}) EXPECT_EQ(lawOf(inParts(file, rows)), "law 8");
}

TEST_F(ValidateParts, FindAFixedVertexThatIsNotInTheRoot) {
  TerrainModel changed = model();
  const auto& samples = model().mt.vertices().samples;
  changed.options.fixedVertices = {samples[samples.size() - 1]};
  const AmtFile file = written(changed);
  EXPECT_EQ(lawOf(validateModel(got(file.read()), kFull)), "law 7");
  EXPECT_EQ(lawOf(inParts(file, 60)), "law 7");
}

TEST_F(ValidateParts, ADamagedPageIsNamed) {
  const AmtFile file = written(model());
  std::string bytes = test::readAll(file.path());
  bytes[bytes.size() * 3 / 4] = static_cast<char>(bytes[bytes.size() * 3 / 4] ^ 0x10);
  test::writeAll(file.path(), bytes);
  const Status parts = inParts(got(openAmt(file.path())), 60);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error().code, ErrorCode::corrupt);
  EXPECT_NE(parts.error().message.find("page"), std::string::npos) << parts.error().message;
}

TEST_F(ValidateParts, CheckASampleOfTrianglesUnlessAllAreAskedFor) {
  const AmtFile file = written(model());
  const ValidatedParts some = got(validateInParts(file, {.laws = {.randomFronts = 1}, .mostRows = 100}));
  EXPECT_GT(some.errors.checked, 10000u);
  EXPECT_LE(some.errors.checked, some.errors.triangles);
}

}  // namespace
}  // namespace arete
