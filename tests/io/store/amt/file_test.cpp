// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::expectSameModel;
using test::hills;
using test::readAll;
using test::TemporaryFolder;
using test::tinyModel;

TerrainModel loaded(const std::string& path, const AmtLoadOptions& options = {}) {
  return built(loadAmt(path, options));
}

void expectRoundTrip(const TerrainModel& model) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const Status written = writeAmt(path, model);
  ASSERT_TRUE(written) << written.error().describe();
  for (const AmtVerify verify : {AmtVerify::all, AmtVerify::indices, AmtVerify::none}) {
    const Result<TerrainModel> back = loadAmt(path, {verify, {}});
    ASSERT_TRUE(back) << back.error().describe();
    expectSameModel(model, *back);
  }
}

double kilobytesMappedOf(const std::string& path) {
  std::ifstream maps("/proc/self/smaps");
  bool isHere = false;
  for (std::string line; std::getline(maps, line);) {
    if (line.find(path) != std::string::npos) isHere = true;
    if (isHere && line.starts_with("Rss:")) return std::stod(line.substr(4));
  }
  return -1;
}

long pageFaults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

TEST(AmtFile, KeepsEveryBitOfAHandMadeModel) {
  expectRoundTrip(tinyModel());
}

TEST(AmtFile, KeepsEveryBitOfRastersWhateverTheirHeightsAre) {
  using Type = HeightEncoding::Type;
  {
    const TerrainModel model = built(build(hills(60, 50, [](double z) { return std::round(z) + 0.0; })));
    ASSERT_EQ(model.mt.vertices().encoding.type, Type::int16);
    ASSERT_EQ(model.isolated.size(), 1u);
    expectRoundTrip(model);
  }
  {
    RasterHeightfield field = hills(60, 50, [](double z) { return std::round(z * 4) * 0.25 + 1000.5; });
    field.rawScale = 0.25;
    field.rawOffset = 1000.5;
    const TerrainModel model = built(build(field));
    ASSERT_EQ(model.mt.vertices().encoding.type, Type::int16);
    ASSERT_EQ(model.mt.vertices().encoding.offset, 1000.5);
    expectRoundTrip(model);
  }
  {
    RasterHeightfield field = hills(60, 50, [](double z) { return double(float(z)); });
    field.heights[0] = -0.0;
    const TerrainModel model = built(build(field));
    ASSERT_EQ(model.mt.vertices().encoding.type, Type::float32);
    ASSERT_TRUE(std::signbit(model.mt.vertices().encoding.offset));
    expectRoundTrip(model);
  }
  {
    const TerrainModel model = built(build(hills(60, 50, [](double z) { return z; })));
    ASSERT_EQ(model.mt.vertices().encoding.type, Type::float64);
    expectRoundTrip(model);
  }
}

TEST(AmtFile, KeepsEveryBitOfScatteredPoints) {
  PointHeightfield field;
  field.source = "points";
  for (int i = 0; i < 500; ++i) {
    field.positions.push_back({std::fmod(i * 7.7123, 100) + 1e6, std::fmod(i * 13.331, 70)});
    field.heights.push_back(std::sin(i * 0.1) * 20);
  }
  const TerrainModel model = built(build(field));
  ASSERT_FALSE(model.isRaster);
  expectRoundTrip(model);
}

TEST(AmtFile, KeepsMetadataThatIsAwkwardInJson) {
  TerrainModel model = tinyModel();
  Georeference& g = model.georeference;
  model.source = "caf\xe9/\x01\"\\quoted\".tif";  // Latin-1: no UTF-8
  g.crsWkt = std::string("PROJCRS[\"x\",\n\t\0]", 16) + "\u00e9\u4e16";
  g.verticalDatum = "{\"hex\": \"00\"}";
  g.geoTransform = {0.1, std::nextafter(30, 31), 5e-324, -1e300, 1e-300, -30.000000000000004};
  g.isGeographic = true;
  g.angularUnitRadians = 0.01745329251994328;
  g.linearUnitMetres = 1200.0 / 3937;
  g.inverseFlattening = 0;
  model.options = {HoleShape::dataDependent, 32, std::nextafter(1.0, 2.0), 1e-9, 2.5, {}};
  model.reading = {.band = 65535, .layer = "caf\xe9", .zField = "\"", .crs = "EPSG:4326", .nodata = -3.4e38};
  expectRoundTrip(model);
}

