// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paged files as a whole: what is read of them, whole and in part, against the model and against the packed
// form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"
#include "full_run.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "io/store/amt/index_check.h"
#include "io/store/format/metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/pages/directory_blocks.h"
#include "io/store/packed/pages/page_choice.h"
#include "terrain/laws/validate_model.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::hills;
using test::readAll;
using test::TemporaryFolder;

constexpr double kNotWanted = std::numeric_limits<double>::infinity();

/// A model in pages, in memory, that counts what is loaded of it.
struct Paged {
  explicit Paged(const TerrainModel& from)
      : model(from), metadata(amtMetadataOf(from, "test")), bytes(*packMt(from, {.isPaged = true})) {}

  Result<MultiTriangulation> read(const RequiredError& wanted = {}) {
    blocksLoaded = nodesLoaded = 0;
    calls = 0;
    return unpackMt(
        metadata, {bytes.directory, bytes.tables, bytes.blocks, bytes.nodes}, wanted, {},
        [this](std::span<const std::span<const std::byte>> parts) {
          ++calls;
          for (const auto part : parts)
            (part.data() >= bytes.nodes.data() && part.data() < bytes.nodes.data() + bytes.nodes.size()
                 ? nodesLoaded
                 : blocksLoaded) += part.size();
          return Status();
        });
  }

  TerrainModel model;
  AmtMetadata metadata;
  PackedMt bytes;
  std::size_t blocksLoaded = 0, nodesLoaded = 0;
  int calls = 0;
};

using PagedCorners = std::array<std::tuple<double, double, double>, 3>;
std::set<PagedCorners> triangleSet(const MultiTriangulation& mt, const Cut& cut) {
  std::set<PagedCorners> facets;
  for (const std::uint32_t id : cut.ids) {
    PagedCorners facet;
    const auto corners = mt.corners(TriangleId(id));
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p = mt.position(VertexId(corners[c]));
      facet[c] = {p.x, p.y, p.z};
    }
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    facets.insert(facet);
  }
  return facets;
}

/// The error that a criterion allows over a box of the plan and its heights.
RequiredError requiredOver(const BoundedCriterion& criterion, const MetricFrame& metric) {
  return [&criterion, metric](const Box3& box) {
    const Vec3 low = metric.toMetric(box.low), high = metric.toMetric(box.high), across = high - low;
    const Vec3 middle = low + across * 0.5;
    return criterion.allowedError(
        {float(middle.x), float(middle.y), float(middle.z), float(norm(across) / 2 * 1.001 + 1e-3)});
  };
}

std::vector<TerrainModel> pagedModels() {
  std::vector<TerrainModel> models;
  models.push_back(built(build(hills(300, 260, [](double z) { return std::round(z); }))));
  models.push_back(built(build(hills(150, 90, [](double z) { return z; }))));
  for (const PointFamily& family : pointFamilies()) models.push_back(built(build(family.make(700, 3))));
  return models;
}

TEST(Pages, HoldWhatThePackedFormHoldsAndPackToTheSameBytes) {
  const TemporaryFolder folder;
  std::vector<TerrainModel> models = pagedModels();
  for (const RasterFamily& family : rasterFamilies()) models.push_back(built(build(family.make(40, 30, 5))));
  for (const TerrainModel& model : models) {
    ASSERT_TRUE(writeAmt(folder.file("paged.amt"), model, {}, {.isPaged = true}));
    ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
    const TerrainModel back = built(loadAmt(folder.file("paged.amt")));
    const Status laws = validateModel(back);
    ASSERT_TRUE(laws) << laws.error().describe();
    EXPECT_TRUE(back.mt.arrays().missing.empty());
    ASSERT_TRUE(writeAmt(folder.file("again.amt"), back, {}, {.isPacked = true}));
    EXPECT_TRUE(readAll(folder.file("packed.amt")) == readAll(folder.file("again.amt")));
    // Boxes and spreads follow from bounds and balls, which packing rounds: from then on they stay.
    ASSERT_TRUE(writeAmt(folder.file("second.amt"), back, {}, {.isPaged = true}));
    const TerrainModel second = built(loadAmt(folder.file("second.amt")));
    for (const int threads : {1, 2, 5}) {
      RunContext context;
      context.threads = threads;
      ASSERT_TRUE(writeAmt(folder.file("third.amt"), second, context, {.isPaged = true}));
      EXPECT_TRUE(readAll(folder.file("second.amt")) == readAll(folder.file("third.amt"))) << threads;
    }
  }
}

// Heights in whole units have many equal errors, and nodes are numbered anew.
TEST(Pages, HaveTheCutsOfThePlainModelWithinAnyBudgetHoweverManyErrorsAreEqual) {
  std::vector<TerrainModel> models = pagedModels();
  for (const RasterFamily& family : rasterFamilies()) models.push_back(built(build(family.make(40, 30, 5))));
  for (const TerrainModel& model : models) {
    const auto back = Paged(model).read();
    ASSERT_TRUE(back) << back.error().describe();
    const std::uint32_t roots = model.mt.rootTriangleCount(), finest = model.mt.finestTriangleCount();
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated})
      for (std::uint32_t i = 0; i <= 12; ++i) {
        const CutOptions options{.method = method, .maxTriangles = roots + (finest - roots) / 13 * i};
        const auto plain = takeCut(model.mt, UniformError(0), options);
        const auto paged = takeCut(*back, UniformError(0), options);
        ASSERT_TRUE(plain && paged);
        EXPECT_TRUE(triangleSet(model.mt, *plain) == triangleSet(*back, *paged))
            << model.source << ", at most " << *options.maxTriangles;
      }
  }
}

TEST(Pages, ThatAPlaceNeedsHaveItsCutsAndNothingMissing) {
  for (const TerrainModel& model : pagedModels()) {
    Paged paged(model);
    const auto whole = paged.read();
    ASSERT_TRUE(whole) << whole.error().describe();
    const std::size_t all = paged.nodesLoaded;
    Box3 box = Box3::empty();
    for (std::uint32_t v = 0; v < whole->vertexCount(); ++v)
      box.include(whole->metric().toMetric(whole->position(VertexId(v))));
    for (unsigned seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(fmt::format("{}, seed {}", model.source, seed));
      std::mt19937 random(seed);
      const auto between = [&](double a, double b) {
        return a + (b - a) * double(random()) / double(std::mt19937::max());
      };
      DistanceError::Options options;
      options.place = {between(box.low.x, box.high.x), between(box.low.y, box.high.y),
                       between(box.low.z, box.high.z)};
      options.inPlan = seed % 2 == 0;
      const double most = whole->largestError();
      options.nearError = most * std::exp2(-between(2, 9));
      options.growth = most / box.diagonal() * std::exp2(between(-2, 4));
      if (seed % 3 == 0) options.farError = most / 4;
      const DistanceError criterion(options);
      const auto part = paged.read(requiredOver(criterion, whole->metric()));
      ASSERT_TRUE(part) << part.error().describe();
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto x = takeCut(*whole, criterion, {.method = method}),
                   y = takeCut(*part, criterion, {.method = method});
        ASSERT_TRUE(x && y);
        EXPECT_TRUE(y->missing.empty());
        // Balls of a part are larger: what depends on them (saturated cuts; distances in space to what a
        // triangle stands for, which its ball need not hold) is refined as far or farther.
        if (method == CutMethod::minimal && options.inPlan) {
          EXPECT_TRUE(triangleSet(*whole, *x) == triangleSet(*part, *y));
        }
        EXPECT_GE(double(y->ids.size()), 0.99 * double(x->ids.size()));
        for (std::size_t i = 0; i < y->ids.size(); ++i) {
          Criterion::Corners corners = y->triangles[i];
          for (std::uint32_t& corner : corners) corner = y->vertices[corner];
          ASSERT_TRUE(isSatisfied(*part, criterion, TriangleId(y->ids[i]), corners) ||
                      !part->remover(TriangleId(y->ids[i])).isValid());
        }
      }
      const Status laws = validate(*part);
      ASSERT_TRUE(laws) << laws.error().describe();
    }
    if (!model.isRaster || model.columns != 300) continue;
    ASSERT_TRUE(
        paged.read(requiredInPlan([](const Box2& b) { return b.xMin < 9 && b.yMin < 9 ? 0 : kNotWanted; })));
    EXPECT_LT(paged.nodesLoaded, all / 2);
  }
}

TEST(Pages, SayWhatIsMissingWhereTooLittleWasRead) {
  Paged paged(built(build(hills(300, 260, [](double z) { return std::round(z); }))));
  const auto whole = paged.read();
  const double most = whole->largestError();
  const auto part = paged.read([most](const Box3& box) { return box.low.x < 100 ? most / 50 : kNotWanted; });
  ASSERT_TRUE(part);
  const UniformError criterion(most / 50);
  const auto cut = takeCut(*part, criterion);
  ASSERT_TRUE(cut);
  ASSERT_FALSE(cut->missing.empty());
  for (const std::uint32_t t : cut->missing) {
    EXPECT_GT(part->error(TriangleId(t)), most / 50);
    EXPECT_FALSE(part->remover(TriangleId(t)).isValid());
    EXPECT_TRUE(std::ranges::binary_search(cut->ids, t));
  }
  // Every triangle that is too coarse is missing its remover: the whole has one.
  std::size_t coarse = 0;
  for (const std::uint32_t t : cut->ids) coarse += part->error(TriangleId(t)) > most / 50;
  EXPECT_EQ(coarse, cut->missing.size());
  // A budget that ends before it comes to one of them misses nothing.
  const auto few = takeCut(*part, UniformError(0), {.maxTriangles = part->rootTriangleCount() + 6});
  ASSERT_TRUE(few);
  const auto same = takeCut(*whole, UniformError(0), {.maxTriangles = part->rootTriangleCount() + 6});
  if (few->missing.empty()) {
    EXPECT_TRUE(triangleSet(*whole, *same) == triangleSet(*part, *few));
  }
}

