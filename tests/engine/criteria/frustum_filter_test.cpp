// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is the frustum in double precision, ball by ball.
#include "engine/criteria/frustum_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Setting {
  View view;
  double errorPerReach, outsideError;

  explicit Setting(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double far = random() % 3 == 0 ? 5e6 : 0;  // as in projected coordinates
    view.eye = {far + 1000 * unit(random), far + 1000 * unit(random), 100 + 1000 * unit(random)};
    view.forward = {unit(random) - 0.5, unit(random) - 0.5, -0.5 * unit(random)};
    view.verticalFieldOfView = 0.2 + 2 * unit(random);
    view.widthPixels = 200 + 2000 * unit(random);
    if (random() % 2) view.nearDistance = 10 * unit(random);
    if (random() % 2) view.farDistance = 100 + 2000 * unit(random);
    errorPerReach = std::pow(10, -4 + 3 * unit(random));
    outsideError = random() % 2 ? kInfinity : 20 * unit(random);
  }
  double allowed(const Sphere& s) const {
    const Frustum frustum(view);
    if (!frustum.mayMeet(s)) return outsideError;
    const Vec3 centre = frustum.toView({s.x, s.y, s.z});
    return std::min(errorPerReach * frustum.reach(centre, s.radius, centre.z - s.radius), outsideError);
  }
};

struct Balls {
  std::vector<Sphere> balls;
  std::vector<float> errors;

  Balls(const Setting& setting, std::size_t count, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const double range = std::pow(10, 1 + 2 * unit(random));
      balls.push_back({static_cast<float>(setting.view.eye.x + range * unit(random)),
                       static_cast<float>(setting.view.eye.y + range * unit(random)),
                       static_cast<float>(setting.view.eye.z + range * unit(random)),
                       static_cast<float>(range * std::pow(10, -1.5 + 1.5 * unit(random)))});
      const double allowed = setting.allowed(balls.back());
      // Half of the errors are near the allowed one, where verdicts are close.
      errors.push_back(
          static_cast<float>(std::isfinite(allowed) && i % 2 == 0
                                 ? allowed * (1 + std::pow(10, -4 + 3 * unit(random)) * unit(random))
                                 : std::pow(10, 2 * unit(random))));
    }
  }
};

TEST(FrustumFilter, NeverContradictsTheFrustumInDouble) {
  std::mt19937_64 random(1);
  std::size_t tested = 0, unsure = 0;
  for (int round = 0; round < 3000; ++round) {
    const Setting setting(random);
    const FrustumFilter filter(setting.view, setting.errorPerReach, setting.outsideError);
    const Balls b(setting, 1 + random() % 64, random);
    const FrustumFilter::Verdicts verdicts = filter.test(b.balls, b.errors);
    EXPECT_EQ(verdicts.exceeds & verdicts.unsure, 0u);
    for (std::size_t i = 0; i < 64; ++i) {
      const bool exceeds = (verdicts.exceeds >> i & 1) != 0, isUnsure = (verdicts.unsure >> i & 1) != 0;
      if (i >= b.balls.size()) {
        EXPECT_FALSE(exceeds || isUnsure);
        continue;
      }
      ++tested;
      unsure += isUnsure ? 1 : 0;
      if (isUnsure) continue;
      EXPECT_EQ(exceeds, b.errors[i] > setting.allowed(b.balls[i])) << "round " << round << " ball " << i;
    }
  }
  std::printf("balls: %zu, left to double precision: %zu\n", tested, unsure);
  EXPECT_LT(unsure, tested / 2);
}

TEST(FrustumFilter, HasTheSameVerdictsWithAndWithoutMotion) {
  std::mt19937_64 random(2);
  std::size_t positive = 0;
  for (int round = 0; round < 1000; ++round) {
    const Setting setting(random);
    const FrustumFilter filter(setting.view, setting.errorPerReach, setting.outsideError);
    const Balls b(setting, 1 + random() % 64, random);
    std::vector<float> units(b.balls.size(), -1);
    const FrustumFilter::Verdicts plain = filter.test(b.balls, b.errors),
                                  moving = filter.testFor(b.balls, b.errors, {1, 0.01, 0.01}, units);
    EXPECT_EQ(plain.exceeds | plain.unsure, (plain.exceeds | plain.unsure) | moving.exceeds);
    for (std::size_t i = 0; i < units.size(); ++i) {
      EXPECT_GE(units[i], 0);
      positive += units[i] > 0 ? 1 : 0;
      if ((moving.unsure >> i & 1) != 0) {
        EXPECT_EQ(units[i], 0);
      } else {
        EXPECT_EQ((moving.exceeds >> i & 1) != 0, b.errors[i] > setting.allowed(b.balls[i]));
      }
    }
  }
  EXPECT_GT(positive, 1000u);
}

TEST(FrustumFilter, HoldsLongerAtASlowerRate) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 200; ++round) {
    const Setting setting(random);
    const FrustumFilter filter(setting.view, setting.errorPerReach, setting.outsideError);
    const Balls b(setting, 64, random);
    std::vector<float> slow(64), fast(64);
    filter.testFor(b.balls, b.errors, {1, 0.01, 0.01}, slow);
    filter.testFor(b.balls, b.errors, {2, 0.02, 0.02}, fast);
    for (int i = 0; i < 64; ++i) EXPECT_GE(slow[i], fast[i] * (1 - 1e-4f));
  }
}

}  // namespace
}  // namespace arete
