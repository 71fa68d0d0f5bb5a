// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are cut short, altered, or made to do harm: each is refused with a sentence, and none crashes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "engine/base/counted.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::hills;
using test::readAll;
using test::TemporaryFolder;
using test::tinyModel;
using test::writeAll;

constexpr std::uint32_t kNone = MultiTriangulation::kNone;

std::string tinyBytes() {
  const TemporaryFolder folder;
  EXPECT_TRUE(writeAmt(folder.file("tiny.amt"), tinyModel()));
  return readAll(folder.file("tiny.amt"));
}

/// What loading a file of these bytes says; empty if nothing is wrong.
std::string refusalOf(const TemporaryFolder& folder, const std::string& bytes,
                      AmtVerify verify = AmtVerify::all, int threads = 0) {
  const std::string path = folder.file("changed.amt");
  writeAll(path, bytes);
  RunContext context;
  context.threads = threads;
  const Result<TerrainModel> model = loadAmt(path, {verify, {}}, context);
  if (model) return {};
  EXPECT_EQ(model.error().culprit, path);
  return model.error().message;
}

/// Sealed bytes are refused, with a sentence that says this.
void expectRefused(AmtBytes& bytes, const std::string& reason, AmtVerify verify = AmtVerify::indices) {
  const TemporaryFolder folder;
  bytes.seal();
  const std::string message = refusalOf(folder, bytes.bytes(), verify);
  EXPECT_NE(message.find(reason), std::string::npos) << "'" << message << "' instead of '" << reason << "'";
  EXPECT_EQ(refusalOf(folder, bytes.bytes(), verify, 1), message);
}

TEST(HostileAmt, IsRefusedWhereverItIsCutShort) {
  const TemporaryFolder folder;
  const std::string whole = tinyBytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string message = refusalOf(folder, whole.substr(0, size));
    ASSERT_FALSE(message.empty()) << size;
    if (size >= 64)
      ASSERT_EQ(message, fmt::format("is cut short: {} of its {} bytes {} missing", whole.size() - size,
                                     whole.size(), whole.size() - size == 1 ? "is" : "are"));
    else if (size >= 1)
      ASSERT_EQ(message,
                fmt::format("is cut short: its {} bytes are {} too few for the header", size, 64 - size));
    else
      ASSERT_EQ(message, "is empty");
  }
  EXPECT_EQ(refusalOf(folder, whole + std::string(64, '\0')),
            fmt::format("has 64 bytes more than the {} it was written with", whole.size()));
}

TEST(HostileAmt, IsRefusedWhicheverByteIsChanged) {
  const TemporaryFolder folder;
  std::string bytes = tinyBytes();
  ASSERT_EQ(refusalOf(folder, bytes), "");
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      bytes[i] = static_cast<char>(bytes[i] ^ flip);
      ASSERT_NE(refusalOf(folder, bytes), "") << "byte " << i;
      bytes[i] = static_cast<char>(bytes[i] ^ flip);
    }
}

TEST(HostileAmt, NamesTheChunkThatWasAltered) {
  const TemporaryFolder folder;
  AmtBytes bytes(tinyBytes());
  bytes.array<std::uint16_t>(amt_tag::kError)[3] = 77;
  EXPECT_EQ(refusalOf(folder, bytes.bytes()), "has been altered: the checksum of chunk ERRR does not match");
  EXPECT_EQ(refusalOf(folder, bytes.bytes(), AmtVerify::indices), "");  // an error is no index
}

TEST(HostileAmt, IsToldFromOtherFilesAndOtherVersions) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusalOf(folder, "ply\nformat ascii 1.0\n"), "is not an .amt file");
  EXPECT_EQ(refusalOf(folder, "\x89PNG\r\n\x1a\n and so on"), "is not an .amt file");

  AmtBytes bytes(tinyBytes());
  bytes.header().version = 4;
  expectRefused(bytes, "was made by a newer Arete: format version 4, and this one reads 3");
  bytes.header().version = 1;
  expectRefused(bytes, "was made by an older Arete: format version 1, and this one reads 3; build it again");
  bytes.header().version = 0;
  expectRefused(bytes, "format version 0, which does not exist");
  bytes = AmtBytes(tinyBytes());
  bytes.header().byteOrder = kAmtByteOrderSwapped;
  expectRefused(bytes, "big-endian");

  const Result<AmtFile> missing = openAmt(folder.file("nothing.amt"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::notFound);
  const Result<AmtFile> directory = openAmt(std::filesystem::temp_directory_path().string());
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().message, "is a folder, not a file");
  EXPECT_FALSE(openAmt("/dev/null"));
}

TEST(HostileAmt, CannotPlaceItsChunksWhereTheyAreNot) {
  const auto with = [](const auto& change, const std::string& reason) {
    AmtBytes bytes(tinyBytes());
    change(bytes);
    expectRefused(bytes, reason);
  };
  using Bytes = AmtBytes&;
  constexpr std::uint64_t kHuge = 0xFFFFFFFFFFFFFFC0u;
  with([](Bytes b) { b.chunk(amt_tag::kLink).offset = kHuge; }, "LINK");
  with([](Bytes b) { b.chunk(amt_tag::kLink).bytes = kHuge; }, "reaches beyond the file");
  with([](Bytes b) { b.chunk(amt_tag::kLink).bytes = ~std::uint64_t{0}; }, "reaches beyond the file");
  with([](Bytes b) { b.chunk(amt_tag::kLink).offset += 4; }, "does not begin at a multiple of 64");
  with([](Bytes b) { b.chunk(amt_tag::kLink).offset -= 64; }, "overlaps what lies before it");
  with([](Bytes b) { b.chunk(amt_tag::kRemover).offset = b.chunk(amt_tag::kLink).offset; }, "overlaps");
  with([](Bytes b) { b.chunk(amt_tag::kMetadata).offset = 0; }, "overlaps");
  with([](Bytes b) { b.chunk(amt_tag::kLink).offset += 64; }, "leaves a gap");
  with([](Bytes b) { b.chunk(amt_tag::kLink).tag = amt_tag::kRemover; }, "occurs twice");
  with([](Bytes b) { b.chunk(amt_tag::kLink).tag = {'\x1b', '[', '2', 'J'}; }, "has no chunk LINK");
  with([](Bytes b) { b.chunk(amt_tag::kMetadata).tag = {'m', 'e', 't', 'a'}; }, "has no chunk META");
  with([](Bytes b) { b.chunk(amt_tag::kLink).bytes -= 4; }, "24 bytes instead of 7 elements of 4 bytes");
  with([](Bytes b) { b.chunk(amt_tag::kLink).elementBytes = 0; }, "another type");
  with([](Bytes b) { b.chunk(amt_tag::kLink).scalar = AmtScalar::f32; }, "another type");
  with([](Bytes b) { b.chunk(amt_tag::kMetadata).scalar = AmtScalar::u16; }, "not a text");
  with([](Bytes b) { b.chunk(amt_tag::kLink).flags = 1; }, "reserved field");
  with([](Bytes b) { b.header().reserved = 1; }, "reserved field");
  with([](Bytes b) { b.header().fileBytes += 64; }, "64 of its");
  with([](Bytes b) { b.header().fileBytes -= 64; }, "64 bytes more");

  // Headers whose directory cannot be sealed because it is nowhere.
  const TemporaryFolder folder;
  for (const std::uint32_t count : {0u, 16u, 18u, 65u, 0xFFFFFFFFu}) {
    AmtBytes bytes(tinyBytes());
    bytes.header().chunkCount = count;
    EXPECT_NE(refusalOf(folder, bytes.bytes()).find("damaged header"), std::string::npos);
    bytes.header().directoryBytes = std::uint64_t{count} * sizeof(AmtChunk);
    EXPECT_NE(refusalOf(folder, bytes.bytes()), "");
  }
  AmtBytes bytes(tinyBytes());
  bytes.header().directoryOffset = kHuge;
  EXPECT_NE(refusalOf(folder, bytes.bytes()).find("damaged header"), std::string::npos);
}

TEST(HostileAmt, CannotHideBytesBetweenItsChunks) {
  AmtBytes bytes(tinyBytes());
  const AmtChunk& link = bytes.chunk(amt_tag::kLink);
  std::string changed = bytes.bytes();
  changed[link.offset + link.bytes] = 1;
  const TemporaryFolder folder;
  EXPECT_EQ(refusalOf(folder, changed),
            fmt::format("has been altered: the bytes at {}, between its chunks, are not zero",
                        link.offset + link.bytes));
}

TEST(HostileAmt, CannotLieInItsMetadata) {
  const auto with = [](const std::string& from, const std::string& to, const std::string& reason) {
    AmtBytes bytes(tinyBytes());
    bytes.replaceInMetadata(from, to);
    expectRefused(bytes, reason);
  };
  with("{", "[", "not a JSON object");
  with("\"isRaster\": true", "\"isRaster\": 1", "isRaster is not true or false");
  with("\"isRaster\": true", "\"isroster\": true", "isRaster is missing");
  with("\"isRaster\": true", "\"isRaster\":false", "grid size");
  with("\"columns\": 3", "\"columns\":-3", "columns is not a whole number");
  with("\"columns\": 3,", "\"columns\":3.5", "not a JSON object");
  with("\"columns\": 3", "\"columns\": 0", "a grid of 0 columns");
  with("\"columns\": 3", "\"columns\": 1", "more than the grid has");
  with("\"nodes\": 2", "\"nodes\": 3", "slots do not make the stars");
  with("\"nodes\": 2", "\"nodes\": 1", "instead of");
  with("\"slots\": 7", "\"slots\": 8", "instead of");
  with("\"slots\": 7", "\"slots\":1e", "not a JSON object");
  with("\"rootVertices\": 4", "\"rootVertices\": 5", "instead of");
  with("\"isolated\": 1", "\"isolated\": 0", "instead of");
  with("\"type\": \"int16\"", "\"type\": \"int8\"", "heights.type");
  with("\"type\": \"int16\",\n", "\"type\":\"float32\",", "another type");
  with("\"offset\": -0.0", "\"offset\":1e999", "not a JSON object");
  with("\"offset\": -0.0", "\"offset\":null", "heights.offset is not a number");
  with("\"shape\": \"delaunay\"", "\"shape\": \"round\"", "build.shape");
  with("\"metricP\": 3", "\"metricP\": 0", "Delaunay metric");
  with("\"maxDegree\": 14", "\"maxDegree\": 99", "the build options are wrong");
  with("-30.0", "0.0", "not invertible");
  with("\"linearUnitMetres\": 1.0", "\"linearUnitMetres\": 0.0", "linear unit is 0");

  AmtBytes large(tinyBytes());
  const std::string text = large.metadata();
  const std::string base =
      text.substr(text.find("\"errorScaleBase\""),
                  text.find(",", text.find("\"errorScaleBase\"")) - text.find("\"errorScaleBase\""));
  large.replaceInMetadata(base, "\"errorScaleBase\":999999");
  expectRefused(large, "the error scale's base");

  // Counts that only fit each other when they wrap around 32 or 64 bits.
  const auto counts =
      text.substr(text.find("\"rootVertices\""), text.find("}") - text.find("\"rootVertices\""));
  for (const char* const hostile :
       {"\"rootVertices\":4,\"rootTriangles\":2,\"nodes\":2,\"slots\":4294967295,",
        "\"rootVertices\":4294967294,\"rootTriangles\":2,\"nodes\":2,\"slots\":7,",
        "\"rootVertices\":4,\"rootTriangles\":4294967291,\"nodes\":2,\"slots\":7,",
        "\"rootVertices\":4,\"rootTriangles\":18446744073709551615,\"nodes\":2,\"slots\":7,",
        "\"rootVertices\":4,\"rootTriangles\":2,\"nodes\":9223372036854775809,\"slots\":7,"}) {
    AmtBytes bytes(tinyBytes());
    bytes.replaceInMetadata(counts, std::string(hostile) + "\"isolated\":1,\"fixedVertices\":2");
    expectRefused(bytes, "more than 32-bit ids can name");
  }
}

