// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/warning.h"

#include <gtest/gtest.h>

#include <set>

namespace arete {
namespace {

TEST(Warning, CodesHaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(WarningCode::display); ++code)
    EXPECT_TRUE(names.insert(nameOf(static_cast<WarningCode>(code))).second) << code;
  EXPECT_FALSE(names.contains("unknown"));
}

TEST(Warning, KeepsItsCodeBehindAPrefix) {
  const Warning warning = Warning{WarningCode::unit, "heights are in feet"}.behind("a.tif: ");
  EXPECT_EQ(warning, (Warning{WarningCode::unit, "a.tif: heights are in feet"}));
  const std::string& sentence = warning;
  EXPECT_EQ(sentence, "a.tif: heights are in feet");
}

}  // namespace
}  // namespace arete
