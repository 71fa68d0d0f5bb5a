// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of .amt files share: models made by hand and by building, comparison to the bit, and files
// changed on purpose.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "engine/mt/node_blocks.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete::test {

inline std::string readAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
/// In place where the file exists: some systems force a file to the disk when it was emptied and written
/// anew.
inline void writeAll(const std::string& path, const std::string& bytes) {
  if (!std::filesystem::exists(path)) std::ofstream(path, std::ios::binary);
  std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << bytes;
  if (std::filesystem::file_size(path) != bytes.size()) std::filesystem::resize_file(path, bytes.size());
}

/// A grid of 3 x 3 samples: two root triangles, the centre inserted, then the middle of the upper side.
///
///   v0---v5---v1       v0, v1, v2, v3: the root;  v4: node 0, a closed star;  v5: node 1, an open one
///    | \  |  / |
///    |  \ | /  |
///    |    v4   |       sample 7 is isolated; samples 3 and 5 have no data
///    |  /    \ |
///   v3---------v2
inline TerrainModel tinyModel() {
  constexpr std::uint32_t kNone = MultiTriangulation::kNone;
  struct Arrays {
    std::vector<std::array<std::uint32_t, 3>> rootTriangles{{0, 1, 2}, {0, 2, 3}};
    std::vector<std::uint32_t> slotBegin{0, 4, 7}, link{0, 1, 2, 3, 1, 4, 0};
    std::vector<std::uint32_t> remover{0, 0, 1, kNone, kNone, kNone, kNone, kNone, 1};
    std::vector<std::uint32_t> floor{0, 1, 2}, hint{0}, samples{0, 2, 8, 6, 4, 1};
    std::vector<std::uint16_t> error, below, above, saturated;
    std::vector<Sphere> sphere{{0, 0, 0.5f, 40}, {0.25f, -15, 1, 22}};
    NodeBlocks blocks;
    std::vector<std::int16_t> heights{10, 20, -30, 40, 25, 12};
  };
  const OutwardScale scale(40.0);
  auto arrays = std::make_shared<Arrays>();
  arrays->error.assign(9, 0);
  arrays->below.assign(9, 0);
  arrays->above.assign(9, 0);
  for (const std::uint32_t t : {0u, 1u, 2u}) {
    arrays->error[t] = scale.encode(4.0 - t);
    arrays->below[t] = scale.encode(5.0 - t);
    arrays->above[t] = scale.encode(1.0 + t);
  }
  arrays->saturated = {scale.encode(4.0), scale.encode(2.0)};

  arrays->blocks = makeNodeBlocks(arrays->saturated, arrays->sphere);

  MtArrays a;
  a.rootVertices = 4;
  a.rootTriangles = arrays->rootTriangles;
  a.slotBegin = arrays->slotBegin;
  a.link = arrays->link;
  a.remover = arrays->remover;
  a.error = arrays->error;
  a.columns.set(kBelow, arrays->below);
  a.columns.set(kAbove, arrays->above);
  a.floor = arrays->floor;
  a.saturatedError = arrays->saturated;
  a.sphere = arrays->sphere;
  a.blockError = arrays->blocks.error;
  a.blockSphere = arrays->blocks.sphere;
  a.creatorHint = arrays->hint;
  a.scale = scale;
  a.metric = {{1, 1, 5}, {30, 30, 0.3048}};
  a.vertices.samples = arrays->samples;
  a.vertices.columns = 3;
  a.vertices.encoding = {HeightEncoding::Type::int16, 0.1, -0.0};
  a.vertices.rawHeights = std::as_bytes(std::span(arrays->heights));

  TerrainModel model;
  model.mt = MultiTriangulation(a, arrays);
  model.georeference.geoTransform = {500000, 30, 0, 4000000.1, 0, -30};
  model.georeference.hasGeoTransform = true;
  model.georeference.verticalUnit = "ft";
  model.georeference.verticalUnitMetres = 0.3048;
  model.columns = model.rows = 3;
  model.isolated = {{7, 1.0 / 3}};
  model.source = "tiny.tif";
  model.sourceChecksum = "xxh3-128:0123456789abcdef0123456789abcdef";
  model.options.thresholdRatio = 1.07;  // the golden bytes do not hang on defaults
  model.options.fixedVertices = {0, 8};
  model.metricP = 3;
  model.metricQ = 2;
  model.levels = 2;
  return model;
}

