// SPDX-License-Identifier: GPL-3.0-or-later
//
// Law 10 on damaged models: whatever is stored too small is found.
#include "terrain/laws/validate_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "datasets/families.h"
#include "datasets/hostile_heights.h"
#include "terrain/builder/build.h"
#include "terrain/laws/compare_source.h"
#include "terrain/laws/validate_model.h"

namespace arete {
namespace {

struct Codes {
  std::vector<std::uint16_t> error, below, above;
};

/// The model with other codes.
TerrainModel with(const TerrainModel& model, std::shared_ptr<const Codes> codes) {
  TerrainModel changed = model;
  MtArrays arrays = model.mt.arrays();
  arrays.error = codes->error;
  arrays.columns.set(kBelow, codes->below);
  arrays.columns.set(kAbove, codes->above);
  const MultiTriangulation original = model.mt;
  changed.mt = MultiTriangulation(
      arrays, std::make_shared<std::pair<MultiTriangulation, std::shared_ptr<const Codes>>>(
                  original, std::move(codes)));
  return changed;
}

std::shared_ptr<Codes> codesOf(const TerrainModel& model) {
  const MtArrays& a = model.mt.arrays();
  auto codes = std::make_shared<Codes>();
  codes->error.assign(a.error.begin(), a.error.end());
  codes->below.assign(a.columns.of(kBelow).begin(), a.columns.of(kBelow).end());
  codes->above.assign(a.columns.of(kAbove).begin(), a.columns.of(kAbove).end());
  return codes;
}

Status law10(const TerrainModel& model) {
  const auto checked = validateErrors(model, frontOfPrefix(model.mt, model.mt.nodeCount()), true, 1);
  if (!checked) return tl::unexpected(checked.error());
  EXPECT_TRUE(checked->areAll());
  return {};
}

template <class Heightfield>
void expectEachSmallerCodeIsFound(const Heightfield& field, const std::string& name) {
  const auto model = build(field);
  ASSERT_TRUE(model) << name << ": " << model.error().describe();
  const Status whole = law10(*model);
  ASSERT_TRUE(whole) << name << ": " << whole.error().describe();
  const auto codes = codesOf(*model);
  std::size_t smaller = 0, found = 0;
  for (std::size_t t = 0; t < codes->error.size(); t += 1 + codes->error.size() / 25)
    for (const auto which : {&Codes::error, &Codes::below, &Codes::above}) {
      auto changed = std::make_shared<Codes>(*codes);
      std::uint16_t& code = ((*changed).*which)[t];
      if (code < 2 || (which != &Codes::error && code < 0x800)) continue;
      // Bounds are widened and include neighbours' edges: only a good part less is certainly too small.
      code = which == &Codes::error ? std::uint16_t(code - 1) : std::uint16_t(0);
      ++smaller;
      found += !law10(with(*model, std::move(changed)));
    }
  EXPECT_GT(smaller, 0u) << name;
  EXPECT_GE(10 * found, 9 * smaller) << name << ": of " << smaller << " codes made smaller, found " << found;
}

TEST(Law10, FindsErrorsAndBoundsThatAreTooSmall) {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name != "flat" && family.name != "plane")
      if (const auto model = build(family.make(19, 16, 3)); model && model->mt.largestError() > 0)
        expectEachSmallerCodeIsFound(family.make(19, 16, 3), std::string(family.name));
}

TEST(Law10, FindsThemOverPoints) {
  for (const std::uint64_t seed : {3u, 8u, 21u}) {
    PointHeightfield field = hostilePoints(seed, 12, 10);
    for (std::size_t i = 0; i < field.size(); ++i) field.heights[i] = double((i * 37) % 23);
    expectEachSmallerCodeIsFound(field, "points " + std::to_string(seed));
  }
}

TEST(Law10, HoldsOnEveryFamilyAndFailsWhereAllErrorsAreZero) {
  for (const PointFamily& family : pointFamilies()) {
    const auto model = build(family.make(150, 5));
    ASSERT_TRUE(model) << family.name;
    const Status status = law10(*model);
    EXPECT_TRUE(status) << family.name << ": " << status.error().describe();
    if (!(model->mt.largestError() > 0)) continue;
    auto zero = codesOf(*model);
    std::ranges::fill(zero->error, 0);
    EXPECT_FALSE(law10(with(*model, zero))) << family.name;
  }
}

TEST(Law8, FindsAChangedHeight) {
  const RasterHeightfield field = rasterFamilies()[0].make(20, 20, 1);
  auto model = build(field);
  ASSERT_TRUE(model);
  EXPECT_TRUE(validateModel(*model));
  model->sourceChecksum.back() = model->sourceChecksum.back() == '0' ? '1' : '0';
  const Status status = validateModel(*model);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("law 8"), std::string::npos);
}

TEST(CompareWithSource, FindsEveryHeightThatDiffers) {
  RasterHeightfield field = hostileHeights(12, 20, 16).field;
  const auto model = build(field);
  ASSERT_TRUE(model);
  EXPECT_EQ(compareWithSource(*model, field).value(), 320u);
  for (const double change : {1.0, std::nan("")}) {
    RasterHeightfield other = field;
    const std::size_t at = 77;
    other.heights[at] = other.heights[at] + change;
    const auto compared = compareWithSource(*model, other);
    ASSERT_FALSE(compared);
    EXPECT_EQ(compared.error().code, ErrorCode::brokenPromise);
    EXPECT_NE(compared.error().message.find("1 of 320 heights"), std::string::npos)
        << compared.error().message;
    EXPECT_NE(compared.error().message.find("column 17, row 3"), std::string::npos);
  }
  RasterHeightfield moved = field;
  moved.georeference.geoTransform[0] += 1;
  EXPECT_FALSE(compareWithSource(*model, moved));
  RasterHeightfield cut = hostileHeights(12, 20, 15).field;
  EXPECT_FALSE(compareWithSource(*model, cut));

  PointHeightfield points = hostilePoints(12, 9, 8);
  const auto ofPoints = build(points);
  ASSERT_TRUE(ofPoints);
  std::ranges::reverse(points.positions);
  std::ranges::reverse(points.heights);
  EXPECT_TRUE(compareWithSource(*ofPoints, points)) << "their order does not matter";
  points.heights[5] += 1;
  EXPECT_FALSE(compareWithSource(*ofPoints, points));
  EXPECT_FALSE(compareWithSource(*ofPoints, field));
}

}  // namespace
}  // namespace arete
