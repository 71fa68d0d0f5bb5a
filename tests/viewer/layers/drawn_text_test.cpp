// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/drawn_text.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(DrawnText, TellsScriptsThatTheFontHasFromOthers) {
  for (const char* text :
       {"", "Mont \xC3\x89t\xC3\xA9", "\xCE\x8C\xCE\xBB\xCF\x85\xCE\xBC\xCF\x80\xCE\xBF\xCF\x82",
        "\xD0\x94\xD1\x8B\xD1\x85-\xD0\xA2\xD0\xB0\xD1\x83", "a\xE2\x80\xA6", "\xE2\x96\xB2 2040 m"})
    EXPECT_TRUE(isDrawnAsWritten(text)) << text;
  for (const char* text :
       {"\xE5\xAF\x8C\xE5\xA3\xAB\xE5\xB1\xB1", "\xD7\x94\xD7\xA8", "\xD8\xAC\xD8\xA8\xD9\x84",
        "K2 \xE0\xA4\x95\xE0\xA5\x87", "\xED\x95\x9C\xEB\x9D\xBC", "\xE0\xB8\x94\xE0\xB8\xAD\xE0\xB8\xA2",
        "\xF0\xA0\x80\x80"})
    EXPECT_FALSE(isDrawnAsWritten(text)) << text;
}

}  // namespace
}  // namespace arete