/// A hilly raster with a hole, an isolated sample and a flat part.
inline RasterHeightfield hills(std::uint32_t columns, std::uint32_t rows,
                               const std::function<double(double)>& quantise) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.source = "hills";
  field.georeference.geoTransform = {7.5, 1.0 / 3600, 0, 46.25, 0, -1.0 / 3600};
  field.georeference.hasGeoTransform = true;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double z = 40 * std::sin(c * 0.37) * std::cos(r * 0.29) + 9 * std::sin(c * r * 0.013) + 0.3 * c;
      const bool isHole = c > columns / 2 && c < columns / 2 + 5 && r > 2 && r < 8;
      field.heights.push_back(isHole ? std::numeric_limits<double>::quiet_NaN() : quantise(z));
    }
  if (columns > 20 && rows > 20) field.heights[5 * columns + columns / 2 + 3] = quantise(77);
  return field;
}

inline TerrainModel built(const Result<TerrainModel>& model) {
  if (!model) throw std::runtime_error(model.error().describe());
  return *model;
}

inline bool isSameBits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T>
void expectSameArray(std::span<const T> a, std::span<const T> b, const char* name) {
  ASSERT_EQ(a.size(), b.size()) << name;
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0) << name;
}

inline void expectSameModel(const TerrainModel& x, const TerrainModel& y) {
  const MtArrays &a = x.mt.arrays(), &b = y.mt.arrays();
  EXPECT_EQ(a.rootVertices, b.rootVertices);
  expectSameArray(a.rootTriangles, b.rootTriangles, "rootTriangles");
  expectSameArray(a.slotBegin, b.slotBegin, "slotBegin");
  expectSameArray(a.link, b.link, "link");
  expectSameArray(a.remover, b.remover, "remover");
  expectSameArray(a.error, b.error, "error");
  expectSameArray(a.columns.of(kBelow), b.columns.of(kBelow), "below");
  expectSameArray(a.columns.of(kAbove), b.columns.of(kAbove), "above");
  expectSameArray(a.floor, b.floor, "floor");
  expectSameArray(a.saturatedError, b.saturatedError, "saturatedError");
  expectSameArray(a.sphere, b.sphere, "sphere");
  expectSameArray(a.blockError, b.blockError, "blockError");
  expectSameArray(a.blockSphere, b.blockSphere, "blockSphere");
  expectSameArray(a.creatorHint, b.creatorHint, "creatorHint");
  expectSameArray(a.vertices.samples, b.vertices.samples, "samples");
  expectSameArray(a.vertices.plan, b.vertices.plan, "plan");
  expectSameArray(a.vertices.rawHeights, b.vertices.rawHeights, "rawHeights");
  EXPECT_EQ(a.vertices.columns, b.vertices.columns);
  EXPECT_EQ(a.vertices.encoding.type, b.vertices.encoding.type);
  EXPECT_PRED2(isSameBits, a.vertices.encoding.scale, b.vertices.encoding.scale);
  EXPECT_PRED2(isSameBits, a.vertices.encoding.offset, b.vertices.encoding.offset);
  EXPECT_EQ(a.scale.base(), b.scale.base());
  EXPECT_EQ(std::memcmp(&a.metric, &b.metric, sizeof a.metric), 0);

  const Georeference &g = x.georeference, &h = y.georeference;
  EXPECT_EQ(std::memcmp(&g.geoTransform, &h.geoTransform, sizeof g.geoTransform), 0);
  EXPECT_EQ(g.hasGeoTransform, h.hasGeoTransform);
  EXPECT_EQ(g.crsWkt, h.crsWkt);
  EXPECT_EQ(g.isGeographic, h.isGeographic);
  EXPECT_PRED2(isSameBits, g.angularUnitRadians, h.angularUnitRadians);
  EXPECT_PRED2(isSameBits, g.linearUnitMetres, h.linearUnitMetres);
  EXPECT_PRED2(isSameBits, g.semiMajorAxisMetres, h.semiMajorAxisMetres);
  EXPECT_PRED2(isSameBits, g.inverseFlattening, h.inverseFlattening);
  EXPECT_EQ(g.verticalUnit, h.verticalUnit);
  EXPECT_PRED2(isSameBits, g.verticalUnitMetres, h.verticalUnitMetres);
  EXPECT_EQ(g.verticalDatum, h.verticalDatum);

  EXPECT_EQ(x.isRaster, y.isRaster);
  EXPECT_EQ(x.columns, y.columns);
  EXPECT_EQ(x.rows, y.rows);
  EXPECT_EQ(x.source, y.source);
  EXPECT_EQ(x.sourceChecksum, y.sourceChecksum);
  EXPECT_EQ(x.reading.band, y.reading.band);
  EXPECT_EQ(x.reading.layer, y.reading.layer);
  EXPECT_EQ(x.reading.zField, y.reading.zField);
  EXPECT_EQ(x.reading.crs, y.reading.crs);
  EXPECT_EQ(x.reading.nodata, y.reading.nodata);
  EXPECT_EQ(x.metricP, y.metricP);
  EXPECT_EQ(x.metricQ, y.metricQ);
  EXPECT_EQ(x.levels, y.levels);
  ASSERT_EQ(x.isolated.size(), y.isolated.size());
  for (std::size_t i = 0; i < x.isolated.size(); ++i) {
    EXPECT_EQ(x.isolated[i].sample, y.isolated[i].sample);
    EXPECT_PRED2(isSameBits, x.isolated[i].height, y.isolated[i].height);
  }
  EXPECT_EQ(x.options.shape, y.options.shape);
  EXPECT_EQ(x.options.maxDegree, y.options.maxDegree);
  EXPECT_PRED2(isSameBits, x.options.thresholdRatioOrDefault(), y.options.thresholdRatioOrDefault());
  EXPECT_PRED2(isSameBits, x.options.minimumAspect, y.options.minimumAspect);
  EXPECT_PRED2(isSameBits, x.options.rimTolerance, y.options.rimTolerance);
  EXPECT_EQ(x.options.fixedVertices, y.options.fixedVertices);
}

