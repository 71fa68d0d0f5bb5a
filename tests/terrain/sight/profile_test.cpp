// SPDX-License-Identifier: GPL-3.0-or-later
//
// Profiles of rasters against the samples, cell by cell; of points against heights at places; the Fresnel
// zone against its closed form over flat ground.
#include "terrain/sight/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/sight/fresnel.h"
#include "terrain/sight/grid.h"

namespace arete {
namespace {

SightTrack trackThrough(const std::vector<Vec2>& places) {
  SightTrack track;
  double s = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) s += 30 * std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y);
    track.points.push_back({places[i], s});
  }
  return track;
}

Vec2 placeAt(const SightTrack& track, double s) {
  return SightLine(track, 0, 0).planAt(s);
}

/// Where the profile has terrain at s: its height; NaN where it has none.
double heightAt(const Profile& profile, double s) {
  for (std::size_t i = 1; i < profile.vertices.size(); ++i) {
    const ProfileVertex &p = profile.vertices[i - 1], &q = profile.vertices[i];
    if (q.isJoined && s >= p.distance && s <= q.distance)
      return q.distance > p.distance
                 ? p.height + (q.height - p.height) * (s - p.distance) / (q.distance - p.distance)
                 : p.height;
  }
  return std::nan("");
}

void expectInOrder(const Profile& profile) {
  double joined = 0;
  for (std::size_t i = 1; i < profile.vertices.size(); ++i) {
    const ProfileVertex &p = profile.vertices[i - 1], &q = profile.vertices[i];
    ASSERT_LE(p.distance, q.distance);
    if (q.isJoined) joined += q.distance - p.distance;
    ASSERT_TRUE(q.isJoined || q.distance > p.distance) << "a break without a gap";
  }
  ASSERT_NEAR(joined + profile.gapMetres, profile.length, 1e-6 * (1 + profile.length));
}

/// On an edge, or where the track turns or ends.
void expectVerticesOnEdges(const Profile& profile, const std::vector<Vec2>& places) {
  for (const ProfileVertex& v : profile.vertices) {
    const auto isWhole = [](double x) { return std::abs(x - std::round(x)) < 1e-5; };
    const bool isPlace = std::any_of(places.begin(), places.end(), [&](Vec2 p) {
      return std::hypot(p.x - v.plan.x, p.y - v.plan.y) < 1e-5;
    });
    ASSERT_TRUE(isPlace || isWhole(v.plan.x) || isWhole(v.plan.y) || isWhole(v.plan.x - v.plan.y) ||
                isWhole(v.plan.x + v.plan.y))
        << v.plan.x << ", " << v.plan.y;
  }
}

TEST(Profiles, AtFullResolutionAreTheSamplesCellByCell) {
  for (const RasterFamily& family : rasterFamilies())
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const RasterHeightfield field = family.make(37, 29, seed);
      const auto model = build(field);
      ASSERT_TRUE(model);
      const auto samples = std::make_shared<const SightGrid>(*model);
      const SightGrid& grid = *samples;
      const Profiles descents(*model), walks(*model, samples);
      Random random(seed);
      double largest = 1;
      for (const double z : field.heights)
        if (!std::isnan(z)) largest = std::max(largest, std::abs(z));
      for (int n = 0; n < 60; ++n) {
        std::vector<Vec2> places;
        for (int i = 0; i < 2 + n % 3; ++i) {
          Vec2 p{random.unit() * 38 - 1, random.unit() * 30 - 1};
          if (n % 4 == 1) p = {std::round(p.x), std::round(p.y)};  // along edges and diagonals
          if (n % 8 == 5 && i > 0) p.y = places[0].y;
          places.push_back(p);
        }
        const SightTrack track = trackThrough(places);
        for (const bool overCells : {false, true}) {
          const Profile profile = (overCells ? walks : descents).along(track);
          SCOPED_TRACE(std::string(family.name) + ", seed " + std::to_string(seed) + ", line " +
                       std::to_string(n) + (overCells ? " over cells" : " by descent"));
          expectInOrder(profile);
          expectVerticesOnEdges(profile, places);
          for (int i = 0; i < 200; ++i) {
            const double s = profile.length * random.unit();
            const double expected = grid.at(placeAt(track, s)), found = heightAt(profile, s);
            if (std::isnan(expected) != std::isnan(found)) {
              // Only by rounding, beside a rim.
              const double a = grid.at(placeAt(track, std::max(0.0, s - 1e-6))),
                           b = grid.at(placeAt(track, std::min(profile.length, s + 1e-6)));
              ASSERT_NE(std::isnan(a), std::isnan(b)) << s;
              continue;
            }
            if (!std::isnan(expected)) {
              ASSERT_NEAR(found, expected, 1e-7 * largest) << s;
            }
          }
        }
      }
    }
}

