// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/packed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/region.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "io/store/packed/nodes/layout.h"
#include "terrain/laws/validate_model.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::hills;
using test::readAll;
using test::TemporaryFolder;
using test::tinyModel;

RequiredError everywhere(double error) {
  return [error](const Box3&) { return error; };
}
RequiredError in(const Box2& box, double error) {
  return requiredInPlan([box, error](const Box2& packet) {
    const bool meets = packet.xMin <= box.xMax && packet.xMax >= box.xMin && packet.yMin <= box.yMax &&
                       packet.yMax >= box.yMin;
    return meets ? error : std::numeric_limits<double>::infinity();
  });
}

TerrainModel throughPacked(const TerrainModel& model, const std::string& path, int threads = 0) {
  RunContext context;
  context.threads = threads;
  const Status written = writeAmt(path, model, context, {.isPacked = true});
  if (!written) throw std::runtime_error(written.error().describe());
  return built(loadAmt(path, {}, context));
}

/// A triangle of any MT, told without a number of that MT.
using Corner = std::tuple<double, double, double>;
struct Facet {
  std::array<Corner, 3> corners;
  std::uint16_t error;
  auto operator<=>(const Facet&) const = default;
};
Facet facetOf(const MultiTriangulation& mt, std::uint32_t id) {
  Facet facet{{}, mt.arrays().error[id]};
  const auto corners = mt.corners(TriangleId(id));
  for (int c = 0; c < 3; ++c) {
    const Vec3 p = mt.position(VertexId(corners[c]));
    facet.corners[c] = {p.x, p.y, p.z};
  }
  std::rotate(facet.corners.begin(), std::min_element(facet.corners.begin(), facet.corners.end()),
              facet.corners.end());
  return facet;
}

/// A node without a number: its vertex, what it removes and makes, its saturated error.
struct Modification {
  Corner vertex;
  std::vector<Facet> floor, ceiling;
  std::uint16_t saturated = 0;
  auto operator<=>(const Modification&) const = default;
};
std::vector<Modification> modificationsOf(const MultiTriangulation& mt) {
  std::vector<Modification> all;
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
    const NodeId node(n);
    Modification m;
    const Vec3 p = mt.position(mt.apex(node));
    m.vertex = {p.x, p.y, p.z};
    for (const std::uint32_t t : mt.floor(node)) m.floor.push_back(facetOf(mt, t));
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i)
      m.ceiling.push_back(facetOf(mt, mt.slotTriangle(node, i).index()));
    std::sort(m.floor.begin(), m.floor.end());
    std::sort(m.ceiling.begin(), m.ceiling.end());
    m.saturated = mt.arrays().saturatedError[n];
    all.push_back(std::move(m));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::map<Facet, std::pair<double, double>> boundsOf(const MultiTriangulation& mt) {
  std::map<Facet, std::pair<double, double>> bounds;
  const MtArrays& a = mt.arrays();
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      bounds[facetOf(mt, t)] = {a.scale.decode(a.columns.of(kBelow)[t]),
                                a.scale.decode(a.columns.of(kAbove)[t])};
  return bounds;
}

std::vector<Facet> facetsOf(const MultiTriangulation& mt, const Cut& cut) {
  std::vector<Facet> facets;
  for (const std::uint32_t id : cut.ids) facets.push_back(facetOf(mt, id));
  std::sort(facets.begin(), facets.end());
  return facets;
}

const RasterFamily& familyNamed(std::string_view name) {
  return *std::ranges::find(rasterFamilies(), name,
                            [](const RasterFamily& f) { return std::string_view(f.name); });
}

void expectPacksWell(const TerrainModel& model) {
  const TemporaryFolder folder;
  const TerrainModel back = throughPacked(model, folder.file("packed.amt"));
  const Status laws = validateModel(back);
  EXPECT_TRUE(laws) << laws.error().describe();

  ASSERT_EQ(model.mt.nodeCount(), back.mt.nodeCount());
  EXPECT_EQ(model.mt.rootVertexCount(), back.mt.rootVertexCount());
  EXPECT_TRUE(std::ranges::equal(model.mt.arrays().rootTriangles, back.mt.arrays().rootTriangles));
  EXPECT_TRUE(modificationsOf(model.mt) == modificationsOf(back.mt));

  const auto before = boundsOf(model.mt), after = boundsOf(back.mt);
  for (const auto& [facet, was] : before) {
    const auto is = after.at(facet);
    ASSERT_GE(is.first, was.first);
    ASSERT_GE(is.second, was.second);
    const double quarter = 1.25 * (1 + 1e-6);
    ASSERT_LE(std::max(is.first, is.second), std::max(was.first, was.second) * quarter);
    ASSERT_LE(std::min(is.first, is.second),
              std::max(std::min(was.first, was.second) * 2.6, std::max(was.first, was.second) / 22));
  }

  for (const double tolerance : {0.0, 0.3, 1.0, 4.0, 20.0})
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const auto x = takeCut(model.mt, UniformError(tolerance), {.method = method});
      const auto y = takeCut(back.mt, UniformError(tolerance), {.method = method});
      ASSERT_TRUE(x && y);
      EXPECT_TRUE(facetsOf(model.mt, *x) == facetsOf(back.mt, *y)) << tolerance;
    }

  // The checks of plain files share no code with unpacking; and what was unpacked packs to the same bytes.
  ASSERT_TRUE(writeAmt(folder.file("plain.amt"), back));
  const Result<TerrainModel> plain = loadAmt(folder.file("plain.amt"));
  ASSERT_TRUE(plain) << plain.error().describe();
  for (const int threads : {1, 2, 4}) {
    test::expectSameModel(throughPacked(*plain, folder.file("again.amt"), threads), back);
    EXPECT_EQ(readAll(folder.file("packed.amt")), readAll(folder.file("again.amt"))) << threads << " threads";
  }
}

TEST(PackedAmt, HoldsEveryModificationOfEveryFamilyAndShape) {
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      SCOPED_TRACE(std::string(family.name) + ", seed 5");
      BuildOptions options;
      options.shape = shape;
      expectPacksWell(built(build(family.make(70, 50, 5), options)));
    }
}

TEST(PackedAmt, HoldsHeightsOfEveryKindAndHoles) {
  expectPacksWell(built(build(hills(40, 30, [](double z) { return std::round(z) + 0.0; }))));
  expectPacksWell(built(build(hills(40, 30, [](double z) { return double(float(z)); }))));
  expectPacksWell(built(build(hills(40, 30, [](double z) { return z; }))));
  BuildOptions rims;
  rims.rimTolerance = 3;
  expectPacksWell(built(build(hills(40, 30, [](double z) { return std::round(z) + 0.0; }), rims)));
}

TEST(PackedAmt, HoldsScatteredPoints) {
  for (const PointFamily& family : pointFamilies()) {
    SCOPED_TRACE(std::string(family.name) + ", seed 5");
    expectPacksWell(built(build(family.make(700, 5))));
  }
}

TEST(PackedAmt, OfManyTilesIsTheSameForAnyNumberOfThreads) {
  // 4 x 3 tiles: packets of every kind.
  expectPacksWell(built(build(familyNamed("fractal").make(420, 280, 7))));
}

TEST(PackedAmt, PutsAFlatSeaInSmallPackets) {
  // Nodes of the sea have no error, and the oldest of them have stars as wide as it is.
  const TemporaryFolder folder;
  const TerrainModel model =
      built(build(hills(900, 700, [](double z) { return std::max(200.0, std::round(z)); })));
  ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
  AmtBytes bytes = AmtBytes::of(folder.file("packed.amt"));
  std::string problem;
  const auto directory =
      packed::directoryOf(std::as_bytes(bytes.array<std::uint8_t>(amt_tag::kPackedDirectory)), problem);
  ASSERT_TRUE(directory) << problem;
  EXPECT_LT(directory->packets[0].nodes, model.mt.nodeCount() / 100);
  for (const packed::Packet& packet : directory->packets) EXPECT_LT(packet.nodes, 128u * 128u);
}

TEST(PackedAmt, HoldsAModelMadeByHand) {
  const TemporaryFolder folder;
  const TerrainModel model = tinyModel(), back = throughPacked(model, folder.file("tiny.amt"));
  EXPECT_TRUE(modificationsOf(model.mt) == modificationsOf(back.mt));
  ASSERT_EQ(back.isolated.size(), 1u);
  EXPECT_EQ(back.isolated[0].sample, 7u);
  EXPECT_EQ(back.options.fixedVertices, model.options.fixedVertices);
  EXPECT_EQ(back.georeference.verticalUnit, "ft");
}

TEST(PackedAmt, IsLessThanAnEighthOfThePlainFile) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(400, 300, [](double z) { return std::round(z) + 0.0; })));
  ASSERT_TRUE(writeAmt(folder.file("plain.amt"), model));
  throughPacked(model, folder.file("packed.amt"));
  EXPECT_LT(std::filesystem::file_size(folder.file("packed.amt")),
            std::filesystem::file_size(folder.file("plain.amt")) / 8);
}

TEST(PackedAmt, ReadsARegionAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("packed.amt");
  const TerrainModel whole = throughPacked(built(build(familyNamed("fractal").make(700, 500, 7))), path);
  const Box2 box{150, 140, 240, 230};
  AmtLoadOptions options;
  options.wanted = in(box, 0);
  const TerrainModel part = built(loadAmt(path, options));
  EXPECT_LT(part.mt.nodeCount(), whole.mt.nodeCount() / 2);
  const Status laws = validate(part.mt);
  EXPECT_TRUE(laws) << laws.error().describe();
  ASSERT_TRUE(writeAmt(folder.file("part.amt"), part));
  const Result<TerrainModel> checked = loadAmt(folder.file("part.amt"));
  EXPECT_TRUE(checked) << checked.error().describe();

  // Inside of the box every cut is that of the whole.
  const auto within = [&](const MultiTriangulation& mt, double tolerance) {
    const auto cut = takeCut(mt, UniformError(tolerance));
    std::vector<Facet> facets;
    for (const Facet& facet : facetsOf(mt, *cut)) {
      const bool isInside = std::ranges::all_of(facet.corners, [&](const Corner& c) {
        return std::get<0>(c) > box.xMin && std::get<0>(c) < box.xMax && std::get<1>(c) > box.yMin &&
               std::get<1>(c) < box.yMax;
      });
      if (isInside) facets.push_back(facet);
    }
    return facets;
  };
  EXPECT_TRUE(within(whole.mt, 0) == within(part.mt, 0));
}

TEST(PackedAmt, ReadsWhatCutsAtAnErrorAskForAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("packed.amt");
  std::uint64_t nodesOfAll = 0, nodesOfParts = 0;
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const std::string_view name = family.name;
      const TerrainModel whole = throughPacked(built(build(family.make(90, 80, 8), {.shape = shape})), path);
      const double range = whole.mt.arrays().scale.decode(OutwardScale::kMaxCode);
      std::uint32_t nodesBefore = whole.mt.nodeCount();
      for (const double least : {0.001 * range, 0.01 * range, 0.06 * range, range}) {
        AmtLoadOptions options;
        options.wanted = everywhere(least);
        const TerrainModel part = built(loadAmt(path, options));
        EXPECT_LE(part.mt.nodeCount(), nodesBefore);
        nodesBefore = part.mt.nodeCount();
        const Status laws = validate(part.mt);
        EXPECT_TRUE(laws) << name << ": " << laws.error().describe();
        ASSERT_TRUE(writeAmt(folder.file("part.amt"), part));
        const Result<TerrainModel> checked = loadAmt(folder.file("part.amt"));
        EXPECT_TRUE(checked) << checked.error().describe();
        for (const double allowed : {least, 1.7 * least, 5 * least})
          for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
            const auto x = takeCut(whole.mt, UniformError(allowed), {.method = method});
            const auto y = takeCut(part.mt, UniformError(allowed), {.method = method});
            ASSERT_TRUE(x && y);
            EXPECT_EQ(x->ids, y->ids) << name << ", " << allowed << " of " << least;
            EXPECT_EQ(x->triangles, y->triangles);
            EXPECT_EQ(x->vertices, y->vertices);
            EXPECT_EQ(x->achievedError, y->achievedError);
            EXPECT_TRUE(facetsOf(whole.mt, *x) == facetsOf(part.mt, *y));
          }
      }
      nodesOfAll += whole.mt.nodeCount();
      nodesOfParts += nodesBefore;
    }
  EXPECT_LT(nodesOfParts, nodesOfAll / 4);
}

/// What is read of the file down to an error keeps the laws and all minimal cuts of the whole that allow it.
void expectReadsDownTo(double least, const TerrainModel& whole, const std::string& path) {
  SCOPED_TRACE(least);
  AmtLoadOptions options;
  options.wanted = everywhere(least);
  const TerrainModel part = built(loadAmt(path, options));
  const Status laws = validate(part.mt, {.allowsFills = whole.options.rimTolerance > 0});
  EXPECT_TRUE(laws) << laws.error().describe();
  ASSERT_TRUE(writeAmt(path + ".part", part));
  const Result<TerrainModel> checked = loadAmt(path + ".part");
  EXPECT_TRUE(checked) << checked.error().describe();
  if (std::isnan(least) || least <= 0) {
    EXPECT_EQ(part.mt.nodeCount(), whole.mt.nodeCount());
  }
  const double allowed = std::isnan(least) ? 0 : std::max(least, 0.0);
  const RegionError corner(Region::box({0, 0, 9, 5}), whole.mt.arrays().metric, allowed, 2 * allowed + 1);
  const UniformError everywhere(allowed);
  for (const Criterion* const criterion :
       {static_cast<const Criterion*>(&corner), static_cast<const Criterion*>(&everywhere)}) {
    const auto x = takeCut(whole.mt, *criterion), y = takeCut(part.mt, *criterion);
    ASSERT_TRUE(x && y);
    EXPECT_EQ(x->ids, y->ids);
    EXPECT_EQ(x->vertices, y->vertices);
    EXPECT_TRUE(facetsOf(whole.mt, *x) == facetsOf(part.mt, *y));
  }
}

