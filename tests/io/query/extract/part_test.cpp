// SPDX-License-Identifier: GPL-3.0-or-later
//
// What extract reads of a file, packed or not, gives the TINs of the whole.
#include "io/query/extract/part.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/mesh_fixture.h"
#include "io/query/request/criterion.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

using test::built;
using test::TemporaryFolder;

const RasterFamily& familyNamed(std::string_view name) {
  return *std::ranges::find(rasterFamilies(), name, &RasterFamily::name);
}

/// Small ones, and a larger one at the end.
std::vector<TerrainModel> modelsOfAllKinds(std::uint64_t seed) {
  std::vector<TerrainModel> models;
  for (const RasterFamily& family : rasterFamilies())
    models.push_back(built(build(test::isBrief() ? family.make(50, 40, seed) : family.make(90, 80, seed))));
  for (const PointFamily& family : pointFamilies())
    models.push_back(built(build(family.make(test::isBrief() ? 1000 : 3000, seed))));
  models.push_back(
      built(build(familyNamed("fractal").make(300, 280, 3), {.shape = HoleShape::dataDependent})));
  return models;
}

ExtractRequest withinError(double maxError) {
  ExtractRequest request;
  request.criterion.maxError = maxError;
  request.output = "tin.ply";
  return request;
}

ExtractRequest ofAtMost(std::uint32_t triangles) {
  ExtractRequest request;
  request.criterion.maxTriangles = triangles;
  request.output = "tin.ply";
  return request;
}

struct Tin {
  std::vector<double> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double achievedError = 0;
  bool isComplete = false;
  std::string refusal = {};
  bool operator==(const Tin&) const = default;
};

Tin refused(const Error& error) {
  return {{}, {}, 0, false, error.describe()};
}

Tin tinOf(const TerrainModel& model, const Cut& cut) {
  Tin tin{{}, cut.triangles, cut.achievedError, cut.isComplete, {}};
  for (const std::uint32_t v : cut.vertices) {
    const Vec3 p = model.mt.position(VertexId(v));
    tin.corners.insert(tin.corners.end(), {p.x, p.y, p.z});
  }
  return tin;
}

Tin tinOf(const TerrainModel& model, const ExtractRequest& request) {
  const auto criterion = engineCriterion(request.criterion, request.region, 0, model);
  const auto cut = takeCut(model.mt, **criterion, *engineOptions(request.criterion, model));
  return cut ? tinOf(model, *cut) : refused(cut.error());
}

/// The TIN of a part: of the cut that was taken to read it, if there is one.
Tin tinOf(const Result<PartAndCut>& part, const ExtractRequest& request) {
  if (!part) return refused(part.error());
  return part->cut ? tinOf(part->model, *part->cut) : tinOf(part->model, request);
}

struct Filed {
  Filed(const TerrainModel& model, const std::string& path, bool isPacked, bool isPaged = false) {
    const Status written = writeAmt(path, model, {}, {.isPacked = isPacked, .isPaged = isPaged});
    if (!written) throw std::runtime_error(written.error().describe());
    file = *openAmt(path);
    whole = built(file->read());
  }
  Result<PartAndCut> part(const ExtractRequest& request) const {
    return readForExtract(*file, std::vector{request}, whole);
  }
  std::optional<AmtFile> file;
  TerrainModel whole;
};

/// Visits a plain file, a packed one and one in pages of each, with numbers to draw from.
template <class Visit>
void forAllFiles(std::uint64_t seed, const Visit& visit) {
  const TemporaryFolder folder;
  Random random(seed);
  for (const TerrainModel& model : modelsOfAllKinds(seed))
    for (const std::string form : {"plain", "packed", "in pages"}) {
      SCOPED_TRACE(fmt::format("{}, {}, seed {}", model.source, form, seed));
      visit(Filed(model, folder.file("model.amt"), form == "packed", form == "in pages"), random);
    }
}

