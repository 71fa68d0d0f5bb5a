// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/attribute.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arete {
namespace {

TEST(Attribute, HoldsTheExtremesOfEveryTypeExactly) {
  struct Case {
    ScalarType type;
    std::size_t bytes;
    double low, high;
  };
  for (const Case& c :
       {Case{ScalarType::int8, 1, -128, 127}, Case{ScalarType::uint8, 1, 0, 255},
        Case{ScalarType::int16, 2, -32768, 32767}, Case{ScalarType::uint16, 2, 0, 65535},
        Case{ScalarType::int32, 4, -2147483648.0, 2147483647.0}, Case{ScalarType::uint32, 4, 0, 4294967295.0},
        Case{ScalarType::float32, 4, -3.4028234663852886e38, 3.4028234663852886e38},
        Case{ScalarType::float64, 8, -1.7976931348623157e308, 5e-324}}) {
    SCOPED_TRACE(int(c.type));
    Attribute a{.name = "x", .type = c.type, .components = 2};
    a.append(std::vector<double>{c.low, c.high});
    EXPECT_EQ(a.values.size(), 2 * c.bytes);
    EXPECT_EQ(a.numbers(0), (std::vector<double>{c.low, c.high}));
    Attribute copy = emptyLike(a);
    copy.append(a.element(0));
    EXPECT_EQ(copy, a);
  }
}

TEST(Attribute, RoundsAndHoldsIntegersWithinTheirRange) {
  Attribute a{.name = "x", .type = ScalarType::uint8};
  for (const double number : {-1.0, 0.4, 0.6, 254.5, 1e300, std::nan("")})
    a.append(std::vector<double>{number});
  const std::vector<double> expected = {0, 0, 1, 255, 255, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(a.numbers(i)[0], expected[i]) << i;
}

TEST(Attribute, KeepsTheBitsOfNaN) {
  Attribute a{.name = "x", .type = ScalarType::float32};
  const std::uint32_t payload = 0x7fc12345;
  std::array<std::byte, 4> bytes;
  std::memcpy(bytes.data(), &payload, 4);
  a.append(std::span<const std::byte>(bytes));
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), a.element(0).begin()));
}

TEST(Attribute, ItsSizeIsChecked) {
  Attribute a{.name = "x", .type = ScalarType::float64};
  a.append(std::vector<double>{1});
  EXPECT_TRUE(checkAttribute(a, 1));
  EXPECT_FALSE(checkAttribute(a, 2));
  a.values.pop_back();
  EXPECT_FALSE(checkAttribute(a, 1));
}

}  // namespace
}  // namespace arete
