// SPDX-License-Identifier: GPL-3.0-or-later
// The flight that is being made: keys, playing, files.
#include "viewer/window/flight_deck.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/camera_models.h"

namespace arete {
namespace {

class FlightDecks : public ::testing::Test {
 protected:
  const TerrainModel& model_ = test::cameraModels()[0].model;
  CameraSpace space_{model_};
  FlightDeck deck_{space_, 100};

  Camera cameraAt(double x, double azimuth = 0) const {
    Camera camera;
    camera.azimuthDegrees = azimuth;
    return space_.at(camera, {x, 0, 1000});
  }
};

TEST_F(FlightDecks, HaveNothingToPlayBeforeTheSecondKey) {
  EXPECT_FALSE(deck_.play());
  deck_.addKey(cameraAt(0));
  EXPECT_FALSE(deck_.play());
  EXPECT_FALSE(deck_.isPlaying());
  EXPECT_FALSE(deck_.advance(1));
  deck_.addKey(cameraAt(500));
  EXPECT_TRUE(deck_.play());
  EXPECT_TRUE(deck_.isPlaying());
}

TEST_F(FlightDecks, FlyAtTheUsualSpeedUnlessThePlanHasOne) {
  deck_.addKey(cameraAt(0));
  deck_.addKey(cameraAt(1000));
  EXPECT_EQ(deck_.plan().speed, 100);
  FlightPlan plan = deck_.plan();
  plan.speed.reset();
  plan.duration = 7;
  deck_.setPlan(plan);
  deck_.addKey(cameraAt(2000));
  EXPECT_FALSE(deck_.plan().speed) << "a plan with a duration keeps it";
  ASSERT_TRUE(deck_.play());
  EXPECT_NEAR(deck_.duration(), 7, 1e-9);
}

TEST_F(FlightDecks, PlayFromTheFirstKeyToTheLastAndStop) {
  deck_.addKey(cameraAt(0));
  deck_.addKey(cameraAt(1000, 90));
  ASSERT_TRUE(deck_.play());
  const double duration = deck_.duration();
  const auto first = deck_.advance(0);
  ASSERT_TRUE(first);
  EXPECT_NEAR(space_.position(*first).x, 0, 1e-6);
  const auto half = deck_.advance(duration / 2);
  ASSERT_TRUE(half);
  EXPECT_NEAR(deck_.seconds(), duration / 2, 1e-9);
  const auto last = deck_.advance(duration);
  ASSERT_TRUE(last);
  EXPECT_NEAR(space_.position(*last).x, 1000, 1e-6);
  EXPECT_NEAR(last->azimuthDegrees, 90, 1e-6);
  EXPECT_FALSE(deck_.isPlaying());
  EXPECT_FALSE(deck_.advance(1));
}

TEST_F(FlightDecks, StopWhenTheKeysChange) {
  deck_.addKey(cameraAt(0));
  deck_.addKey(cameraAt(1000));
  deck_.addKey(cameraAt(2000));
  ASSERT_TRUE(deck_.play());
  deck_.removeKey(1);
  EXPECT_FALSE(deck_.isPlaying());
  ASSERT_EQ(deck_.plan().keys.size(), 2u);
  EXPECT_NEAR(space_.position(deck_.plan().keys[1]).x, 2000, 1e-6);
  deck_.clear();
  EXPECT_TRUE(deck_.plan().keys.empty());
  EXPECT_FALSE(deck_.plan().speed);
}

TEST_F(FlightDecks, KeepAFlightInAFile) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("arete_deck_" + std::to_string(::getpid()) + ".json");
  EXPECT_FALSE(deck_.save(file, model_.georeference)) << "there is no key yet";
  EXPECT_FALSE(std::filesystem::exists(file));
  deck_.addKey(cameraAt(0));
  deck_.addKey(cameraAt(1000, 45));
  ASSERT_TRUE(deck_.save(file, model_.georeference));
  FlightDeck other(space_, 1);
  ASSERT_TRUE(other.load(file, model_.georeference));
  ASSERT_EQ(other.plan().keys.size(), 2u);
  EXPECT_EQ(other.plan().keys[1].azimuthDegrees, 45);
  EXPECT_EQ(other.plan().speed, 100);
  std::filesystem::remove(file);
  EXPECT_FALSE(other.load(file, model_.georeference));
  EXPECT_EQ(other.plan().keys.size(), 2u) << "a file that cannot be read changes nothing";
}

}  // namespace
}  // namespace arete