/// Where it passes a sample the descent may say it twice, a hair apart.
void dropRepeated(Profile& profile) {
  const auto isRepeated = [](const ProfileVertex& p, const ProfileVertex& q) {
    return q.isJoined && q.distance - p.distance < 1e-7;
  };
  auto& v = profile.vertices;
  v.erase(std::unique(v.begin(), v.end(), isRepeated), v.end());
}

TEST(Profiles, OverCellsHaveTheVerticesOfTheDescent) {
  for (const RasterFamily& family : rasterFamilies())
    for (const std::uint64_t seed : {4u, 5u}) {
      const auto model = build(family.make(41, 33, seed));
      ASSERT_TRUE(model);
      const Profiles descents(*model), walks(*model, std::make_shared<const SightGrid>(*model));
      Random random(seed);
      for (int n = 0; n < 100; ++n) {
        Vec2 p{random.unit() * 42 - 1, random.unit() * 34 - 1},
            q{random.unit() * 42 - 1, random.unit() * 34 - 1};
        if (n % 4 == 1) {  // through many samples
          const int dx = 1 + n % 3, dy = 1 + n % 5;
          p = {std::round(p.x), std::round(p.y)};
          q = {p.x + 7 * dx, p.y - 7 * dy};
        }
        const SightTrack track = trackThrough({p, q});
        const Profile found = walks.along(track);
        Profile expected = descents.along(track);
        SCOPED_TRACE(std::string(family.name) + ", seed " + std::to_string(seed) + ", line " +
                     std::to_string(n));
        dropRepeated(expected);
        ASSERT_EQ(found.vertices.size(), expected.vertices.size());
        ASSERT_NEAR(found.gapMetres, expected.gapMetres, 1e-6);
        for (std::size_t i = 0; i < found.vertices.size(); ++i) {
          const ProfileVertex &f = found.vertices[i], &e = expected.vertices[i];
          ASSERT_NEAR(f.distance, e.distance, 1e-6) << i;
          ASSERT_NEAR(f.height, e.height, 1e-7 * (1 + std::abs(e.height))) << i;
          ASSERT_EQ(f.isJoined, e.isJoined) << i;
        }
      }
    }
}

TEST(Profiles, KeepATolerance) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(64, 64, 7));
    ASSERT_TRUE(model);
    const Profiles profiles(*model);
    Random random(7);
    for (int n = 0; n < 20; ++n) {
      const SightTrack track =
          trackThrough({{random.unit() * 63, random.unit() * 63}, {random.unit() * 63, random.unit() * 63}});
      const Profile full = profiles.along(track);
      for (const double tolerance : {0.5, 5.0, 50.0}) {
        const Profile coarse = profiles.along(track, tolerance);
        expectInOrder(coarse);
        // Where detail changes there are two vertices.
        EXPECT_LE(coarse.vertices.size(), 2 * full.vertices.size()) << family.name;
        for (const ProfileVertex& v : full.vertices) {
          if (const double z = heightAt(coarse, v.distance); !std::isnan(z)) {
            ASSERT_NEAR(z, v.height, tolerance * (1 + 1e-9) + 1e-6) << family.name << " at " << v.distance;
          }
        }
      }
    }
  }
}

TEST(Profiles, OfPointsAreHeightsAtPlaces) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(200, 3);
    const auto model = build(field);
    ASSERT_TRUE(model) << family.name;
    const Profiles profiles(*model);
    Random random(3);
    for (int n = 0; n < 20; ++n) {
      const auto vertexOf = [&] {
        return field.positions[std::size_t(random.unit() * double(field.positions.size()))];
      };
      const SightTrack track = trackThrough({vertexOf(), vertexOf(), vertexOf()});
      const Profile profile = profiles.along(track);
      for (std::size_t i = 1; i < profile.vertices.size(); ++i) {
        const ProfileVertex &p = profile.vertices[i - 1], &q = profile.vertices[i];
        if (!q.isJoined || q.distance - p.distance < 1e-6) continue;
        const auto expected = profiles.heights().at({(p.plan.x + q.plan.x) / 2, (p.plan.y + q.plan.y) / 2});
        ASSERT_TRUE(expected) << family.name;
        ASSERT_NEAR((p.height + q.height) / 2, expected->height, 1e-5) << family.name;
      }
    }
  }
}