TEST(PackedAmt, ReadsWhateverTheLeastErrorIs) {
  const TemporaryFolder folder;
  const std::string path = folder.file("packed.amt");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const TerrainModel whole =
      throughPacked(built(build(hills(40, 30, [](double z) { return std::round(z) + 0.0; }))), path);
  for (const double least : {0.0, -1.0, -kInfinity, std::nan(""), std::numeric_limits<double>::denorm_min(),
                             1e-30, 1e300, kInfinity})
    expectReadsDownTo(least, whole, path);
}

TEST(PackedAmt, ReadsPointsRimsAndTheSmallestModelsDownToAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.file("packed.amt");
  const auto expectReads = [&](const TerrainModel& model) {
    const TerrainModel whole = throughPacked(model, path);
    const double largest = whole.mt.largestError();
    for (const double least : {0.003 * largest, 0.05 * largest, largest})
      expectReadsDownTo(least, whole, path);
  };
  for (const PointFamily& family : pointFamilies()) {
    SCOPED_TRACE(family.name);
    expectReads(built(build(family.make(700, 8))));
  }
  const auto whole = [](double z) { return std::round(z) + 0.0; };
  BuildOptions rims;
  rims.rimTolerance = 3;
  expectReads(built(build(hills(40, 30, whole), rims)));
  // Two root triangles that stay, and a node on a rim.
  for (const std::uint32_t columns : {2u, 3u, 5u}) expectReads(built(build(hills(columns, 2, whole))));
  expectPacksWell(built(build(hills(2, 2, whole))));
  expectReads(tinyModel());
}

TEST(PackedAmt, ReadsARegionAtAnErrorAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("packed.amt");
  const TerrainModel whole = throughPacked(built(build(familyNamed("fractal").make(500, 400, 9))), path);
  AmtLoadOptions options;
  const double least = 0.1 * whole.mt.arrays().scale.decode(OutwardScale::kMaxCode);
  options.wanted = everywhere(least);
  const TerrainModel coarse = built(loadAmt(path, options));
  options.wanted = in({10, 10, 90, 90}, least);
  const TerrainModel part = built(loadAmt(path, options));
  EXPECT_LT(part.mt.nodeCount(), coarse.mt.nodeCount());
  EXPECT_LT(coarse.mt.nodeCount(), whole.mt.nodeCount() / 2);
  const Status laws = validate(part.mt);
  EXPECT_TRUE(laws) << laws.error().describe();
}

/// Bytes changed one by one, `step` apart: what comes back is refused or holds to every check of plain files.
void expectRefusesOrSurvives(const TerrainModel& model, std::size_t step) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
  const AmtBytes original = AmtBytes::of(folder.file("packed.amt"));
  std::mt19937 random(3);
  int survived = 0, partsSurvived = 0;
  for (const AmtTag& tag : {amt_tag::kPackedDirectory, amt_tag::kPackedTables, amt_tag::kPackedNodes}) {
    AmtBytes first = original;
    const std::size_t size = first.array<std::uint8_t>(tag).size();
    const std::size_t stride = size > 600 ? step : 1;
    for (std::size_t at = 0; at < size; at += stride) {
      AmtBytes changed = original;
      changed.array<std::uint8_t>(tag)[at] ^= static_cast<std::uint8_t>(1u << random() % 8);
      // Recomputes the checksums of the packets too, as a forger can.
      std::string ignored;
      const auto bytes = std::as_bytes(changed.array<std::uint8_t>(amt_tag::kPackedDirectory));
      if (auto directory = packed::directoryOf(bytes, ignored)) {
        const auto nodes = changed.array<std::uint8_t>(amt_tag::kPackedNodes);
        for (packed::Packet& packet : directory->packets) {
          packed::Segment& all = packet.segments[0];
          if (all.begin() + all.bytes() <= nodes.size())
            all.checksum = XXH3_64bits(nodes.data() + all.begin(), all.bytes());
        }
        const auto sealed = packed::toBytes(*directory);
        if (sealed.size() == bytes.size())
          std::memcpy(changed.array<std::uint8_t>(amt_tag::kPackedDirectory).data(), sealed.data(),
                      sealed.size());
      }
      changed.seal();
      changed.save(folder.file("changed.amt"));
      AmtLoadOptions part;
      part.wanted = [](const Box3& box) { return box.low.x < 8 ? 2.0 : 6.0; };
      if (const Result<TerrainModel> some = loadAmt(folder.file("changed.amt"), part)) {
        ++partsSurvived;
        ASSERT_TRUE(writeAmt(folder.file("part.amt"), *some));
        const Result<TerrainModel> plain = loadAmt(folder.file("part.amt"));
        ASSERT_TRUE(plain) << at << ": " << plain.error().describe();
      }
      const Result<TerrainModel> back = loadAmt(folder.file("changed.amt"));
      if (!back) {
        EXPECT_FALSE(back.error().message.empty());
        continue;
      }
      ++survived;
      ASSERT_TRUE(writeAmt(folder.file("plain.amt"), *back));
      const Result<TerrainModel> plain = loadAmt(folder.file("plain.amt"));
      ASSERT_TRUE(plain) << at << ": " << plain.error().describe();
    }
  }
  testing::Test::RecordProperty("survived", survived);
  testing::Test::RecordProperty("parts survived", partsSurvived);
}

