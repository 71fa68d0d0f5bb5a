// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/turn_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace arete {
namespace {

/// Two triangles of the plan with an edge from 0 to 1, and a third beside them.
struct Sheet {
  std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {1, 0, 3}, {1, 4, 2}};
  std::vector<Vec3> places = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {2, 0.5, 0}};
  std::vector<std::uint8_t> stays = std::vector<std::uint8_t>(5, 0);
};

TEST(TurnGuard, LetsSmallTurnsPass) {
  Sheet sheet;
  const TurnGuard guard(sheet.triangles, sheet.places);
  sheet.places[2].z = 1;
  EXPECT_FALSE(guard.mark(sheet.places, sheet.stays));
}

TEST(TurnGuard, HoldsTheCornersOfATriangleThatTurnsOverAndOfTheOneItLiesOnThen) {
  Sheet sheet;
  const TurnGuard guard(sheet.triangles, sheet.places);
  sheet.places[3] = {0.5, 0.5, 0};
  EXPECT_TRUE(guard.mark(sheet.places, sheet.stays));
  EXPECT_EQ(sheet.stays, (std::vector<std::uint8_t>{1, 1, 1, 1, 0}));
  EXPECT_FALSE(guard.mark(sheet.places, sheet.stays)) << "nothing new";
}

TEST(TurnGuard, HoldsTheCornersAtAnEdgeThatBecomesAFold) {
  Sheet sheet;
  sheet.triangles.pop_back();
  const auto bend = [&](double degrees) {
    const double angle = degrees / 180 * std::numbers::pi;
    sheet.places[2] = {0.5, std::cos(angle), std::sin(angle)};
    sheet.places[3] = {0.5, -std::cos(angle), std::sin(angle)};
  };
  bend(40);
  const TurnGuard guard(sheet.triangles, sheet.places);
  bend(59);
  EXPECT_FALSE(guard.mark(sheet.places, sheet.stays));
  bend(61);
  EXPECT_TRUE(guard.mark(sheet.places, sheet.stays));
  EXPECT_EQ(sheet.stays, (std::vector<std::uint8_t>{1, 1, 1, 1, 0}));
}

TEST(TurnGuard, LetsAFoldBeThatWasThere) {
  Sheet sheet;
  sheet.triangles.pop_back();
  sheet.places[3] = {0.5, 0.9, 0.1};
  const TurnGuard guard(sheet.triangles, sheet.places);
  sheet.places[3] = {0.5, 0.9, 0.11};
  EXPECT_FALSE(guard.mark(sheet.places, sheet.stays));
}

TEST(TurnGuard, HoldsATriangleThatLosesItsArea) {
  Sheet sheet;
  const TurnGuard guard(sheet.triangles, sheet.places);
  sheet.places[4] = sheet.places[2];
  EXPECT_TRUE(guard.mark(sheet.places, sheet.stays));
  EXPECT_EQ(sheet.stays, (std::vector<std::uint8_t>{0, 1, 1, 0, 1}));
}

}  // namespace
}  // namespace arete
