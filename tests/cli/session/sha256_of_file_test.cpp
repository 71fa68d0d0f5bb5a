// SPDX-License-Identifier: GPL-3.0-or-later
//
// The examples of FIPS 180-4, and the program sha256sum.
#include "cli/session/sha256_of_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>
#include <vector>

namespace arete {
namespace {

namespace fs = std::filesystem;

TEST(Sha256, HasTheValuesOfItsStandard) {
  std::string pattern = (fs::temp_directory_path() / "arete-sha-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  const auto digestOf = [&](std::string_view text) {
    const std::string file = (folder / "file").string();
    std::ofstream(file, std::ios::binary) << text;
    return sha256OfFile(file).value().sha256;
  };
  EXPECT_EQ(digestOf(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digestOf("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digestOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digestOf(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  fs::remove_all(folder);
}

TEST(Sha256, OfAFileIsThatOfSha256sum) {
  std::string pattern = (fs::temp_directory_path() / "arete-sha-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  std::mt19937 random(3);
  for (const std::size_t size : {0, 1, 55, 56, 63, 64, 65, 300'000}) {
    const std::string file = (folder / "file").string();
    std::string text(size, ' ');
    std::ranges::generate(text, [&] { return char(random()); });
    std::ofstream(file, std::ios::binary) << text;
    const auto digest = sha256OfFile(file);
    ASSERT_TRUE(digest) << digest.error().describe();
    EXPECT_EQ(digest->bytes, size);
    EXPECT_TRUE(digest->isStable);
    std::FILE* const other = popen(("sha256sum '" + file + "' 2>/dev/null").c_str(), "r");
    std::string said(64, ' ');
    if (other == nullptr || std::fread(said.data(), 1, 64, other) != 64)
      said = digest->sha256;  // no coreutils
    if (other != nullptr) pclose(other);
    EXPECT_EQ(digest->sha256, said) << size;
  }
  EXPECT_EQ(sha256OfFile((folder / "nowhere").string()).error().code, ErrorCode::notFound);
  EXPECT_EQ(sha256OfFile(folder.string()).error().code, ErrorCode::unreadable);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(sha256OfFile((folder / "pipe").string()).error().code, ErrorCode::unreadable);
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(sha256OfFile((folder / "file").string(), &cancel).error().code, ErrorCode::interrupted);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace arete
