// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/copied_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

#include "io/io_fixture.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class CopiedFiles : public ::testing::Test {
 protected:
  std::string written(std::size_t size, unsigned seed) const {
    std::mt19937 random(seed);
    std::string bytes(size, ' ');
    for (char& c : bytes) c = static_cast<char>(random());
    std::ofstream(path(), std::ios::binary) << bytes;
    return bytes;
  }
  std::string path() const { return folder_.file("bytes"); }
  static bool isAt(const CopiedFile& file, const std::string& bytes, std::size_t begin, std::size_t size) {
    return std::string_view(reinterpret_cast<const char*>(file.bytes().data()) + begin, size) ==
           std::string_view(bytes).substr(begin, size);
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(CopiedFiles, HaveTheBytesOfTheFileWhereTheyAreLoaded) {
  for (const std::size_t size : {1u, 100u, 65535u, 65536u, 65537u, 300000u, 1000001u})
    for (unsigned seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(testing::Message() << "size " << size << ", seed " << seed);
      const std::string bytes = written(size, seed);
      const auto file = CopiedFile::open(path());
      ASSERT_TRUE(file);
      ASSERT_EQ((*file)->bytes().size(), size);
      std::mt19937 random(seed);
      for (int part = 0; part < 10; ++part) {
        const std::size_t begin = random() % size, length = random() % (size - begin) + 1;
        ASSERT_TRUE((*file)->load((*file)->bytes().subspan(begin, length)));
        ASSERT_TRUE(isAt(**file, bytes, begin, length));
      }
      EXPECT_FALSE((*file)->problem());
    }
}

TEST_F(CopiedFiles, AreReadByManyThreads) {
  const std::string bytes = written(2000000, 5);
  const auto file = CopiedFile::open(path());
  ASSERT_TRUE(file);
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (int part = 0; part < 50; ++part) {
        const std::size_t begin = random() % 1900000;
        EXPECT_TRUE((*file)->load((*file)->bytes().subspan(begin, 90000)));
        EXPECT_TRUE(isAt(**file, bytes, begin, 90000));
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST_F(CopiedFiles, ThatAreChangedWhileTheyAreOpenAreAnErrorAndKeepWhatWasRead) {
  struct Change {
    const char* name;
    void (*make)(const std::string&);
  };
  const Change changes[] = {
      {"to nothing", [](const std::string& p) { fs::resize_file(p, 0); }},
      {"to 100 bytes", [](const std::string& p) { fs::resize_file(p, 100); }},
      {"within the last block", [](const std::string& p) { fs::resize_file(p, 299999); }},
      {"longer", [](const std::string& p) { fs::resize_file(p, 400000); }},
      {"other bytes of the same size",
       [](const std::string& p) { std::ofstream(p, std::ios::binary) << std::string(300000, 'x'); }},
      {"one byte",
       [](const std::string& p) {
         std::fstream file(p, std::ios::binary | std::ios::in | std::ios::out);
         file.seekp(250000);
         file.put('x');
       }},
  };
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    const std::string bytes = written(300000, 9);
    const auto file = CopiedFile::open(path());
    ASSERT_TRUE(file);
    ASSERT_TRUE((*file)->load((*file)->bytes().first(10)));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // a tick of the clock of the file system
    change.make(path());
    EXPECT_TRUE((*file)->load((*file)->bytes().first(10)));
    EXPECT_FALSE((*file)->load((*file)->bytes().last(10)));
    ASSERT_TRUE((*file)->problem());
    EXPECT_EQ((*file)->problem()->code, ErrorCode::unreadable);
    EXPECT_EQ((*file)->problem()->culprit, path());
    EXPECT_NE((*file)->problem()->message.find("while it was open"), std::string::npos);
    EXPECT_TRUE(isAt(**file, bytes, 0, 60000));
  }
}

TEST_F(CopiedFiles, ThatAreReplacedByRenamingStayReadable) {
  const std::string bytes = written(300000, 11);
  const auto file = CopiedFile::open(path());
  ASSERT_TRUE(file);
  std::ofstream(path() + ".new") << "other";
  fs::rename(path() + ".new", path());
  EXPECT_TRUE((*file)->load((*file)->bytes()));
  EXPECT_TRUE(isAt(**file, bytes, 0, 300000));
  fs::remove(path());
  EXPECT_TRUE((*file)->load((*file)->bytes()));
}

TEST_F(CopiedFiles, AreNeitherFoldersNorEmptyNorMissing) {
  EXPECT_EQ(CopiedFile::open(path() + ".none").error().code, ErrorCode::notFound);
  EXPECT_EQ(CopiedFile::open("/tmp").error().code, ErrorCode::unreadable);
  EXPECT_EQ(CopiedFile::open("/dev/null").error().code, ErrorCode::unreadable);
  std::ofstream(path()).flush();
  EXPECT_EQ(CopiedFile::open(path()).error().code, ErrorCode::unreadable);
}

}  // namespace
}  // namespace arete
