// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/lonlat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

Georeference inCrs(const std::string& crs) {
  Georeference georeference;
  const auto parsed = crsFromText(crs);
  EXPECT_TRUE(parsed) << crs;
  if (parsed) {
    EXPECT_TRUE(describeCrs(*parsed, georeference));
  }
  return georeference;
}

CrsLonLat lonLatOf(const std::string& crs) {
  auto made = CrsLonLat::of(inCrs(crs));
  EXPECT_TRUE(made) << crs << ": " << made.error().describe();
  return std::move(*made);
}

TEST(CrsLonLat, OfACrsOfDegreesIsTheIdentityToTheBit) {
  const CrsLonLat lonLat = lonLatOf("EPSG:4326");
  EXPECT_TRUE(lonLat.isPlain());
  std::vector<Vec2> positions = {{350.123456789, 46.5}, {-10, -89.999}};
  const std::vector<Vec2> before = positions;
  lonLat.toLonLat(positions);
  EXPECT_EQ(positions, before) << "longitudes are not normalized";
  lonLat.toCrs(positions);
  EXPECT_EQ(positions, before);
}

TEST(CrsLonLat, ConvertsGrads) {
  const CrsLonLat lonLat = lonLatOf("EPSG:4807");  // NTF (Paris), in grads
  EXPECT_TRUE(lonLat.isPlain());
  Vec2 p{100, 50};
  lonLat.toLonLat({&p, 1});
  EXPECT_NEAR(p.x, 90, 1e-12);
  EXPECT_NEAR(p.y, 45, 1e-12);
  lonLat.toCrs({&p, 1});
  EXPECT_NEAR(p.x, 100, 1e-12);
}

TEST(CrsLonLat, StaysOnTheDatumOfTheMap) {
  // The central meridian of zone 11 is -117 of each datum; a change of datum would move it by metres.
  for (const char* crs : {"EPSG:32611", "EPSG:26711", "EPSG:26911"}) {
    const CrsLonLat lonLat = lonLatOf(crs);
    EXPECT_FALSE(lonLat.isPlain());
    Vec2 p{500000, 3.8e6};
    lonLat.toLonLat({&p, 1});
    EXPECT_NEAR(p.x, -117, 1e-11) << crs;
    lonLat.toCrs({&p, 1});
    EXPECT_NEAR(p.x, 500000, 1e-6) << crs;
    EXPECT_NEAR(p.y, 3.8e6, 1e-6) << crs;
  }
}

TEST(CrsLonLat, GivesNanOutsideTheDomain) {
  const CrsLonLat lonLat = lonLatOf("EPSG:32611");
  std::vector<Vec2> positions = {{-117, 34}, {-117, 3400}};
  lonLat.toCrs(positions);
  EXPECT_NEAR(positions[0].x, 500000, 1e-6);
  EXPECT_TRUE(std::isnan(positions[1].x));
}

TEST(CrsLonLat, ServesManyThreadsAtOnce) {
  const CrsLonLat lonLat = lonLatOf("EPSG:32611");
  Vec2 expected{400000, 3.9e6};
  lonLat.toLonLat({&expected, 1});
  std::vector<int> wrong(8, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 200; ++i) {
        Vec2 p{400000, 3.9e6};
        lonLat.toLonLat({&p, 1});
        wrong[std::size_t(t)] += p == expected ? 0 : 1;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(CrsLonLat, NeedsACrsOnAnEllipsoid) {
  const auto none = CrsLonLat::of({});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  Georeference site;
  site.crsWkt = "LOCAL_CS[\"site\",UNIT[\"metre\",1]]";
  const auto local = CrsLonLat::of(site);
  ASSERT_FALSE(local);
  EXPECT_EQ(local.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete
