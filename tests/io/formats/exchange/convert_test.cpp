// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/convert.h"

#include <gtest/gtest.h>

#include <string>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::TemporaryFolder;

/// A triangle with everything that a file can say of it.
MeshFile whole() {
  MeshFile file;
  file.mesh.shape() = {{{500000.1, 4000000.1, 100.123456789}, {500010, 4000000, 1}, {500000, 4000010, 2}},
                       {{0, 1, 2}}};
  file.crsWkt = "EPSG:32611";
  file.up = MeshUp::z;
  file.verticalUnit = "ft";
  file.triangleErrors = {0.5F};
  return file;
}

TEST(ConvertMesh, LosesNothingInAPly) {
  const TemporaryFolder folder;
  const auto converted = convertMesh(whole(), folder.file("a.ply"));
  ASSERT_TRUE(converted) << converted.error().describe();
  EXPECT_TRUE(converted->lost.empty()) << joined(converted->lost);
  EXPECT_TRUE(converted->warnings.empty());
  EXPECT_EQ(converted->frame.rounding, Vec3{});
  const auto back = readMesh(folder.file("a.ply"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh.positions, whole().mesh.positions);
  EXPECT_EQ(back->verticalUnit, "ft");
  EXPECT_EQ(back->triangleErrors, whole().triangleErrors);
}

TEST(ConvertMesh, SaysWhatAnStlCannotHold) {
  const TemporaryFolder folder;
  const auto converted = convertMesh(whole(), folder.file("a.stl"));
  ASSERT_TRUE(converted) << converted.error().describe();
  ASSERT_EQ(converted->lost.size(), 4u) << joined(converted->lost);
  EXPECT_TRUE(contains(joined(converted->lost), "the CRS"));
  EXPECT_TRUE(contains(joined(converted->lost), "the unit of the heights"));
  EXPECT_TRUE(contains(joined(converted->lost), "the error of each triangle"));
  EXPECT_TRUE(contains(joined(converted->lost), "coordinates finer than"));
  EXPECT_GT(converted->frame.rounding.z, 0);
  EXPECT_EQ(converted->crsWkt, "EPSG:32611") << "still known";
}

TEST(ConvertMesh, WarnsThatRoundedCoordinatesLookExactInAnExactFormat) {
  const TemporaryFolder folder;
  ASSERT_TRUE(convertMesh(whole(), folder.file("a.stl")));
  auto rounded = readMesh(folder.file("a.stl"));
  ASSERT_TRUE(rounded);
  const auto converted = convertMesh(std::move(*rounded), folder.file("b.obj"));
  ASSERT_TRUE(converted);
  ASSERT_EQ(converted->warnings.size(), 1u);
  EXPECT_TRUE(contains(converted->warnings[0].sentence, "OBJ")) << converted->warnings[0].sentence;
}

TEST(ConvertMesh, ReplacesTheCrsByTheStatedOne) {
  const TemporaryFolder folder;
  const auto same = convertMesh(whole(), folder.file("a.ply"), {.crs = "EPSG:32611"});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->warnings.empty()) << joined(same->warnings);
  const auto other = convertMesh(whole(), folder.file("a.ply"), {.crs = "EPSG:32612"});
  ASSERT_TRUE(other);
  ASSERT_EQ(other->warnings.size(), 1u);
  EXPECT_TRUE(contains(other->crsWkt, "zone 12N"));
  EXPECT_EQ(readMesh(folder.file("a.ply"))->mesh.positions, whole().mesh.positions)
      << "nothing is reprojected";
  MeshFile bare = whole();
  bare.crsWkt.clear();
  bare.verticalUnit.clear();
  const auto stated = convertMesh(std::move(bare), folder.file("a.ply"), {.crs = "EPSG:2227+6360"});
  ASSERT_TRUE(stated);
  EXPECT_FALSE(stated->verticalUnit.empty()) << "the unit of a compound CRS";
}

TEST(ConvertMesh, RefusesWhatIsNotACrsAndNamesIt) {
  const TemporaryFolder folder;
  for (const char* crs : {"gibberish", "EPSG:5773", "EPSG:4978"}) {
    const auto converted = convertMesh(whole(), folder.file("a.ply"), {.crs = crs});
    ASSERT_FALSE(converted) << crs;
    EXPECT_EQ(converted.error().culprit, crs);
  }
  EXPECT_EQ(convertMesh(whole(), folder.file("a.dxf")).error().code, ErrorCode::unsupported);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete
