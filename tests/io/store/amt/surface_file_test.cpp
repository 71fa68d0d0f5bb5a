// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/surface_file.h"
#include "io/query/surface/write_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <tuple>

#include "engine/base/vec.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "surface/builder/build.h"
#include "surface/displacement/find_displacement.h"
#include "surface/families.h"
#include "surface/front/front.h"
#include "surface/mesh_with_everything.h"
#include "surface/laws/validate_surface.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class SurfaceAmt : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-surface-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string contentOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  fs::path folder_;
};

/// Built, and displaced.
Result<SurfaceModel> displaced(const SurfaceMesh& mesh) {
  Result<SurfaceModel> model = buildSurface(mesh);
  if (model) model->displacement = *findDisplacement(*model);
  return model;
}

void expectEqual(const SurfaceModel& a, const SurfaceModel& b) {
  const MtArrays &x = a.mt.arrays(), &y = b.mt.arrays();
  EXPECT_TRUE(std::ranges::equal(x.rootTriangles, y.rootTriangles));
  EXPECT_TRUE(std::ranges::equal(x.slotBegin, y.slotBegin));
  EXPECT_TRUE(std::ranges::equal(x.link, y.link));
  EXPECT_TRUE(std::ranges::equal(x.remover, y.remover));
  EXPECT_TRUE(std::ranges::equal(x.error, y.error));
  EXPECT_TRUE(std::ranges::equal(x.columns.of(kRms), y.columns.of(kRms)));
  EXPECT_TRUE(std::ranges::equal(x.floor, y.floor));
  EXPECT_TRUE(std::ranges::equal(x.saturatedError, y.saturatedError));
  EXPECT_EQ(x.scale.base(), y.scale.base());
  EXPECT_EQ(x.metric.origin, y.metric.origin);
  for (std::uint32_t v = 0; v < a.mt.vertexCount(); ++v)
    ASSERT_EQ(a.mt.position(VertexId(v)), b.mt.position(VertexId(v)));
  EXPECT_EQ(a.attributes, b.attributes);
  EXPECT_EQ(a.vertexOf, b.vertexOf);
  EXPECT_EQ(a.faceOf, b.faceOf);
  EXPECT_EQ(a.wedgesOf, b.wedgesOf);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.diagonal, b.diagonal);
  EXPECT_EQ(a.mending, b.mending);
  EXPECT_EQ(a.options, b.options);
  EXPECT_EQ(a.sourceVertices, b.sourceVertices);
  EXPECT_EQ(a.sourceFaces, b.sourceFaces);
  EXPECT_EQ(a.fileFaces, b.fileFaces);
  EXPECT_EQ(a.leftOutFaces, b.leftOutFaces);
  EXPECT_EQ(a.positionError, b.positionError);
  EXPECT_EQ(a.boundsLines, b.boundsLines);
  EXPECT_EQ(a.levels, b.levels);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.sourceChecksum, b.sourceChecksum);
  EXPECT_EQ(a.verticalUnit, b.verticalUnit);
  EXPECT_EQ(a.crsWkt, b.crsWkt);
  EXPECT_EQ(a.up, b.up);
}

TEST_F(SurfaceAmt, GivesBackEveryBitOfAModel) {
  for (const bool hasDoubles : {false, true})
    for (const bool isPlain : {false, true}) {
      const SurfaceMesh mesh = isPlain ? SurfaceMesh(shapes::everything(hasDoubles).shape()) : shapes::everything(hasDoubles);
      Result<SurfaceModel> model = isPlain ? buildSurface(mesh) : displaced(mesh);
      ASSERT_TRUE(model) << model.error().message;
      model->source = "a scan.ply";
      model->sourceChecksum = "xxh3-128:01";
      model->verticalUnit = "ft";
      model->fileFaces = model->sourceFaces / 2;
      model->up = "y";
      ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model));
      EXPECT_TRUE(AmtContainer::open(path("a.amt"))->isOfSurface());
      const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read->mt.vertices().places64.empty(), !hasDoubles);
      expectEqual(*model, *read);
      ASSERT_TRUE(writeSurfaceAmt(path("b.amt"), *read));
      EXPECT_EQ(contentOf(path("a.amt")), contentOf(path("b.amt")));
    }
}

/// A triangle by what it is, not by its number: its corners as vertices of the source with their place and
/// texture coordinates, from the least; its codes; its face; its reach.
using NumberFreeTriangle =
    std::tuple<std::array<std::tuple<std::uint32_t, double, double, double, double, double>, 3>,
               std::uint16_t, std::uint16_t, std::uint32_t, bool, int>;

/// By vertex of the source.
std::map<std::uint32_t, Vec3> directionsOf(const SurfaceModel& model) {
  std::map<std::uint32_t, Vec3> directions;
  if (!model.displacement.isEmpty())
    for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v)
      directions[model.vertexOf[v]] = model.displacement.direction(v);
  return directions;
}

std::vector<NumberFreeTriangle> trianglesOf(const SurfaceModel& model) {
  const MultiTriangulation& mt = model.mt;
  std::vector<NumberFreeTriangle> all;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    const NodeId creator = mt.creator(TriangleId(t)), remover = mt.remover(TriangleId(t));
    if (creator.isValid() && creator == remover) continue;
    NumberFreeTriangle one;
    const auto corners = mt.corners(TriangleId(t));
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p = mt.position(VertexId(corners[c]));
      double u = 0, v = 0;
      if (model.hasWedges()) {
        const auto texcoord = model.attributes.wedgeAttributes[0].numbers(model.wedgesOf[t][c]);
        u = texcoord[0];
        v = texcoord[1];
      }
      std::get<0>(one)[c] = {model.vertexOf[corners[c]], p.x, p.y, p.z, u, v};
    }
    auto& around = std::get<0>(one);
    std::rotate(around.begin(), std::ranges::min_element(around), around.end());
    std::get<1>(one) = mt.arrays().error[t];
    std::get<2>(one) = mt.arrays().columns.of(kRms)[t];
    // Of coarse triangles without faces of their own, any face that they stand for.
    std::get<3>(one) = !remover.isValid() || model.hasFaceAttributes() ? model.faceOf[t] : 0;
    std::get<4>(one) = remover.isValid();
    std::get<5>(one) = model.displacement.isEmpty() ? 0 : model.displacement.reaches[t];
    all.push_back(one);
  }
  std::ranges::sort(all);
  return all;
}

TEST_F(SurfaceAmt, PackedGivesBackTheSameTrianglesInAnotherOrder) {
  RunContext oneThread;
  oneThread.threads = 1;
  for (const bool hasDoubles : {false, true})
    for (const bool isPlain : {false, true}) {
      const SurfaceMesh mesh = isPlain ? SurfaceMesh(shapes::everything(hasDoubles).shape()) : shapes::everything(hasDoubles);
      Result<SurfaceModel> model = isPlain ? buildSurface(mesh) : displaced(mesh);
      ASSERT_TRUE(model) << model.error().message;
      ASSERT_TRUE(writeSurfaceAmt(path("plain.amt"), *model));
      ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model, {}, {.isPacked = true}));
      EXPECT_TRUE(AmtContainer::open(path("a.amt"))->isOfSurface());
      EXPECT_TRUE(AmtContainer::open(path("a.amt"))->isPacked());
      EXPECT_LT(2 * fs::file_size(path("a.amt")), fs::file_size(path("plain.amt")));
      const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read->mt.vertices().places64.empty(), !hasDoubles);
      EXPECT_EQ(read->positionError, 0);
      EXPECT_EQ(trianglesOf(*read), trianglesOf(*model));
      EXPECT_EQ(directionsOf(*read), directionsOf(*model));
      EXPECT_EQ(read->attributes.triangleAttributes, model->attributes.triangleAttributes);
      EXPECT_EQ(read->attributes.materials, model->attributes.materials);
      EXPECT_EQ(read->attributes.pictures, model->attributes.pictures);
      EXPECT_TRUE(validateSurface(*read)) << validateSurface(*read).error().message;
      // What was unpacked packs to the same bytes, and plain to the same model.
      ASSERT_TRUE(writeSurfaceAmt(path("b.amt"), *read, oneThread, {.isPacked = true}));
      EXPECT_EQ(contentOf(path("a.amt")), contentOf(path("b.amt")));
      ASSERT_TRUE(writeSurfaceAmt(path("plain.amt"), *read));
      expectEqual(*read, *loadSurfaceAmt(path("plain.amt")));
    }
}

// What an earlier version wrote has the first level alone.
TEST_F(SurfaceAmt, GivesBackTheErrorsOfAttributesAtEveryDistanceAndReadsThoseOfEarlierVersions) {
  Result<SurfaceModel> model = buildSurface(shapes::everything(true), {.boundsAttributes = true});
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_FALSE(model->attributeDistances.empty());
  for (const bool isEarlier : {false, true}) {
    if (isEarlier) {
      model->attributeDistances.clear();
      for (AttributeErrors& errors : model->attributeErrors) errors.codes.resize(model->mt.triangleIdCount());
    }
    ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model));
    const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->attributeDistances, model->attributeDistances);
    EXPECT_EQ(read->attributeErrors, model->attributeErrors);
    // Packed, triangles have another order: every level has that.
    ASSERT_TRUE(writeSurfaceAmt(path("p.amt"), *model, {}, {.isPacked = true}));
    const Result<SurfaceModel> packed = loadSurfaceAmt(path("p.amt"));
    ASSERT_TRUE(packed) << packed.error().message;
    const auto rows = [](const SurfaceModel& m) {
      std::vector<std::vector<std::uint16_t>> all(m.mt.triangleIdCount());
      for (const AttributeErrors& errors : m.attributeErrors)
        for (std::size_t i = 0; i < errors.codes.size(); ++i) all[i % all.size()].push_back(errors.codes[i]);
      std::ranges::sort(all);
      return all;
    };
    EXPECT_EQ(packed->attributeDistances, model->attributeDistances);
    EXPECT_EQ(rows(*packed), rows(*model));
  }
}

TEST_F(SurfaceAmt, PackedIsTheSameForEveryFamily) {
  for (const shapes::NamedMesh& family : shapes::families(5)) {
    SCOPED_TRACE(family.name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(family.mesh));
    ASSERT_TRUE(model);
    ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model, {}, {.isPacked = true}));
    const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(trianglesOf(*read), trianglesOf(*model));
    EXPECT_TRUE(validateSurface(*read)) << validateSurface(*read).error().message;
    for (const double error : {model->mt.largestError() / 3, model->mt.largestError() / 40})
      EXPECT_EQ(takeCut(model->mt, UniformError(error), {})->triangles.size(),
                takeCut(read->mt, UniformError(error), {})->triangles.size());
  }
}

TEST_F(SurfaceAmt, RoundedKeepsEveryLawAndSaysHowFarItsVerticesMoved) {
  for (const shapes::NamedMesh& family : shapes::families(6)) {
    SCOPED_TRACE(family.name);
    const Result<SurfaceModel> model = displaced(SurfaceMesh(family.mesh));
    ASSERT_TRUE(model);
    for (const int bits : {8, 12, 16}) {
      ASSERT_TRUE(writeSurfaceModel(path("a.amt"), *model, {}, {.isPacked = true, .positionBits = bits}));
      const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_FALSE(read->displacement.isEmpty());
      EXPECT_TRUE(validateSurface(*read, {.everySample = true}))
          << validateSurface(*read, {.everySample = true}).error().message;
      std::map<std::uint32_t, Vec3> placeOf;
      for (std::uint32_t v = 0; v < model->mt.vertexCount(); ++v)
        placeOf[model->vertexOf[v]] = model->mt.position(VertexId(v));
      double moved = 0;
      for (std::uint32_t v = 0; v < read->mt.vertexCount(); ++v)
        moved = std::max(moved, norm(read->mt.position(VertexId(v)) - placeOf[read->vertexOf[v]]));
      EXPECT_LE(moved, read->positionError);
      EXPECT_LE(read->positionError, moved * (1 + 1e-12));
      EXPECT_LE(moved, 2 * model->diagonal / std::ldexp(1, bits));
      // Rounding again moves nothing.
      ASSERT_TRUE(writeSurfaceModel(path("b.amt"), *read, {}, {.isPacked = true, .positionBits = bits}));
      EXPECT_EQ(contentOf(path("a.amt")), contentOf(path("b.amt")));
    }
  }
}

/// Every fiftieth face twice, and as many faces without area.
SurfaceMesh withLeftOutFaces() {
  SurfaceMesh mesh(shapes::hills(16, 4));
  const std::vector<std::array<std::uint32_t, 3>> faces = mesh.triangles;
  for (std::size_t f = 0; f < faces.size(); f += 50) {
    mesh.triangles.push_back(faces[f]);
    mesh.triangles.push_back({faces[f][0], faces[f][0], faces[f][1]});
  }
  return mesh;
}

TEST_F(SurfaceAmt, KeepsTheFacesThatWereLeftOutPlainAndPacked) {
  Result<SurfaceModel> model = buildSurface(withLeftOutFaces());
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->leftOutFaces.size(), model->mending.duplicateFaces + model->mending.degenerateFaces);
  ASSERT_GT(model->leftOutFaces.size(), 10u);
  model->fileFaces = 77;
  for (const SurfaceWriteOptions& options : {SurfaceWriteOptions{}, SurfaceWriteOptions{.isPacked = true},
                                             SurfaceWriteOptions{.isPacked = true, .positionBits = 12}}) {
    ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model, {}, options));
    EXPECT_NE(contentOf(path("a.amt")).find("LEFT"), std::string::npos);
    const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->leftOutFaces, model->leftOutFaces);
    EXPECT_EQ(read->fileFaces, 77u);
    EXPECT_EQ(read->mending, model->mending);
    EXPECT_TRUE(validateSurface(*read));
    ASSERT_TRUE(writeSurfaceAmt(path("b.amt"), *read, {}, options));
    EXPECT_EQ(contentOf(path("a.amt")), contentOf(path("b.amt")));
  }
  model->leftOutFaces.clear();
  ASSERT_TRUE(writeSurfaceAmt(path("c.amt"), *model));
  EXPECT_EQ(contentOf(path("c.amt")).find("LEFT"), std::string::npos);
  EXPECT_TRUE(loadSurfaceAmt(path("c.amt"))->leftOutFaces.empty());
}

TEST_F(SurfaceAmt, IsRefusedWhereFacesThatWereLeftOutAreThereOrLieNowhere) {
  const Result<SurfaceModel> model = buildSurface(withLeftOutFaces());
  ASSERT_TRUE(model) << model.error().message;
  const auto sourceFaces = static_cast<std::uint32_t>(model->sourceFaces);
  const std::uint32_t out = model->leftOutFaces[3].face, in = model->leftOutFaces[3].in;
  using Left = SurfaceModel::LeftOutFace;
  const std::pair<const char*, std::vector<Left>> wrong[] = {
      {"lies in one that the source does not have", {{sourceFaces, in}}},
      {"lies in one that the source does not have", {{out, 0xFFFFFFFF}}},
      {"are not in the order of their numbers", {{out, in}, {out, in}}},
      {"are not in the order of their numbers", {{model->leftOutFaces[4].face, in}, {out, in}}},
      {"face 0 is left out and is there", {{0, in}}},
      {"which is not there", {{out, model->leftOutFaces[4].face}}},
  };
  for (const auto& [sentence, faces] : wrong) {
    SurfaceModel changed = *model;
    changed.leftOutFaces = faces;
    const Status valid = changed.validate();
    ASSERT_FALSE(valid) << sentence;
    EXPECT_NE(valid.error().message.find(sentence), std::string::npos) << valid.error().message;
    // What cannot be written can still lie in a file.
    changed.leftOutFaces = {model->leftOutFaces.begin(),
                            model->leftOutFaces.begin() + std::ptrdiff_t(faces.size())};
    ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), changed));
    test::AmtBytes bytes = test::AmtBytes::of(path("a.amt"));
    std::ranges::copy(faces, bytes.array<Left>(amt_tag::kLeftOutFaces).begin());
    bytes.seal();
    bytes.save(path("a.amt"));
    const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
    ASSERT_FALSE(read) << sentence;
    EXPECT_EQ(read.error().code, ErrorCode::corrupt);
    EXPECT_NE(read.error().message.find(sentence), std::string::npos) << read.error().message;
  }
}

TEST_F(SurfaceAmt, IsRefusedWhereItStatesFacesThatNothingInItCanHold) {
  const Result<SurfaceModel> model = buildSurface(shapes::everything(false));
  ASSERT_TRUE(model);
  ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model));
  test::AmtBytes bytes = test::AmtBytes::of(path("a.amt"));
  const std::string text = bytes.metadata();
  const std::size_t at = text.find("\"sourceVertices\""), end = text.find('}', at);
  bytes.replaceInMetadata(text.substr(at, end - at), "\"sourceVertices\":999,\"sourceFaces\":4294967294");
  bytes.seal();
  bytes.save(path("a.amt"));
  const Result<SurfaceModel> read = loadSurfaceAmt(path("a.amt"));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::corrupt);
  EXPECT_NE(read.error().message.find("too few for hasObjects of 4294967294 faces"), std::string::npos)
      << read.error().message;
}

TEST_F(SurfaceAmt, OfDisplacementsIsNotWrittenWithPlacesThatRoundingMoves) {
  const Result<SurfaceModel> model = displaced(SurfaceMesh(shapes::globe(12, 6)));
  ASSERT_TRUE(model);
  const Status written = writeSurfaceAmt(path("a.amt"), *model, {}, {.isPacked = true, .positionBits = 8});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::invalidData);
  const Result<SurfaceModel> rounded = roundSurface(*model, 8);
  ASSERT_TRUE(rounded);
  EXPECT_TRUE(rounded->displacement.isEmpty());
  EXPECT_GT(rounded->positionError, 0);
}

TEST_F(SurfaceAmt, IsRefusedWhereTerrainIsWantedAndTheOtherWay) {
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(shapes::globe(12, 6)));
  ASSERT_TRUE(model);
  ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model));
  const Result<AmtFile> terrain = openAmt(path("a.amt"));
  ASSERT_FALSE(terrain);
  EXPECT_EQ(terrain.error().message, "is of a surface, and terrain is wanted here");
}

TEST_F(SurfaceAmt, SaysSoWhateverByteIsChangedOrCutOff) {
  const Result<SurfaceModel> model = displaced(shapes::everything(false));
  ASSERT_TRUE(model);
  for (const bool isPacked : {false, true}) {
    ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model, {}, {.isPacked = isPacked}));
    const std::string whole = contentOf(path("a.amt"));
    std::mt19937_64 random(1);
    for (int i = 0; i < 200; ++i) {
      std::string bytes = whole;
      bytes[random() % bytes.size()] ^= char(1 << random() % 8);
      std::ofstream(path("b.amt"), std::ios::binary) << bytes;
      EXPECT_FALSE(loadSurfaceAmt(path("b.amt"))) << i;
    }
    for (int i = 0; i < 40; ++i) {
      std::ofstream(path("b.amt"), std::ios::binary) << whole.substr(0, random() % whole.size());
      EXPECT_FALSE(loadSurfaceAmt(path("b.amt")));
    }
  }
}

TEST_F(SurfaceAmt, ReadsNoIndexOutOfRangeWhateverTheArraysHold) {
  // Without checksums the checks of indices alone have to hold.
  const Result<SurfaceModel> model = buildSurface(shapes::everything(false));
  ASSERT_TRUE(model);
  ASSERT_TRUE(writeSurfaceAmt(path("a.amt"), *model));
  const std::string whole = contentOf(path("a.amt"));
  std::mt19937_64 random(2);
  const std::size_t begin = 4096;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t value = static_cast<std::uint32_t>(random());
      std::memcpy(&bytes[begin + random() % ((bytes.size() - begin - 4) / 4) * 4], &value, 4);
    }
    std::ofstream(path("b.amt"), std::ios::binary) << bytes;
    const Result<SurfaceModel> read = loadSurfaceAmt(path("b.amt"), {.verify = AmtVerify::indices});
    if (!read) continue;
    const SurfaceFront root = surfaceOf(*read, frontOfPrefix(read->mt, read->mt.nodeCount() / 2));
    EXPECT_TRUE(root.mesh.validate());
  }
}

}  // namespace
}  // namespace arete