/// How much of the larger terrains was read.
struct NodesRead {
  double parts = 0, all = 0;
  void add(const Filed& filed, const Result<PartAndCut>& part) {
    if (!part || filed.whole.mt.finestTriangleCount() < 50'000) return;
    parts += part->model.mt.nodeCount();
    all += filed.whole.mt.nodeCount();
  }
};

TEST(ReadForExtract, HasTheTinOfTheWholeForAnyBudget) {
  NodesRead read;
  forAllFiles(8, [&](const Filed& filed, Random&) {
    const std::uint32_t finest = filed.whole.mt.finestTriangleCount();
    for (const std::uint32_t budget :
         {0u, 1u, 30u, 100u, 500u, 2000u, finest / 4, finest - 1, finest, 2 * finest}) {
      const ExtractRequest request = ofAtMost(budget);
      const Result<PartAndCut> part = filed.part(request);
      EXPECT_TRUE(tinOf(part, request) == tinOf(filed.whole, request)) << budget;
      if (budget <= 2000) read.add(filed, part);
    }
  });
  EXPECT_GT(read.all, 0);
  EXPECT_LT(read.parts, read.all / 8);
}

ExtractRequest seenBy(const Camera& camera, double pixels) {
  ExtractRequest request;
  request.criterion.camera = camera;
  request.criterion.pixelError = pixels;
  request.output = "tin.ply";
  return request;
}

/// Somewhere around the terrain, below it at times, looking anywhere.
Camera anyCamera(const TerrainModel& model, Random& random) {
  const Box2 domain = planBox(model);
  const double width = domain.xMax - domain.xMin, height = domain.yMax - domain.yMin;
  Camera camera;
  camera.xy = model.toSource(
      {domain.xMin + random.between(-0.3, 1.3) * width, domain.yMin + random.between(-0.3, 1.3) * height});
  const double z = model.mt.position(VertexId(0)).z;
  camera.height = z + random.between(-0.2, 1) * (width + height) / 4;
  camera.azimuthDegrees = random.between(0, 360);
  camera.pitchDegrees = random.between(-90, 30);
  camera.verticalFieldOfViewDegrees = random.between(5, 120);
  return camera;
}

/// The error that no triangle of a view's TIN is beyond, by the view's own bound or that of the ball around
/// what would come next: what the minimal cut promises.
bool keepsPixels(const TerrainModel& model, const ExtractRequest& request) {
  const auto criterion = engineCriterion(request.criterion, request.region, 0, model);
  const auto cut = takeCut(model.mt, **criterion, *engineOptions(request.criterion, model));
  for (std::size_t i = 0; i < cut->ids.size(); ++i) {
    Criterion::Corners corners = cut->triangles[i];
    for (std::uint32_t& corner : corners) corner = cut->vertices[corner];
    if (!isSatisfied(model.mt, **criterion, TriangleId(cut->ids[i]), corners)) return false;
  }
  return true;
}

TEST(ReadForExtract, HasTheTinOfTheWholeForAnyCamera) {
  NodesRead read;
  double triangles = 0, trianglesOfParts = 0;  // of minimal cuts
  forAllFiles(9, [&](const Filed& filed, Random& random) {
    for (int i = 0; i < 20; ++i) {
      const Camera camera = anyCamera(filed.whole, random);
      ExtractRequest request = seenBy(camera, std::pow(2.0, 6 * random.unit() - 1));
      const bool isMinimal = i % 4 != 0;
      if (!isMinimal) request.criterion.method = CutMethod::saturated;
      const Result<PartAndCut> part = filed.part(request);
      const Tin all = tinOf(filed.whole, request), some = tinOf(part, request);
      ASSERT_TRUE(part) << part.error().describe();
      EXPECT_TRUE(keepsPixels(part->model, request)) << i;
      EXPECT_TRUE((filed.file->isPacked() && isMinimal) || all == some) << i;
      if (!isMinimal) continue;
      triangles += static_cast<double>(all.triangles.size());
      trianglesOfParts += static_cast<double>(some.triangles.size());
      read.add(filed, part);
    }
  });
  EXPECT_NEAR(trianglesOfParts, triangles, 0.0001 * triangles);
  EXPECT_LT(read.parts, read.all / 4);
}

TEST(ReadForExtract, HasTheTinOfTheWholeForACameraWithABudget) {
  NodesRead read;
  forAllFiles(10, [&](const Filed& filed, Random& random) {
    for (int i = 0; i < 12; ++i) {
      ExtractRequest request = seenBy(anyCamera(filed.whole, random), std::pow(2.0, 6 * random.unit() - 1));
      CutRequest& c = request.criterion;
      c.maxTriangles =
          static_cast<std::uint32_t>(std::pow(random.unit(), 3) * filed.whole.mt.finestTriangleCount());
      if (i % 2 == 0) c.pixelError.reset();
      if (i % 3 == 0) c.outsideError = filed.whole.mt.largestError() * random.unit();
      const Result<PartAndCut> part = filed.part(request);
      const Tin all = tinOf(filed.whole, request), some = tinOf(part, request);
      const auto count = static_cast<double>(some.triangles.size()),
                 countOfAll = static_cast<double>(all.triangles.size());
      EXPECT_TRUE(filed.file->isPacked() || all == some) << i;
      EXPECT_EQ(all.refusal.empty(), some.refusal.empty()) << i;
      EXPECT_LE(count, *c.maxTriangles) << i;
      EXPECT_NEAR(count, countOfAll, 4 + 0.001 * countOfAll) << i;
      read.add(filed, part);
    }
  });
  EXPECT_LT(read.parts, read.all / 2);
}

/// A budget that no cut meets: takeCut() refuses it.
ExtractRequest impossible(ExtractRequest request) {
  request.criterion.maxTriangles = 0;
  return request;
}

TEST(ReadForExtract, ReturnsTheCutThatItTookAndTheExtractorTakesNoOther) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(familyNamed("fractal").make(300, 280, 3)));
  for (const bool isPacked : {false, true}) {
    const Filed filed(model, folder.file("model.amt"), isPacked);
    Random random(11);
    ExtractRequest seen = seenBy(anyCamera(filed.whole, random), 4);
    seen.criterion.outsideError = 20;
    for (ExtractRequest request : {ofAtMost(500), seen}) {
      SCOPED_TRACE(
          fmt::format("{}, {}", isPacked ? "packed" : "plain", request.criterion.maxTriangles ? 1 : 0));
      Result<PartAndCut> part = filed.part(request);
      ASSERT_TRUE(part) << part.error().describe();
      ASSERT_TRUE(part->cut);
      EXPECT_LT(part->model.mt.nodeCount(), filed.whole.mt.nodeCount());
      EXPECT_TRUE(tinOf(part->model, *part->cut) == tinOf(part->model, request));

      request.output = folder.file("tin.ply");
      TinExtractor extractor(part->model, "m.amt");
      const auto anew = extractor.extract(request);
      ASSERT_TRUE(anew) << anew.error().describe();
      const std::string bytes = test::bytesOf(request.output);
      EXPECT_EQ(extractor.extract(impossible(request)).error().code, ErrorCode::usage);
      const auto given = extractor.extract(impossible(request), {}, std::move(part->cut));
      ASSERT_TRUE(given) << given.error().describe();
      EXPECT_EQ(given->triangles, anew->triangles);
      EXPECT_TRUE(bytes == test::bytesOf(request.output));
    }
  }
}