TEST(Profiles, OfAPlaceAreItsHeight) {
  const auto model = build(rasterFamilies()[0].make(9, 9, 1));
  ASSERT_TRUE(model);
  const SightGrid grid(*model);
  SightTrack track;
  track.points = {{{2, 3}, 0}, {{2, 3}, 0}};
  const Profile profile = Profiles(*model).along(track);
  ASSERT_EQ(profile.vertices.size(), 1u);
  EXPECT_EQ(profile.vertices[0].height, grid.height(2, 3));
}

TEST(FresnelClearance, OverFlatGroundIsLeastInTheMiddle) {
  const double wavelength = wavelengthMetres(300);
  EXPECT_NEAR(wavelength, 0.999308, 1e-6);
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{10, 0}, 10000}};
  Profile profile;
  profile.length = 10000;
  profile.vertices = {{0, {0, 0}, 100, false}, {3000, {3, 0}, 100, true}, {10000, {10, 0}, 100, true}};
  const auto found = leastFresnelClearance(SightLine(track, 130, 130), profile, wavelength);
  ASSERT_TRUE(found);
  const double radius = std::sqrt(wavelength * 10000 / 4);
  EXPECT_NEAR(found->fraction, 30 / radius, 1e-12);
  EXPECT_NEAR(found->place.distance, 5000, 1);
  // A spike right below the line, in feet.
  profile.vertices[1].height = 129;
  const auto spike = leastFresnelClearance(SightLine(track, 130, 130, 0.3048), profile, wavelength);
  ASSERT_TRUE(spike);
  EXPECT_NEAR(spike->fraction, 0.3048 / std::sqrt(wavelength * 3000 * 7000 / 10000), 1e-9);
  EXPECT_NEAR(spike->place.distance, 3000, 1e-6);
  EXPECT_FALSE(leastFresnelClearance(SightLine(track, 130, 130), Profile{}, wavelength));
}

TEST(FresnelClearance, IsNotToldWhereAnEndIsBelowTheGround) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{10, 0}, 10000}};
  Profile profile;
  profile.length = 10000;
  profile.vertices = {{0, {0, 0}, 100, false}, {3000, {3, 0}, 100, true}, {10000, {10, 0}, 100, true}};
  const auto found = [&](double from, double to) {
    return leastFresnelClearance(SightLine(track, from, to), profile, 1);
  };
  EXPECT_TRUE(found(100, 130)) << "on the ground";
  EXPECT_FALSE(found(95, 130));
  EXPECT_FALSE(found(130, 99.9));
}

TEST(FresnelClearance, IsTheLeastOfManySamples) {
  Random random(11);
  for (int n = 0; n < 200; ++n) {
    SightTrack track;
    track.curvature = n % 2 ? 6.0 / 7 / 6371000 : 0;
    const double length = 1000 + 50000 * random.unit();
    track.points = {{{0, 0}, 0}, {{1, 0}, length}};
    Profile profile;
    profile.length = length;
    const int count = 2 + n % 5;
    for (int i = 0; i <= count; ++i) {
      const double s = length * i / count;
      profile.vertices.push_back({s, {s / length, 0}, 60 * random.unit(), i > 0});
    }
    const SightLine line(track, 120 + 200 * random.unit(), 120 + 200 * random.unit());
    const double wavelength = wavelengthMetres(100 + 5000 * random.unit());
    const auto found = leastFresnelClearance(line, profile, wavelength);
    ASSERT_TRUE(found);
    double least = 1e300;
    for (int i = 1; i < 20000; ++i) {
      const double s = length * i / 20000;
      least = std::min(least, (line.height(s) - heightAt(profile, s)) / fresnelRadius(wavelength, s, length));
    }
    EXPECT_LE(found->fraction, least + 1e-9 * std::abs(least)) << n;
    EXPECT_GE(found->fraction, least - 1e-4 * (1 + std::abs(least))) << n;
  }
}

}  // namespace
}  // namespace arete