/// The bytes of an .amt file, to be changed and sealed again: what a hostile writer can do.
class AmtBytes {
 public:
  explicit AmtBytes(std::string bytes) : bytes_(std::move(bytes)) {}
  static AmtBytes of(const std::string& path) { return AmtBytes(readAll(path)); }

  AmtHeader& header() { return *reinterpret_cast<AmtHeader*>(bytes_.data()); }
  AmtChunk* chunks() { return reinterpret_cast<AmtChunk*>(bytes_.data() + sizeof(AmtHeader)); }
  AmtChunk& chunk(const AmtTag& tag) {
    for (std::uint32_t i = 0; i < header().chunkCount; ++i)
      if (chunks()[i].tag == tag) return chunks()[i];
    throw std::runtime_error("no such chunk");
  }
  template <class T>
  std::span<T> array(const AmtTag& tag) {
    const AmtChunk& c = chunk(tag);
    return {reinterpret_cast<T*>(bytes_.data() + c.offset), c.bytes / sizeof(T)};
  }
  std::string metadata() {
    const auto text = array<char>(amt_tag::kMetadata);
    return {text.begin(), text.end()};
  }
  /// Replaces a text in the metadata by one that is no longer, filled up with blanks.
  void replaceInMetadata(const std::string& from, std::string to) {
    const auto text = array<char>(amt_tag::kMetadata);
    const auto at = std::search(text.begin(), text.end(), from.begin(), from.end());
    if (at == text.end() || to.size() > from.size()) throw std::runtime_error("cannot replace " + from);
    to.resize(from.size(), ' ');
    std::copy(to.begin(), to.end(), at);
  }

