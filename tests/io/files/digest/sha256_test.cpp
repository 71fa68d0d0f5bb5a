// SPDX-License-Identifier: GPL-3.0-or-later
//
// The examples of FIPS 180-4, the program sha256sum, and the two forms against each other.
#include "io/files/digest/sha256.h"

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

#include "io/files/digest/sha256_of_file.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

std::string digestOf(std::string_view text, bool plain) {
  Sha256 digest;
  if (plain) digest.useNoInstructions();
  digest.add(std::as_bytes(std::span(text)));
  return digest.hex();
}

TEST(Sha256, HasTheValuesOfItsStandard) {
  for (const bool plain : {false, true}) {
    EXPECT_EQ(digestOf("", plain), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(digestOf("abc", plain), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(digestOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", plain),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(digestOf(std::string(1'000'000, 'a'), plain),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  }
}

TEST(Sha256, DoesNotDependOnThePiecesNorOnTheProcessor) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bytes(random() % 400);
    for (std::byte& b : bytes) b = std::byte(random() & 0xff);
    Sha256 whole, pieces;
    pieces.useNoInstructions();
    whole.add(bytes);
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = std::min<std::size_t>(bytes.size() - at, 1 + random() % 130);
      pieces.add(std::span(bytes).subspan(at, size));
      at += size;
    }
    ASSERT_EQ(whole.hex(), pieces.hex()) << "seed 7, text " << i << " of " << bytes.size() << " bytes";
  }
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
