// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text_decoder.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace arete {
namespace {

/// By hand, from code points.
std::string utf16(std::u16string_view text, bool littleEndian, bool mark) {
  std::string bytes;
  const auto put = [&](unsigned unit) {
    const char high = char(unit >> 8), low = char(unit & 0xFF);
    bytes += littleEndian ? low : high;
    bytes += littleEndian ? high : low;
  };
  if (mark) put(0xFEFF);
  for (const char16_t unit : text) put(unit);
  return bytes;
}

std::string decoded(std::string_view bytes, std::size_t part) {
  TextDecoder decoder;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += part) decoder.decode(bytes.substr(at, part), text);
  decoder.finish(text);
  return text;
}

TEST(TextDecoder, ReadsUtf16InEitherOrderWithAMarkOrWithout) {
  const std::u16string text = u"v 1 2 3\r\n# caf\u00e9 \u2302 \U0001F3D4\r\n";
  const std::string expected = "v 1 2 3\r\n# caf\u00e9 \u2302 \U0001F3D4\r\n";
  for (const bool little : {true, false})
    for (const bool mark : {true, false}) {
      const std::string bytes = utf16(text, little, mark);
      EXPECT_TRUE(TextDecoder::isNeededFor(bytes));
      EXPECT_EQ(decoded(bytes, bytes.size()), expected) << little << mark;
      // In parts that end within a code unit, and within a pair.
      for (const std::size_t part : {std::size_t(11), std::size_t(64), std::size_t(7)})
        EXPECT_EQ(decoded(bytes, part), expected) << little << mark << part;
    }
}

TEST(TextDecoder, TakesReturnsForLineEndsWhereThereIsNoLineFeed) {
  EXPECT_EQ(decoded("a\rb\r\rc", 100), "a\nb\n\nc");
  EXPECT_EQ(decoded("a\rb\r\rc", 3), "a\nb\n\nc");
  EXPECT_EQ(decoded(utf16(u"a b\rc d\r", true, false), 100), "a b\nc d\n");
  for (const std::string same : {"a\r\nb\rc", "a\nb", "", "a", "\xC3\xA9"}) {
    EXPECT_FALSE(TextDecoder::isNeededFor(same)) << same;
    EXPECT_EQ(decoded(same, 100), same);
  }
  EXPECT_EQ(decoded("\xEF\xBB\xBFx", 100), "x");
}

TEST(TextDecoder, ReplacesHalvesOfCharacters) {
  EXPECT_EQ(decoded(utf16(u"a", true, true) + "b", 100), "a\uFFFD");
  EXPECT_EQ(decoded(utf16(std::u16string{u'a', 0xD800, u'b'}, true, true), 100), "a\uFFFDb");
  EXPECT_EQ(decoded(utf16(std::u16string{u'a', 0xDC00, u'b', 0xD801}, false, true), 100), "a\uFFFDb\uFFFD");
  EXPECT_FALSE(TextDecoder::isNeededFor(std::string(64, '\0')));
}

}  // namespace
}  // namespace arete
