// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models in GDAL's file systems: the same as in a plain file.
#include "io/query/extract/model_file.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/http_server.h"
#include "io/written_amt.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::built;
using test::expectSame;
using test::TemporaryFolder;
using test::writtenTo;

Result<TerrainModel> read(const std::string& path) {
  ARETE_TRY(const AmtFile file, openTerrainFile(path));
  return file.read();
}

TEST(ModelFile, IsReadFromMemoryArchivesAndPartsOfFiles) {
  const TemporaryFolder folder;
  for (const bool isPacked : {false, true}) {
    const std::string path = writtenTo(folder, isPacked, true, 60, 50);
    std::ifstream from(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(from)), {});
    const auto put = [&](const std::string& name, const std::string& content) {
      VSILFILE* const file = VSIFOpenL(name.c_str(), "wb");
      ASSERT_NE(file, nullptr) << name;
      EXPECT_EQ(VSIFWriteL(content.data(), 1, content.size(), file), content.size());
      EXPECT_EQ(VSIFCloseL(file), 0);
    };
    put("/vsimem/copied_test.amt", bytes);
    put("/vsigzip/" + folder.file(isPacked ? "packed.gz" : "plain.gz"), bytes);
    put("/vsizip/" + folder.file("a.zip") + "/in/a.amt", bytes);
    put(folder.file("behind.bin"), "some bytes before" + bytes + "and after");
    const TerrainModel wanted = built(read(path));
    const std::string names[] = {
        "/vsimem/copied_test.amt", "/vsigzip/" + folder.file(isPacked ? "packed.gz" : "plain.gz"),
        "/vsizip/" + folder.file("a.zip") + "/in/a.amt",
        fmt::format("/vsisubfile/17_{},{}", bytes.size(), folder.file("behind.bin"))};
    for (const std::string& name : names) {
      SCOPED_TRACE(name);
      const auto model = read(name);
      ASSERT_TRUE(model) << model.error().describe();
      expectSame(wanted, *model);
      EXPECT_FALSE(openModelFile(name)->isOfSurface());
    }
    // What is damaged is said as of a plain file.
    put("/vsimem/copied_test.amt", bytes.substr(0, bytes.size() / 2));
    const auto cut = read("/vsimem/copied_test.amt");
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::corrupt);
    EXPECT_NE(cut.error().message.find("cut short"), std::string::npos);
    put("/vsimem/copied_test.amt", bytes + "x");
    EXPECT_NE(read("/vsimem/copied_test.amt").error().message.find("1 byte more"), std::string::npos);
    put("/vsimem/copied_test.amt",
        "a text that is no model, but longer than a header of one, which has 64 bytes");
    EXPECT_EQ(read("/vsimem/copied_test.amt").error().message, "is not an .amt file");
    put("/vsimem/copied_test.amt", "");
    EXPECT_EQ(read("/vsimem/copied_test.amt").error().message, "is empty");
    VSIUnlink("/vsimem/copied_test.amt");
    EXPECT_EQ(read("/vsimem/copied_test.amt").error().code, ErrorCode::notFound);
    EXPECT_EQ(read("/vsizip/" + folder.file("a.zip") + "/in/none.amt").error().code, ErrorCode::notFound);
    fs::remove(folder.file("a.zip"));
  }
}

TEST(ModelFile, IsReadFromAServerThatGivesAllOfIt) {
  const TemporaryFolder folder;
  const std::string path = writtenTo(folder, false, true, 200, 200);
  std::ifstream from(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(from)), {});
  ASSERT_GT(bytes.size(), std::size_t(1) << 18) << "more than one piece";
  const TerrainModel wanted = built(read(path));
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "0");
  for (const std::string kind : {"good", "short", "replaced"})
    for (const std::string prefix : {"", "/vsicurl/"}) {
      const test::HttpServer server({{"a.amt", bytes}}, [&](const std::string&, int number) {
        test::HttpFault fault;
        if (number < 2) return fault;
        fault.isShort = kind == "short";
        if (kind == "replaced") fault.tag = "\"two\"";
        return fault;
      });
      const std::string name = prefix + server.address("a.amt");
      const auto model = read(name);
      ASSERT_EQ(model.has_value(), kind == "good") << kind << (model ? "" : model.error().describe());
      if (model) {
        expectSame(wanted, *model);
      } else {
        EXPECT_EQ(model.error().culprit, name);
        EXPECT_NE(model.error().message.find("127.0.0.1"), std::string::npos) << model.error().message;
      }
    }
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
}

}  // namespace
}  // namespace arete
