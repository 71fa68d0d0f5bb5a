// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/entropy/number_bytes.h"

#include <gtest/gtest.h>

#include <limits>

#include "datasets/random.h"

namespace arete {
namespace {

TEST(NumberBytes, ReadBackToTheEnd) {
  Random random(3);
  std::vector<std::uint64_t> numbers = {0, 127, 128, std::numeric_limits<std::uint64_t>::max()};
  for (int i = 0; i < 500; ++i) numbers.push_back(random.next() >> random.below(64));
  NumberWriter out;
  for (const std::uint64_t n : numbers) out.number(n);
  out.plain(1.5);
  const std::vector<std::byte> bytes = out.take();
  NumberReader in(bytes);
  EXPECT_EQ(in.left(), bytes.size());
  for (const std::uint64_t n : numbers) EXPECT_EQ(in.number(), n);
  EXPECT_EQ(in.plain<double>(), 1.5);
  EXPECT_TRUE(in.isDone());
}

TEST(NumberBytes, AreBadBeyondTheEndAndBeyondALimit) {
  const std::vector<std::byte> bytes(20, std::byte{0x80});
  const std::vector<std::byte> few(3, std::byte{0x80});
  NumberReader endless(few);
  endless.number();
  EXPECT_TRUE(endless.isBad());
  NumberReader wide(bytes);
  wide.number();  // more than 64 bits
  EXPECT_TRUE(wide.isBad());
  NumberWriter out;
  out.number(300);
  const std::vector<std::byte> three = out.take();
  NumberReader in(three);
  EXPECT_EQ(in.number(299), 0u);
  EXPECT_TRUE(in.isBad());
}

}  // namespace
}  // namespace arete