TEST(ReadForExtract, TakesNoCutWhereTheRequestDeterminesThePart) {
  const TemporaryFolder folder;
  const Filed filed(built(build(familyNamed("fractal").make(100, 90, 3))), folder.file("model.amt"), false);
  EXPECT_FALSE(filed.part(withinError(filed.whole.mt.largestError() / 4))->cut);
  EXPECT_FALSE(readForExtract(*filed.file, std::vector{ofAtMost(200), ofAtMost(300)}, filed.whole)->cut);
}

TEST(ReadForExtract, RefusesABudgetBelowTheRoot) {
  const TemporaryFolder folder;
  const Filed filed(built(build(familyNamed("fractal").make(100, 90, 3))), folder.file("model.amt"), false);
  EXPECT_EQ(filed.part(ofAtMost(0)).error().code, ErrorCode::usage);
}

TEST(ReadForExtract, IsEnoughForAFormatThatRounds) {
  const TemporaryFolder folder;
  RasterHeightfield field = familyNamed("fractal").make(300, 280, 3);
  for (double& z : field.heights) z += 1e5 + 0.1;  // a 32-bit float rounds it by 4 mm
  for (const bool isPacked : {false, true}) {
    const Filed filed(built(build(field)), folder.file("model.amt"), isPacked);
    const double largest = filed.whole.mt.largestError();
    for (const std::string name : {"tin.stl", "tin.glb"})
      for (const double maxError : {largest / 4, largest / 16, 0.1, 0.02, 0.005}) {
        SCOPED_TRACE(fmt::format("{}, {}, {}", isPacked ? "packed" : "plain", name, maxError));
        ExtractRequest request = withinError(maxError);
        request.output = folder.file(name);
        const TerrainModel part = filed.part(request)->model;
        EXPECT_LT(part.mt.nodeCount(), filed.whole.mt.nodeCount());
        int reads = 0;
        const auto readAll = [&](const RunContext&) -> Result<TerrainModel> {
          ++reads;
          return filed.whole;
        };
        TinExtractor ofPart(part, "m.amt", readAll), ofWhole(filed.whole, "m.amt");
        const auto tin = ofPart.extract(request);
        ASSERT_TRUE(tin) << tin.error().describe();
        const std::string bytes = test::bytesOf(request.output);
        const auto whole = ofWhole.extract(request);
        ASSERT_TRUE(whole) << whole.error().describe();
        EXPECT_TRUE(bytes == test::bytesOf(request.output));
        EXPECT_EQ(tin->triangles, whole->triangles);
        EXPECT_GT(tin->format.heightRounding, 0);
        const double reserve = 2 * tin->format.heightRounding;
        EXPECT_EQ(reads, reserve > maxError / 8 && reserve < maxError ? 1 : 0);
        EXPECT_LE(tin->storedError + (reserve < maxError ? tin->format.heightRounding : 0), maxError);
      }
  }
}