TEST(AmtFile, KeepsAModelWithoutNodes) {
  const TerrainModel tiny = tinyModel();
  TerrainModel model = tiny;
  MtArrays a = model.mt.arrays();
  static constexpr std::uint32_t begin[] = {0},
                                 none[] = {MultiTriangulation::kNone, MultiTriangulation::kNone};
  a.slotBegin = begin;
  a.remover = none;
  a.link = a.floor = a.creatorHint = {};
  a.error = a.error.first(2);
  a.columns.set(kBelow, a.error);
  a.columns.set(kAbove, a.error);
  a.saturatedError = {};
  a.sphere = a.blockSphere = {};
  a.blockError = {};
  a.vertices.samples = a.vertices.samples.first(4);
  a.vertices.rawHeights = a.vertices.rawHeights.first(8);
  model.mt = MultiTriangulation(a, nullptr);
  expectRoundTrip(model);
}

TEST(AmtFile, GivesTheSameBytesForTheSameModel) {
  const TemporaryFolder folder;
  const RasterHeightfield field = hills(80, 70, [](double z) { return std::round(z) + 0.0; });
  ASSERT_TRUE(writeAmt(folder.file("a.amt"), built(build(field))));
  RunContext two;
  two.threads = 2;
  ASSERT_TRUE(writeAmt(folder.file("b.amt"), built(build(field)), two));
  ASSERT_TRUE(writeAmt(folder.file("c.amt"), loaded(folder.file("a.amt"))));
  const std::string bytes = readAll(folder.file("a.amt"));
  EXPECT_EQ(bytes, readAll(folder.file("b.amt")));
  EXPECT_EQ(bytes, readAll(folder.file("c.amt")));
}

// Format version 2, fixed. If this fails, the format has changed: files in the world cannot be read any more,
// or not by the Arete that wrote them. Then it is a new version, and docs/topics/amt-format.md says so.
TEST(AmtFile, HasTheGoldenBytesOfFormatVersion2) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeAmt(folder.file("tiny.amt"), tinyModel(), {}, {"golden"}));
  const std::string bytes = readAll(folder.file("tiny.amt"));
  EXPECT_EQ(bytes.substr(0, 24), std::string("\x89"
                                             "AMT\r\n\x1a\n"
                                             "\x04\x03\x02\x01"
                                             "\x02\0\0\0"
                                             "\x40\0\0\0"
                                             "\x14\0\0\0",
                                             24));
  EXPECT_EQ(bytes.substr(64, 4), "META");
  EXPECT_EQ(bytes.size(), 3328u);
  EXPECT_EQ(fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size())), "28c6ff837d6e6d41");

  // But for the checksums of segments, which older readers pass over, it is what earlier builds wrote.
  const AmtBytes earlier = AmtBytes(bytes).withoutSegments();
  EXPECT_EQ(earlier.bytes().size(), 3072u);
  EXPECT_EQ(fmt::format("{:016x}", XXH3_64bits(earlier.bytes().data(), earlier.bytes().size())),
            "5666a59ff5454c0f");
}

TEST(AmtFile, PutsEveryArrayAtAMultipleOf64) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeAmt(folder.file("tiny.amt"), tinyModel()));
  const Result<AmtFile> file = openAmt(folder.file("tiny.amt"));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->writer().substr(0, 6), "Arete ");
  EXPECT_EQ(file->chunks().size(), 20u);
  for (const AmtChunk& chunk : file->chunks()) EXPECT_EQ(chunk.offset % 64, 0u) << chunk.name();
  EXPECT_EQ(file->bytes().size() % 64, 0u);
}