  /// Changes a few words behind the metadata: to anything, by one, to another's, in one bit.
  void spoil(std::mt19937& random) {
    for (std::uint32_t changes = 1 + random() % 3; changes-- > 0;) {
      const AmtChunk& chosen = chunks()[1 + random() % (header().chunkCount - 1)];
      if (chosen.bytes < 4) continue;
      const auto words = array<std::uint32_t>(chosen.tag);
      std::uint32_t& word = words[random() % words.size()];
      switch (random() % 4) {
        case 0:
          word = static_cast<std::uint32_t>(random());
          break;
        case 1:
          word += static_cast<std::uint32_t>(random() % 3) - 1;
          break;
        case 2:
          word = words[random() % words.size()];
          break;
        default:
          word ^= 1u << random() % 32;
      }
    }
  }

  /// Recomputes the checksums: of segments, of the chunks that lie inside the file, and of the header.
  void seal() {
    sealSegments();
    for (std::uint32_t i = 0; i < header().chunkCount; ++i) {
      AmtChunk& c = chunks()[i];
      if (c.offset <= bytes_.size() && c.bytes <= bytes_.size() - c.offset)
        c.checksum = XXH3_64bits(bytes_.data() + c.offset, c.bytes);
    }
    sealHeader();
  }
  /// As many as there is room for.
  void sealSegments() {
    constexpr std::uint64_t kSegment = 65536;
    const std::uint32_t last = header().chunkCount - 1;
    if (last >= kAmtMaxChunks || chunks()[last].tag != amt_tag::kSegmentChecksums) return;
    std::vector<std::uint64_t> sums;
    for (std::uint32_t i = 0; i < last; ++i) {
      const AmtChunk& c = chunks()[i];
      if (c.tag == amt_tag::kMetadata || c.offset > bytes_.size() || c.bytes > bytes_.size() - c.offset)
        continue;
      for (std::uint64_t at = 0; at < c.bytes; at += kSegment)
        sums.push_back(XXH3_64bits(bytes_.data() + c.offset + at, std::min(kSegment, c.bytes - at)));
    }
    const auto room = array<std::uint64_t>(amt_tag::kSegmentChecksums);
    std::copy_n(sums.begin(), std::min(sums.size(), room.size()), room.begin());
  }
  void sealHeader() {
    std::string front(bytes_.data(), offsetof(AmtHeader, checksum));
    front.append(reinterpret_cast<const char*>(chunks()), header().chunkCount * sizeof(AmtChunk));
    header().checksum = XXH3_64bits(front.data(), front.size());
  }
  /// The same file as earlier builds of Arete wrote it: without its last chunk, the checksums of segments.
  AmtBytes withoutSegments() {
    if (chunks()[header().chunkCount - 1].tag != amt_tag::kSegmentChecksums)
      throw std::runtime_error("no such chunk");
    AmtHeader shorter = header();
    --shorter.chunkCount;
    shorter.directoryBytes = shorter.chunkCount * sizeof(AmtChunk);
    std::vector<AmtChunk> directory(chunks(), chunks() + shorter.chunkCount);
    std::string body(sizeof(AmtHeader) + shorter.directoryBytes, '\0');
    for (AmtChunk& chunk : directory) {
      body.resize(amtAligned(body.size()));
      const std::uint64_t from = chunk.offset;
      chunk.offset = body.size();
      body.append(bytes_, from, chunk.bytes);
    }
    body.resize(amtAligned(body.size()));
    shorter.fileBytes = body.size();
    std::memcpy(body.data(), &shorter, sizeof shorter);
    std::memcpy(body.data() + sizeof shorter, directory.data(), shorter.directoryBytes);
    AmtBytes without(std::move(body));
    without.sealHeader();
    return without;
  }

  const std::string& bytes() const { return bytes_; }
  void save(const std::string& path) const { writeAll(path, bytes_); }

 private:
  std::string bytes_;
};

}  // namespace arete::test