TEST(ReadForExtract, ReadsEverythingWhereATinIsMeasuredOrFitted) {
  const TemporaryFolder folder;
  const Filed filed(built(build(familyNamed("fractal").make(100, 90, 3))), folder.file("model.amt"), false);
  const double error = filed.whole.mt.largestError() / 4;
  const auto readsAll = [&](const ExtractRequest& request) {
    return filed.part(request)->model.mt.nodeCount() == filed.whole.mt.nodeCount();
  };
  using Change = void (*)(ExtractRequest&);
  for (const ExtractRequest& request : {withinError(error), ofAtMost(200)}) {
    EXPECT_FALSE(readsAll(request));
    for (const Change change :
         std::initializer_list<Change>{[](ExtractRequest& r) { r.output = "tin.tif"; },
                                       [](ExtractRequest& r) { r.certificate = "tin.json"; },
                                       [](ExtractRequest& r) { r.errorRaster = "error.tif"; },
                                       [](ExtractRequest& r) { r.criterion.fit = CutFit::error; }}) {
      ExtractRequest other = request;
      change(other);
      EXPECT_TRUE(readsAll(other));
    }
  }
  ExtractRequest saturated = ofAtMost(200);
  saturated.criterion.method = CutMethod::saturated;
  EXPECT_TRUE(readsAll(saturated));
}

}  // namespace
}  // namespace arete