TEST(AmtFile, AnswersFromTheMappingAfterTheFileIsGone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const TerrainModel model = built(build(hills(60, 50, [](double z) { return std::round(z) + 0.0; })));
  ASSERT_TRUE(writeAmt(path, model));
  const TerrainModel back = loaded(path);
  std::filesystem::remove(path);
  const auto expected = takeCut(model.mt, UniformError(5)), actual = takeCut(back.mt, UniformError(5));
  ASSERT_TRUE(expected && actual);
  EXPECT_EQ(expected->ids, actual->ids);
  EXPECT_EQ(expected->triangles, actual->triangles);
}

TEST(AmtFile, CanBeWrittenOverTheFileThatItsModelIsMappedFrom) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, tinyModel()));
  TerrainModel model = loaded(path);
  model.source = "renamed";
  ASSERT_TRUE(writeAmt(path, model));
  expectSameModel(loaded(path), model);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AmtFile, LeavesNothingBehindWhenWritingIsInterrupted) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  const TerrainModel model = built(build(hills(60, 50, [](double z) { return std::round(z) + 0.0; })));
  for (const std::string stage : {"checksum", "write"}) {
    std::atomic<bool> cancel = false;
    RunContext context;
    context.cancel = &cancel;
    context.progress = [&](std::string_view now, double) { cancel = cancel || now == stage; };
    const Status written = writeAmt(path, model, context);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::interrupted);
    EXPECT_EQ(written.error().culprit, path);
    EXPECT_EQ(folder.count(), 0u);
  }
  // An older file of that name stays as it was.
  ASSERT_TRUE(writeAmt(path, tinyModel()));
  const std::string before = readAll(path);
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_FALSE(writeAmt(path, model, context));
  EXPECT_EQ(readAll(path), before);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AmtFile, NeverShowsAHalfWrittenFileWhileOverwriting) {
  const TemporaryFolder folder;
  const std::string path = folder.file("model.amt");
  ASSERT_TRUE(writeAmt(path, tinyModel()));
  const std::string before = readAll(path);
  RunContext context;
  int reports = 0;
  context.progress = [&](std::string_view stage, double fraction) {
    if (stage != "write" || fraction == 1) return;
    ++reports;
    EXPECT_EQ(readAll(path), before);
  };
  const TerrainModel model = built(build(hills(60, 50, [](double z) { return std::round(z) + 0.0; })));
  ASSERT_TRUE(writeAmt(path, model, context));
  EXPECT_GT(reports, 5);
  expectSameModel(loaded(path), model);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(AmtFile, ReportsAFullDiskAndAMissingFolder) {
  if (std::filesystem::exists("/dev/full")) {
    const Status full = writeAmt("/dev/full", tinyModel());
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().code, ErrorCode::unreadable);
    EXPECT_EQ(full.error().culprit, "/dev/full");
    EXPECT_NE(full.error().message.find("No space left"), std::string::npos) << full.error().message;
  }
  const Status nowhere = writeAmt("/nonexistent-folder/x.amt", tinyModel());
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::notFound);
}

TEST(AmtFile, RefusesToWriteWhatCouldNotBeOpened) {
  const TemporaryFolder folder;
  const auto expectRefused = [&](const TerrainModel& model, const std::string& reason) {
    const Status written = writeAmt(folder.file("x.amt"), model);
    ASSERT_FALSE(written) << reason;
    EXPECT_EQ(written.error().code, ErrorCode::invalidData);
    EXPECT_NE(written.error().message.find(reason), std::string::npos) << written.error().message;
    EXPECT_EQ(folder.count(), 0u);
  };
  expectRefused(TerrainModel{}, "no root triangle");
  TerrainModel model = tinyModel();
  model.georeference.geoTransform[3] = std::numeric_limits<double>::quiet_NaN();
  expectRefused(model, "geotransform holds nan");
  model = tinyModel();
  model.columns = 4;
  expectRefused(model, "not of its grid");
  const TerrainModel tiny = tinyModel();
  model = tiny;
  MtArrays arrays = model.mt.arrays();
  arrays.floor = arrays.floor.first(2);
  model.mt = MultiTriangulation(arrays, nullptr);
  expectRefused(model, "its FLOR array has 8 bytes instead of the 12 of its counts");
  model = tinyModel();
  model.georeference.crsWkt.assign(kAmtMaxMetadataBytes, 'x');
  expectRefused(model, "bytes of metadata");
}

