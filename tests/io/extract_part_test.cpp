// SPDX-License-Identifier: GPL-3.0-or-later
//
// What extract reads of a file, packed or not, gives the TINs of the whole.
#include "io/extract_part.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "engine/cut.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::built;
using test::TemporaryFolder;

const RasterFamily& familyNamed(std::string_view name) {
  return *std::ranges::find(rasterFamilies(), name, &RasterFamily::name);
}

ExtractRequest within(double maxError) {
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

Tin tinOf(const TerrainModel& model, const ExtractRequest& request) {
  const auto criterion = engineCriterion(request.criterion, request.region, 0, model);
  const auto cut = takeCut(model.mt, **criterion, *engineOptions(request.criterion, model));
  if (!cut) return {{}, {}, 0, false, cut.error().describe()};
  Tin tin{{}, cut->triangles, cut->achievedError, cut->isComplete, {}};
  for (const std::uint32_t v : cut->vertices) {
    const Vec3 p = model.mt.position(VertexId(v));
    tin.corners.insert(tin.corners.end(), {p.x, p.y, p.z});
  }
  return tin;
}

struct Filed {
  Filed(const TerrainModel& model, const std::string& path, bool isPacked) {
    const Status written = writeAmt(path, model, {}, {.isPacked = isPacked});
    if (!written) throw std::runtime_error(written.error().describe());
    file = *openAmt(path);
    whole = built(file->read());
  }
  TerrainModel part(const ExtractRequest& request) const {
    return built(readForExtract(*file, std::vector{request}, whole));
  }
  std::optional<AmtFile> file;
  TerrainModel whole;
};

TEST(ReadForExtract, HasTheTinOfTheWholeForAnyBudget) {
  const TemporaryFolder folder;
  std::vector<TerrainModel> models;
  for (const RasterFamily& family : rasterFamilies()) models.push_back(built(build(family.make(90, 80, 8))));
  for (const PointFamily& family : pointFamilies()) models.push_back(built(build(family.make(3000, 8))));
  models.push_back(built(build(familyNamed("fractal").make(300, 280, 3), {.shape = HoleShape::fidelity})));
  std::uint64_t nodes = 0, nodesOfParts = 0;
  for (const TerrainModel& model : models)
    for (const bool isPacked : {false, true}) {
      const Filed filed(model, folder.file("model.amt"), isPacked);
      const std::uint32_t finest = filed.whole.mt.finestTriangleCount();
      for (const std::uint32_t budget :
           {0u, 1u, 30u, 100u, 500u, 2000u, finest / 4, finest - 1, finest, 2 * finest}) {
        SCOPED_TRACE(fmt::format("{}, {}, {}", model.source, isPacked ? "packed" : "plain", budget));
        const ExtractRequest request = ofAtMost(budget);
        const TerrainModel part = filed.part(request);
        EXPECT_TRUE(tinOf(part, request) == tinOf(filed.whole, request));
        if (finest < 50'000 || budget > 2000) continue;
        nodes += filed.whole.mt.nodeCount();
        nodesOfParts += part.mt.nodeCount();
      }
    }
  EXPECT_GT(nodes, 0u);
  EXPECT_LT(nodesOfParts, nodes / 8);
}

TEST(ReadForExtract, ReadsEverythingWhereATinIsMeasuredRoundedOrFitted) {
  const TemporaryFolder folder;
  const Filed filed(built(build(familyNamed("fractal").make(100, 90, 3))), folder.file("model.amt"), false);
  const double error = filed.whole.mt.largestError() / 4;
  const auto readsAll = [&](const ExtractRequest& request) {
    return filed.part(request).mt.nodeCount() == filed.whole.mt.nodeCount();
  };
  using Change = void (*)(ExtractRequest&);
  for (const ExtractRequest& request : {within(error), ofAtMost(200)}) {
    EXPECT_FALSE(readsAll(request));
    for (const Change change : std::initializer_list<Change>{
             [](ExtractRequest& r) { r.output = "tin.stl"; }, [](ExtractRequest& r) { r.output = "tin.tif"; },
             [](ExtractRequest& r) { r.certificate = "tin.json"; },
             [](ExtractRequest& r) { r.errorRaster = "error.tif"; },
             [](ExtractRequest& r) { r.criterion.fit = ExtractFit::error; }}) {
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