TEST(Pages, OfACoarseQuestionAreReadInPart) {
  Paged paged(built(build(hills(280, 240, [](double z) { return std::round(z); }))));
  const auto whole = paged.read();
  const std::size_t all = paged.nodesLoaded;
  EXPECT_EQ(all, paged.bytes.nodes.size());
  const double most = whole->largestError();
  std::size_t before = all;
  for (const double part : {0.02, 0.1, 0.5}) {
    const double error = most * part;
    const auto read = paged.read([error](const Box3&) { return error; });
    ASSERT_TRUE(read);
    EXPECT_LT(paged.nodesLoaded, before);
    before = paged.nodesLoaded;
    const auto x = takeCut(*whole, UniformError(error)), y = takeCut(*read, UniformError(error));
    EXPECT_TRUE(x->ids == y->ids && x->vertices == y->vertices);
    EXPECT_TRUE(y->missing.empty());
  }
  const auto root = paged.read([](const Box3&) { return kNotWanted; });
  ASSERT_TRUE(root);
  EXPECT_EQ(root->nodeCount(), 0u);
  EXPECT_LT(paged.nodesLoaded, all / 10);
}

TEST(Pages, AreNamedWhereABitIsFlippedAndTheRestStaysReadable) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(280, 240, [](double z) { return std::round(z); })));
  ASSERT_TRUE(writeAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
  const AmtBytes original = AmtBytes::of(folder.file("a.amt"));
  // The last page holds nodes of the last tile.
  AmtBytes changed = original;
  changed.array<std::uint8_t>(amt_tag::kPackedNodes).back() ^= 4;
  changed.seal();
  changed.save(folder.file("b.amt"));
  const auto all = loadAmt(folder.file("b.amt"));
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, ErrorCode::corrupt);
  EXPECT_NE(all.error().message.find("page "), std::string::npos) << all.error().message;
  EXPECT_NE(all.error().message.find("has been altered"), std::string::npos) << all.error().message;
  const auto rest =
      loadAmt(folder.file("b.amt"),
              {.verify = AmtVerify::all, .open = {}, .wanted = requiredInPlan([](const Box2& b) {
                                                       return b.xMin < 40 && b.yMin < 40 ? 0 : kNotWanted;
                                                     })});
  ASSERT_TRUE(rest) << rest.error().describe();
  EXPECT_GT(rest->mt.nodeCount(), 1000u);
}

