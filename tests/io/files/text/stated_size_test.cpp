// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/stated_size.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace arete {
namespace {

TEST(StatedSize, IsANumberOrAShareOfTheWhole) {
  struct Case {
    const char* text;
    double of200;
    bool isShare;
  };
  for (const Case& c :
       {Case{"5", 5, false}, Case{"0", 0, false}, Case{"+2.5", 2.5, false}, Case{"1e3", 1000, false},
        Case{"inf", std::numeric_limits<double>::infinity(), false}, Case{"1%", 2, true}, Case{"0%", 0, true},
        Case{"0.5%", 1, true}, Case{"100%", 200, true}, Case{"250%", 500, true}, Case{"12.5 %", 25, true},
        Case{" 3", 3, false}}) {
    const Result<StatedSize> size = parseStatedSize(c.text, "--e");
    ASSERT_TRUE(size) << c.text;
    EXPECT_EQ(size->of(200), c.of200) << c.text;
    EXPECT_EQ(size->isShare, c.isShare) << c.text;
  }
}

TEST(StatedSize, RefusesWhatIsNone) {
  for (const char* text :
       {"", "%", "-1", "-1%", "nan", "inf%", "5m", "5%%", "%5", "1e", "0x10", "five", "5,6"}) {
    const Result<StatedSize> size = parseStatedSize(text, "--e");
    ASSERT_FALSE(size) << text;
    EXPECT_EQ(size.error().code, ErrorCode::usage);
    EXPECT_EQ(size.error().culprit, "--e");
  }
}

TEST(StatedSize, WithAUnitIsInTheUnitOfTheData) {
  const DataUnit feet{0.3048}, unknown{};
  const auto sizes = parseStatedSizes("1,5%, 2m,10 ft,1.5km", "--e", &feet);
  ASSERT_TRUE(sizes);
  EXPECT_EQ((*sizes)[0].of(200), 1);
  EXPECT_EQ((*sizes)[1].of(200), 10);
  EXPECT_DOUBLE_EQ((*sizes)[2].of(200), 2 / 0.3048);
  EXPECT_EQ((*sizes)[2].text, "2m");
  EXPECT_TRUE((*sizes)[2].hasUnit);
  EXPECT_FALSE((*sizes)[0].hasUnit);
  EXPECT_EQ((*sizes)[3].of(200), 10) << "to the bit";
  EXPECT_DOUBLE_EQ((*sizes)[4].of(200), 1500 / 0.3048);
  for (const char* text : {"5%m", "m%", "5m%", "-5m", "infm", "5parsec", "m"})
    EXPECT_FALSE(parseStatedSize(text, "--e", &feet)) << text;
  const auto refused = parseStatedSize("5m", "--e", &unknown);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().culprit, "--e 5m");
  EXPECT_EQ(parseStatedSize("5", "--e", &unknown).value().of(200), 5);
}

TEST(StatedSize, OfAListKeepsItsOrderAndText) {
  const auto sizes = parseStatedSizes("1,5%, 20", "--e");
  ASSERT_TRUE(sizes);
  ASSERT_EQ(sizes->size(), 3u);
  EXPECT_EQ((*sizes)[1].text, "5%");
  EXPECT_EQ((*sizes)[2].text, "20");
  for (const char* text : {"", "1,", ",1", "1,,2", "1;2"})
    EXPECT_FALSE(parseStatedSizes(text, "--e")) << text;
}

}  // namespace
}  // namespace arete