TEST(HostileAmt, CannotNameWhatDoesNotExist) {
  const auto with = [](const auto& change, const std::string& reason) {
    AmtBytes bytes(tinyBytes());
    change(bytes);
    expectRefused(bytes, reason);
  };
  const auto word = [&](const AmtTag& tag, std::size_t i, std::uint32_t value, const std::string& reason) {
    with([&](AmtBytes& b) { b.array<std::uint32_t>(tag)[i] = value; }, reason);
  };
  word(amt_tag::kSlotBegin, 0, 1, "chunk SLOT: the first slot is not 0");
  word(amt_tag::kSlotBegin, 1, 2, "chunk SLOT: node 0 has the slots 0 to 2; a star has 3 to 33");
  word(amt_tag::kSlotBegin, 1, 0xFFFFFFF0u, "chunk SLOT: node 0");
  word(amt_tag::kSlotBegin, 1, 5, "chunk SLOT: node 1");
  word(amt_tag::kSlotBegin, 2, 8, "chunk SLOT: the last node ends at slot 8 of 7");
  word(amt_tag::kRootTriangles, 4, 4,
       "chunk RTRI: triangle 1 has the corners 0, 4, 3 of 4 vertices of the root");
  word(amt_tag::kRootTriangles, 0, kNone, "chunk RTRI");
  word(amt_tag::kLink, 2, 4, "chunk LINK: slot 2 names vertex 4, which is not older than node 0's vertex 4");
  word(amt_tag::kLink, 4, 3, "chunk LINK: slot 4 names vertex 3, which is no corner of the floor of node 1");
  word(amt_tag::kLink, 6, kNone, "chunk LINK: slot 6");
  word(amt_tag::kRemover, 0, 2, "chunk RMVR: triangle 0 is removed by node 2 of 2");
  word(amt_tag::kRemover, 3, 0, "chunk RMVR: triangle 3, of node 0, is removed by node 0");
  word(amt_tag::kRemover, 8, 0, "chunk RMVR: triangle 8, of node 1, is removed by node 0");
  word(amt_tag::kRemover, 7, 1, "chunk RMVR: triangle 7, of node 1, is removed by node 1");
  word(amt_tag::kRemover, 3, 1, "chunk RMVR: 4 triangles are removed and 3 are in the floors");
  word(amt_tag::kRemover, 2, kNone, "chunk FLOR: node 1 lists triangle 2");
  word(amt_tag::kFloor, 2, 9, "chunk FLOR: node 1 lists triangle 9");
  word(amt_tag::kFloor, 2, 8, "chunk FLOR: node 1 lists triangle 8");
  word(amt_tag::kFloor, 1, 0, "chunk FLOR: node 0 lists triangle 0");
  word(amt_tag::kFloor, 0, kNone, "chunk FLOR");
  word(amt_tag::kCreatorHint, 0, 1, "chunk HINT: entry 0 names node 1 as the owner of slot 0");
  word(amt_tag::kCreatorHint, 0, kNone, "chunk HINT");
  word(amt_tag::kSamples, 5, 9, "chunk SAMP: vertex 5 is sample 9 of 9");
  word(amt_tag::kIsolatedSamples, 0, 9, "chunk ISAM: entry 0 is sample 9 of 9");
  word(amt_tag::kFixedVertices, 1, 9, "chunk FIXV: entry 1 is sample 9 of 9");
  with([](AmtBytes& b) { b.array<std::uint16_t>(amt_tag::kSaturatedError)[1] = 0xFFFF; },
       "chunk SERR: node 1 is in a higher band of errors than the node before it");
  with(
      [](AmtBytes& b) {
        const auto saturated = b.array<std::uint16_t>(amt_tag::kSaturatedError);
        saturated[1] = static_cast<std::uint16_t>(saturated[0] + 1);
      },
      "chunk SERR: node 0 has a smaller error than its child 1");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kSphere)[5] = std::numeric_limits<float>::infinity(); },
       "chunk SPHR: node 1");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kSphere)[3] = -1; }, "chunk SPHR: node 0");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kSphere)[7] = 30; },
       "chunk SPHR: the sphere of node 0 does not hold that of its child 1");
  with([](AmtBytes& b) { b.array<std::uint16_t>(amt_tag::kBlockError)[0] -= 1; },
       "chunk BERR: block 0 has a smaller error than its node 0");
  with([](AmtBytes& b) { b.array<std::uint16_t>(amt_tag::kBlockError)[1] = 0; },
       "chunk BERR: block 1 has a smaller error than its node 0");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kBlockSphere)[3] = 30; },
       "chunk BSPH: the sphere of block 0 does not hold that of its node 0");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kBlockSphere)[4] = 1e6f; },
       "chunk BSPH: the sphere of block 1 does not hold that of its node 0");
  with([](AmtBytes& b) { b.array<float>(amt_tag::kBlockSphere)[7] = NAN; }, "chunk BSPH: block 1");
  with([](AmtBytes& b) { b.array<double>(amt_tag::kIsolatedHeights)[0] = NAN; }, "chunk IHGT: entry 0");

  const TemporaryFolder folder;
  PointHeightfield points;
  points.positions = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}, {3, 1}};
  points.heights = {1.1, 2.2, 3.3, 4.4, 5.5, 6.6};
  ASSERT_TRUE(writeAmt(folder.file("points.amt"), built(build(points))));
  AmtBytes plan = AmtBytes::of(folder.file("points.amt")), heights = plan;
  plan.array<double>(amt_tag::kPlan)[3] = NAN;
  expectRefused(plan, "chunk PLAN: vertex 1");
  heights.array<double>(amt_tag::kHeights)[4] = INFINITY;
  expectRefused(heights, "chunk HGHT: vertex 4");
}