/// Bits changed one by one with all checksums made anew, as a forger can: what comes back is refused, or
/// holds to every check of plain files. ARETE_FULL=1 changes each bit, 10^5 files; else one of about each
/// 31st byte.
TEST(Pages, AreRefusedOrSurviveWhateverTheirBytesAre) {
  int damaged = 0;
  for (const TerrainModel& model : {built(build(hills(24, 22, [](double z) { return std::round(z) + 0.0; }))),
                                    built(build(hills(150, 4, [](double z) { return std::round(z) + 0.0; }))),
                                    built(build(hills(18, 16, [](double z) { return z; })))}) {
    const Paged original(model);
    std::mt19937 random(3);
    int survived = 0, tried = 0;
    const auto tryOne = [&](const PackedMt& bytes, const RequiredError& wanted) {
      ++tried;
      const auto mt = unpackMt(original.metadata, {bytes.directory, bytes.tables, bytes.blocks, bytes.nodes},
                               wanted, {}, {});
      if (!mt) {
        EXPECT_FALSE(mt.error().message.empty());
        return;
      }
      ++survived;
      const Status sound = checkMtIndices(*mt, std::uint64_t{model.columns} * model.rows);
      ASSERT_TRUE(sound) << sound.error().describe();
      // The checks of a file are those of its indices and a few more, and take longer.
      if (test::isFull() && survived % 100 != 1) return;
      TerrainModel some = model;
      some.mt = *mt;
      const TemporaryFolder folder;
      ASSERT_TRUE(writeAmt(folder.file("part.amt"), some));
      const Result<TerrainModel> plain = loadAmt(folder.file("part.amt"));
      ASSERT_TRUE(plain) << plain.error().describe();
    };
    const std::size_t bits = 8 * (original.bytes.directory.size() + original.bytes.blocks.size() +
                                  original.bytes.tables.size() + original.bytes.nodes.size());
    for (std::size_t at = 0; at < bits; at += test::isFull() ? 1 : 1 + random() % (61 * 8)) {
      PackedMt bytes = original.bytes;
      std::size_t place = at / 8;
      ++damaged;
      for (auto* chunk : {&bytes.directory, &bytes.blocks, &bytes.tables, &bytes.nodes}) {
        if (place < chunk->size()) {
          (*chunk)[place] ^= std::byte(1u << at % 8);
          break;
        }
        place -= chunk->size();
      }
      // Seals the segments, then the block, then its entry in the root.
      std::string ignored;
      if (auto root = packed::pageRootOf(bytes.directory, ignored); root && root->levels == 1) {
        packed::BlockEntry& entry = root->entries[0];
        if (entry.offset == 0 && entry.bytes <= bytes.blocks.size())
          if (auto pages = packed::pagesOf(std::span(bytes.blocks).first(entry.bytes), entry, 0)) {
            for (packed::Packet& page : *pages)
              for (packed::Segment& segment : page.segments) {
                if (segment.begin() + segment.bytes() > bytes.nodes.size()) continue;
                const std::uint64_t sum = XXH3_64bits(bytes.nodes.data() + segment.begin(), segment.bytes());
                // Where the checksum lies in the block is found by its old value.
                const auto old = std::as_bytes(std::span(&segment.checksum, 1)),
                           fresh = std::as_bytes(std::span(&sum, 1));
                const auto found = std::ranges::search(bytes.blocks, old).begin();
                if (found != bytes.blocks.end()) std::ranges::copy(fresh, found);
              }
            const std::uint64_t sum = XXH3_64bits(bytes.blocks.data(), entry.bytes);
            const auto old = std::as_bytes(std::span(&entry.checksum, 1)),
                       fresh = std::as_bytes(std::span(&sum, 1));
            const auto found = std::ranges::search(bytes.directory, old).begin();
            if (found != bytes.directory.end()) std::ranges::copy(fresh, found);
          }
      }
      tryOne(bytes, {});
      tryOne(bytes, [](const Box3& box) { return box.low.x < 8 ? 2.0 : 6.0; });
    }
    RecordProperty("survived", survived);
    EXPECT_GT(tried, 100);
  }
  if (test::isFull()) {
    EXPECT_GE(damaged, 100'000);
  }
}

TEST(Pages, AreRefusedWhereTheirOffsetWrapsAround) {
  const Paged original(built(build(hills(24, 22, [](double z) { return std::round(z) + 0.0; }))));
  std::string ignored;
  const auto root = packed::pageRootOf(original.bytes.directory, ignored);
  ASSERT_TRUE(root && root->levels == 1);
  const packed::BlockEntry& entry = root->entries[0];
  auto pages = packed::pagesOf(std::span(original.bytes.blocks).first(entry.bytes), entry, 0);
  ASSERT_TRUE(pages);
  packed::Directory forged;
  forged.bandClass = root->bandClass;
  forged.packets = *pages;
  for (packed::Packet& page : forged.packets) {
    page.runs.resize(1);
    for (packed::Segment& segment : page.segments) segment.offset -= 10;
  }
  packed::Run& all = forged.packets[0].runs[0];
  all.band = forged.packets[0].segments[0].firstBand;
  all.nodes = static_cast<std::uint32_t>(original.metadata.counts.nodes);
  all.slots = static_cast<std::uint32_t>(original.metadata.counts.slots);
  const packed::PageDirectoryBytes bytes = packed::pageDirectoryBytes(forged);
  const auto mt = unpackMt(
      original.metadata, {bytes.root, original.bytes.tables, bytes.blocks, original.bytes.nodes}, {}, {}, {});
  ASSERT_FALSE(mt);
  EXPECT_EQ(mt.error().message, "page 0: lies behind the end");
}

TEST(Pages, HaveTheRootOfTheirDirectoryInTheFirstSixteenKibibytes) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(280, 240, [](double z) { return std::round(z); })));
  ASSERT_TRUE(writeAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
  const auto file = openAmt(folder.file("a.amt"));
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->isPaged() && file->isPacked());
  const AmtChunk* const root = file->container().find(amt_tag::kPageRoot);
  EXPECT_LE(root->offset + root->bytes, 16u << 10);
}

}  // namespace
}  // namespace arete
