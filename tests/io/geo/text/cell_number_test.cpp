// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/text/cell_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "io/geo/text/separator.h"

namespace arete {
namespace {

using Kind = CellNumber::Kind;

TEST(CellNumber, ReadsEveryWayToWriteANumber) {
  for (const auto& [text, value] : {std::pair<const char*, double>{"1.5", 1.5},
                                    {"+1.5", 1.5},
                                    {"-1e3", -1000},
                                    {".5", 0.5},
                                    {"5.", 5},
                                    {"1,5", 1.5},
                                    {"-1,5e2", -150},

                                    {"1.5D+03", 1500},
                                    {"1.5d-1", 0.15},
                                    {"1,5D1", 15},
                                    {"0D0", 0},
                                    {"1,234", 1.234}}) {
    const CellNumber number = readCell(text);
    EXPECT_EQ(number.kind, Kind::number) << text;
    EXPECT_EQ(number.value, value) << text;
    EXPECT_EQ(number.hasDecimalComma, std::string(text).find(',') != std::string::npos) << text;
  }
  for (const char* text : {"", "nan", "NaN", "-nan", "NAN", "nan(ind)", "-nan(ind)", "NA", "n/a", "NULL",
                           "None", "-", "--", "1.#QNAN", "-1.#IND"})
    EXPECT_EQ(readCell(text).kind, Kind::missing) << text;
  for (const char* text :
       {"x",  "1.5.2", "1.234,5", "1,234.5", "1,2,3", "1,",   ",",   "1 234", "1'234", "D",   "D5",
        "1D", "1DD2",  "+-1",     "1e",      "0x10",  "1,5,", "***", "---",   "--nan", "1,-5"})
    EXPECT_EQ(readCell(text).kind, Kind::notANumber) << text;
  EXPECT_TRUE(std::isinf(readCell("inf").value));
  for (const char* text : {"1,234", "-12,345", "123,456"}) EXPECT_TRUE(readCell(text).mayBeGrouped) << text;
  for (const char* text : {"1,23", "1,2345", "1234,567", "1,2e3"})
    EXPECT_FALSE(readCell(text).mayBeGrouped) << text;
}

TEST(CellNumber, SaysWhyATextIsNone) {
  EXPECT_EQ(whyNotANumber("five"), "is not a number");
  EXPECT_NE(whyNotANumber("1.234,5").find("a point and a comma"), std::string::npos);
  EXPECT_NE(whyNotANumber("1,234,567").find("several commas"), std::string::npos);
  EXPECT_NE(whyNotANumber("1 234").find("grouped"), std::string::npos);
}

TEST(Separator, IsFoundInTheFirstRecord) {
  for (const auto& [line, separator] : {std::pair<const char*, char>{"1,2,3", ','},
                                        {"1;2;3", ';'},
                                        {"1,5;2,5;3", ';'},
                                        {"1\t2\t3", '\t'},
                                        {"1,5\t2,5\t3", '\t'},
                                        {"1|2|3", '|'},
                                        {"1,5|2,5|3,5", '|'},
                                        {"1 2 3", ' '},
                                        {"1,5 2,5 3,5", ' '},
                                        {"1, 2, 3", ','},
                                        {"1 ,2 ,3", ','},
                                        {"x,y,z", ','},
                                        {"x y z", ' '},
                                        {"x|y|z", '|'},
                                        {"a, b c, d", ','},
                                        {"1 2 3 | a", ' '},
                                        {"1,2", ','},
                                        {"1,2,3 4", ','},
                                        {"a|b,1,2", ','},
                                        {"1\t2\ta, b", ','}})
    EXPECT_EQ(separatorOf(line), separator) << line;
}

}  // namespace
}  // namespace arete