void expectSoundIndices(const MultiTriangulation& mt, const Result<Cut>& cut) {
  ASSERT_TRUE(cut);
  for (const std::uint32_t v : cut->vertices) ASSERT_LT(v, mt.vertexCount());
  for (const std::uint32_t t : cut->ids) ASSERT_LT(t, mt.triangleIdCount());
  for (const auto& corners : cut->triangles)
    for (const std::uint32_t v : corners) ASSERT_LT(v, cut->vertices.size());
}

/// A finer error in one quarter of the plan.
RegionError quarter(const MultiTriangulation& mt, double error) {
  return RegionError(Region::box({0, 0, 12, 11}), mt.arrays().metric, error, 2 * error + 5);
}

// A file that passes the index check is safe to ask, however wrong its answers: thousands of words changed at
// random, sealed, loaded, and every kind of cut taken of what is not refused. Sanitizers watch.
TEST(HostileAmt, CanBeAskedWithoutHarmOnceItsIndicesPass) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, built(build(hills(24, 22, [](double z) { return std::round(z) + 0.0; })))));
  const AmtBytes good = AmtBytes::of(path);
  std::mt19937 random(7);
  int refused = 0, asked = 0;
  for (int round = 0; round < 3000; ++round) {
    AmtBytes bytes = good;
    bytes.spoil(random);
    bytes.seal();
    writeAll(path, bytes.bytes());
    const Result<TerrainModel> model = loadAmt(path);
    if (!model) {
      ++refused;
      EXPECT_EQ(model.error().code, ErrorCode::corrupt) << model.error().describe();
      continue;
    }
    ++asked;
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated})
      for (const double error : {0.0, 3.0, 30.0}) {
        expectSoundIndices(model->mt, takeCut(model->mt, UniformError(error), {method, {}}));
        expectSoundIndices(model->mt, takeCut(model->mt, quarter(model->mt, error), {method, {}}));
        expectSoundIndices(model->mt, takeCut(model->mt, UniformError(error),
                                              {method, model->mt.rootTriangleCount() + 100}));
      }
    ASSERT_EQ(model->rasterSamples().heights.size(), 24u * 22u);
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(asked, 500);
}

// The same of the header, the directory and the metadata: whatever they say, opening answers.
TEST(HostileAmt, CanSayAnythingInItsHeaderWithoutHarm) {
  const TemporaryFolder folder;
  const std::string tiny = tinyBytes();
  const std::size_t front = AmtBytes(tiny).chunk(amt_tag::kRootTriangles).offset;
  std::mt19937 random(11);
  for (int round = 0; round < 5000; ++round) {
    std::string changed = tiny;
    for (std::uint32_t changes = 1 + random() % 3; changes-- > 0;) {
      const std::size_t at = 8 + random() % (front - 8);
      changed[at] = random() % 2 == 0 ? static_cast<char>(random()) : "0123456789-e.,{}[]"[random() % 18];
    }
    AmtBytes bytes(changed);
    if (bytes.header().chunkCount == 17) bytes.seal();
    refusalOf(folder, bytes.bytes());
  }
}

}  // namespace
}  // namespace arete