TEST(PackedAmt, RefusesOrSurvivesWhateverTheBytesAre) {
  expectRefusesOrSurvives(built(build(hills(24, 22, [](double z) { return std::round(z) + 0.0; }))), 3);
}

TEST(PackedAmt, RefusesOrSurvivesWhateverTheBytesOfSeveralPacketsAre) {
  // Long enough for tiles, whose packets leave triangles to each other.
  expectRefusesOrSurvives(built(build(hills(300, 4, [](double z) { return std::round(z) + 0.0; }))), 23);
}

TEST(PackedAmt, RefusesPacketsThatLeaveMoreOrLessThanTheyAnnounce) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(300, 4, [](double z) { return std::round(z) + 0.0; })));
  ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
  AmtBytes original = AmtBytes::of(folder.file("packed.amt"));
  std::string ignored;
  const auto bytes = std::as_bytes(original.array<std::uint8_t>(amt_tag::kPackedDirectory));
  const auto directory = packed::directoryOf(bytes, ignored);
  ASSERT_TRUE(directory);
  int changed = 0;
  for (std::size_t c = 0; c < directory->packets.size(); ++c)
    for (const int by : {-1, 1}) {
      packed::Directory other = *directory;
      if (other.packets[c].borders == 0) continue;
      other.packets[c].borders += static_cast<std::uint32_t>(by);
      const auto sealed = packed::toBytes(other);
      if (sealed.size() != bytes.size()) continue;
      AmtBytes file = original;
      std::memcpy(file.array<std::uint8_t>(amt_tag::kPackedDirectory).data(), sealed.data(), sealed.size());
      file.seal();
      file.save(folder.file("changed.amt"));
      const Result<TerrainModel> back = loadAmt(folder.file("changed.amt"));
      ASSERT_FALSE(back);
      EXPECT_NE(back.error().message.find("another number of triangles than announced"), std::string::npos)
          << back.error().message;
      ++changed;
    }
  EXPECT_GT(changed, 4);
}

TEST(PackedAmt, NamesThePacketThatWasAltered) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(24, 22, [](double z) { return z; })));
  ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
  AmtBytes changed = AmtBytes::of(folder.file("packed.amt"));
  changed.array<std::uint8_t>(amt_tag::kPackedNodes)[40] ^= 1;
  changed.seal();
  changed.save(folder.file("packed.amt"));
  const Result<TerrainModel> back = loadAmt(folder.file("packed.amt"));
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, ErrorCode::corrupt);
  EXPECT_NE(back.error().message.find("packet 0 of the packed nodes"), std::string::npos)
      << back.error().message;
}

TEST(PackedAmt, StopsWhenAskedTo) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(hills(60, 50, [](double z) { return z; })));
  ASSERT_TRUE(writeAmt(folder.file("packed.amt"), model, {}, {.isPacked = true}));
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const Result<TerrainModel> read = loadAmt(folder.file("packed.amt"), {AmtVerify::none, {}}, context);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
  const Status written = writeAmt(folder.file("new.amt"), model, context, {.isPacked = true});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::interrupted);
  EXPECT_FALSE(std::filesystem::exists(folder.file("new.amt")));
}

}  // namespace
}  // namespace arete