// The address sanitizer keeps pages of its own about those of the program. Clang says that it is there by
// another name than GCC.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define ARETE_HAS_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(ARETE_HAS_ADDRESS_SANITIZER)
constexpr long kFaultsOfSanitizer = 40;
#else
constexpr long kFaultsOfSanitizer = 0;
#endif

TEST(AmtFile, TouchesOnlyTheFirstPagesOnOpening) {
  const TemporaryFolder folder;
  const std::string path = folder.file("large.amt");
  {
    // A fan of nodes that all say the same: the size is what matters here, and nothing is verified.
    constexpr std::uint32_t kNodes = 700'000, kSlots = 3 * kNodes;
    const std::vector<std::uint32_t> words(kSlots + 2);
    const std::vector<std::uint16_t> halves(kSlots + 2);
    const std::vector<Sphere> spheres(kNodes);
    const TerrainModel tiny = tinyModel();
    TerrainModel model = tiny;
    MtArrays a = model.mt.arrays();
    const std::span<const std::uint32_t> w(words);
    a.slotBegin = w.first(kNodes + 1);
    a.link = w.first(kSlots);
    a.remover = w;
    a.error = halves;
    a.columns.set(kBelow, a.error);
    a.columns.set(kAbove, a.error);
    a.floor = w.first(kSlots - 2 * kNodes);
    a.saturatedError = std::span(halves).first(kNodes);
    a.sphere = spheres;
    a.blockError = std::span(halves).first(nodeBlockAndPageCount(kNodes));
    a.blockSphere = std::span(spheres).first(nodeBlockAndPageCount(kNodes));
    a.creatorHint = w.first((kSlots + 63) / 64);
    a.vertices.samples = w.first(kNodes + 4);
    a.vertices.columns = model.columns = 1000;
    model.rows = 1000;
    const std::vector<std::byte> heights(2 * (kNodes + 4));
    a.vertices.rawHeights = heights;
    model.mt = MultiTriangulation(a, nullptr);
    const Status written = writeAmt(path, model);
    ASSERT_TRUE(written) << written.error().describe();
  }
  ASSERT_GT(std::filesystem::file_size(path), 50'000'000u);
  ASSERT_TRUE(openAmt(path));  // the code's own pages, once
  for (const bool randomAccess : {false, true}) {
    const long before = pageFaults();
    const Result<AmtFile> file = openAmt(path, {randomAccess});
    const long faults = pageFaults() - before;
    ASSERT_TRUE(file) << file.error().describe();
    // Reading it whole would take 12 000 faults, or 800 where the system maps 16 pages at a time.
    EXPECT_LE(faults, 40 + kFaultsOfSanitizer);
    const double mapped = kilobytesMappedOf(path);
    EXPECT_LE(mapped, 256) << "kilobytes of the file in memory";
    RecordProperty("faults", std::to_string(faults));
    RecordProperty("kilobytes", std::to_string(mapped));
  }
}

TEST(AmtFile, KeepsEveryFamilyOfTerrain) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    BuildOptions options;
    options.shape = shape;
    for (const RasterFamily& family : rasterFamilies())
      for (const double rimTolerance : {0.0, 1.5}) {
        SCOPED_TRACE(fmt::format("{}, {}, rim tolerance {}", family.name, toString(shape), rimTolerance));
        options.rimTolerance = rimTolerance;
        expectRoundTrip(built(build(family.make(23, 19, 5), options)));
      }
    options.rimTolerance = 0;
    for (const PointFamily& family : pointFamilies()) {
      SCOPED_TRACE(fmt::format("{}, {}", family.name, toString(shape)));
      expectRoundTrip(built(build(family.make(150, 5), options)));
    }
  }
}

TEST(AmtFile, KeepsARealTerrain) {
  const std::string raster = test::realData("dem/usgsdem_mt_st_helens.dem");
  if (raster.empty()) GTEST_SKIP() << "the real data is not here; set ARETE_DATA to its folder";
  const auto read = readRaster(raster);
  ASSERT_TRUE(read) << read.error().describe();
  expectRoundTrip(built(build(read->heightfield)));
}

}  // namespace
}  // namespace arete
