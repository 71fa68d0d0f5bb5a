// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/base64.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>

namespace arete {
namespace {

std::string written(std::string_view bytes, std::size_t part) {
  Base64Writer writer;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += part) writer.add(bytes.substr(at, part), text);
  writer.finish(text);
  return text;
}

TEST(Base64, IsThatOfItsStandard) {
  // The vectors of RFC 4648, section 10.
  for (const auto& [bytes, text] : {std::pair<std::string, std::string>{"", ""},
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(written(bytes, 100), text);
    EXPECT_EQ(fromBase64(text), bytes);
    EXPECT_EQ(fromBase64(text.substr(0, text.find('='))), bytes);
  }
  for (const char* bad : {"Z", "Zg=a", "Zg===", "Zm9v\n", "Zm 9v", "Zm9-", "=", "===="})
    EXPECT_FALSE(fromBase64(bad)) << bad;
}

TEST(Base64, ReturnsWhatWasWrittenInAnyParts) {
  std::mt19937 random(3);
  for (std::size_t size = 0; size < 300; ++size) {
    std::string bytes(size, ' ');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_EQ(fromBase64(written(bytes, 1 + random() % 9)), bytes);
  }
}

}  // namespace
}  // namespace arete
