// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/page_prices.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

using Kind = PagePrices::Kind;

/// Tries as often as told, at what each kind costs.
void tryOften(PagePrices& prices, int times, double small, double large) {
  for (int i = 0; i < times; ++i) {
    const Kind kind = prices.toTry();
    prices.note(kind, kind == Kind::small ? small : large);
  }
}

TEST(PagePrices, BothKindsAreTriedBeforeOneIsChosen) {
  PagePrices prices;
  EXPECT_FALSE(prices.areKnown());
  EXPECT_EQ(prices.cheaper(), Kind::small);
  tryOften(prices, 2, 2, 1);
  EXPECT_TRUE(prices.areKnown());
  EXPECT_EQ(prices.cheaper(), Kind::large);
}

TEST(PagePrices, TheKindThatCostsLessIsChosenAndTheOtherStaysKnown) {
  PagePrices prices;
  tryOften(prices, 100, 1, 4);
  EXPECT_EQ(prices.cheaper(), Kind::small);
  tryOften(prices, 100, 1, 0.1);
  EXPECT_EQ(prices.cheaper(), Kind::large) << "large pages have become cheap";
  tryOften(prices, 100, 0.05, 0.1);
  EXPECT_EQ(prices.cheaper(), Kind::small) << "small ones even cheaper";
}

TEST(PagePrices, LargePagesThatAreDearNowAndThenAreNotChosen) {
  PagePrices prices;
  for (int i = 0; i < 100; ++i) {
    const Kind kind = prices.toTry();
    prices.note(kind, kind == Kind::small ? 1 : i % 3 == 0 ? 4 : 0.1);
    if (i > 60) {
      EXPECT_EQ(prices.cheaper(), Kind::small) << i;
    }
  }
}

TEST(PagePrices, AProgramThatTookTheProcessorOnceDoesNotCountForLong) {
  PagePrices prices;
  tryOften(prices, 10, 1, 0.1);
  while (prices.toTry() != Kind::large) prices.note(Kind::small, 1);
  prices.note(Kind::large, 50);
  EXPECT_EQ(prices.cheaper(), Kind::small);
  tryOften(prices, 32, 1, 0.1);
  EXPECT_EQ(prices.cheaper(), Kind::large);
}

}  // namespace
}  // namespace arete
