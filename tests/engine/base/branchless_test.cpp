// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/branchless.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace arete {
namespace {

TEST(StoreIf, StoresOnlyIfTheConditionHolds) {
  std::uint8_t byte = 5;
  storeIf(false, byte, 7);
  EXPECT_EQ(byte, 5);
  storeIf(true, byte, 7);
  EXPECT_EQ(byte, 7);
  float number = 1;
  storeIf(false, number, 2);
  EXPECT_EQ(number, 1);
  storeIf(true, number, 2);
  EXPECT_EQ(number, 2);
}

}  // namespace
}  // namespace arete
