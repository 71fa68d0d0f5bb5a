// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/file_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "io/io_fixture.h"

namespace arete {
namespace {

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(FileWriter, KeepsEveryByteInOrder) {
  const test::TemporaryFolder folder;
  std::string expected;
  Result<FileWriter> writer = FileWriter::create(folder.file("a.bin"));
  ASSERT_TRUE(writer);
  for (int i = 0; i < 5000; ++i) {
    const std::string piece(static_cast<std::size_t>(i) * 7 % 1000, static_cast<char>('a' + i % 26));
    writer->write(piece);
    putBytes(writer->reserve(sizeof i), i);
    expected += piece + std::string(reinterpret_cast<const char*>(&i), sizeof i);
  }
  const std::string large(3 * FileWriter::kCapacity, 'z');
  writer->write(large);
  expected += large;
  ASSERT_TRUE(writer->finish());
  EXPECT_TRUE(contents(folder.file("a.bin")) == expected);
}

TEST(FileWriter, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "this system has no /dev/full to play the full disk";
  Result<FileWriter> writer = FileWriter::create("/dev/full");
  ASSERT_TRUE(writer);
  writer->write("something");
  const Status status = writer->finish();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::unreadable);
  EXPECT_EQ(status.error().culprit, "/dev/full");
}

TEST(FileWriter, FillsItsBufferToTheLastByte) {
  const test::TemporaryFolder folder;
  // The lengths around the end of the buffer, by write() and by reserve().
  for (const std::size_t first :
       {FileWriter::kCapacity - 1, FileWriter::kCapacity, FileWriter::kCapacity + 1})
    for (const std::size_t second : {std::size_t(0), std::size_t(1), std::size_t(2), FileWriter::kCapacity}) {
      Result<FileWriter> writer = FileWriter::create(folder.file("a.bin"));
      ASSERT_TRUE(writer);
      writer->write(std::string(first, 'a'));
      if (second > 0) std::memset(writer->reserve(second), 'b', second);
      writer->write("c");
      ASSERT_TRUE(writer->finish());
      EXPECT_TRUE(contents(folder.file("a.bin")) == std::string(first, 'a') + std::string(second, 'b') + "c")
          << first << " " << second;
    }
}

TEST(FileWriter, LeavesNothingBehindWithoutFinish) {
  const test::TemporaryFolder folder;
  folder.write("a.bin", "old");
  {
    Result<FileWriter> writer = FileWriter::create(folder.file("a.bin"));
    ASSERT_TRUE(writer);
    writer->write(std::string(2 * FileWriter::kCapacity, 'x'));
    FileWriter moved = std::move(*writer);
    moved.write("y");
  }
  EXPECT_EQ(contents(folder.file("a.bin")), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(FileWriter, SaysThatTheFolderIsMissing) {
  const test::TemporaryFolder folder;
  const Result<FileWriter> writer = FileWriter::create(folder.file("no/a.bin"));
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::notFound);
}

TEST(FileWriter, PutsValuesInTheByteOrderOfTheMachine) {
  char bytes[8] = {};
  char* end = putBytes(putBytes(bytes, std::uint16_t{0x0102}), 1.5F);
  EXPECT_EQ(end - bytes, 6);
  float value = 0;
  std::memcpy(&value, bytes + 2, sizeof value);
  EXPECT_EQ(value, 1.5F);
}

}  // namespace
}  // namespace arete
