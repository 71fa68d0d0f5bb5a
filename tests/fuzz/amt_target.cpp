// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file is opened; then its checksums and its indices are checked, each whatever the other says; and where
// the indices are in range, everything is asked of the model that the commands ask. What a wrong file answers
// does not matter; that it answers within its arrays does. A file is read as a whole and in part.
#include <cmath>
#include <limits>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/follow/incremental_cut.h"
#include "fuzz/harness.h"
#include "io/formats/exchange/export_tin.h"
#include "io/store/amt/file.h"
#include "terrain/laws/validate_model.h"
#include "terrain/locate/ground_height.h"
#include "engine/cut/error_curve.h"

namespace {

using namespace arete;

/// The source's samples are as many as the file says: a few bytes may stand for a large raster without data.
constexpr std::uint64_t kMostSamples = 1 << 14;

void requireSound(const MultiTriangulation& mt, const Result<Cut>& cut) {
  if (!cut) return fuzz::requireClear(cut.error());
  bool isSound = cut->ids.size() == cut->triangles.size();
  for (const std::uint32_t v : cut->vertices) isSound = isSound && v < mt.vertexCount();
  for (const std::uint32_t t : cut->ids) isSound = isSound && t < mt.triangleIdCount();
  for (const auto& corners : cut->triangles)
    for (const std::uint32_t v : corners) isSound = isSound && v < cut->vertices.size();
  fuzz::require(isSound, "a cut names nothing that is not there");
}

void takeCuts(const TerrainModel& model, const RunContext& context) {
  const MultiTriangulation& mt = model.mt;
  const double rootError = mt.largestError();
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated})
    for (const double error : {0.0, rootError / 4, HUGE_VAL}) {
      const RegionError corner(Region::box({0, 0, 3, 2}), mt.arrays().metric, error, 2 * error + 1);
      requireSound(mt, takeCut(mt, corner, {method, {}}, context));
      requireSound(mt, takeCut(mt, corner, {method, mt.rootTriangleCount() + 7}, context));
      requireSound(mt, takeCut(mt, UniformError(error), {method, mt.rootTriangleCount() + 20}, context));
      const auto cut = takeCut(mt, UniformError(error), {method, {}}, context);
      requireSound(mt, cut);
      if (cut) fuzz::require(exportTin(model, *cut).has_value(), "a cut is exported");
    }
}

void describe(const TerrainModel& model, const RunContext& context) {
  const MultiTriangulation& mt = model.mt;
  const auto ladder = toleranceLadder(mt, 12);
  const auto curve = errorCurve(mt, ladder, context);
  fuzz::require(curve && curve->size() == ladder.size(), "the curve has a point for each tolerance");
  fuzz::require(mt.triangleCount() >= mt.finestTriangleCount(), "no front has more than all triangles");
}

/// A cut that follows: fine, then coarse, then a corner; and back.
void followCuts(const TerrainModel& model, const RunContext& context) {
  const MultiTriangulation& mt = model.mt;
  for (const std::uint32_t room : {7u, 0xFFFFFFu}) {
    IncrementalCut cut(mt);
    IncrementalOptions options;
    options.maxTriangles = mt.rootTriangleCount() + room;
    for (const double error : {1.0, 0.0, 50.0, 2.0}) {
      const RegionError corner(Region::box({0, 0, 3, 2}), mt.arrays().metric, error, 2 * error + 1);
      const auto update = cut.update(corner, options, context);
      fuzz::require(update.has_value() && cut.validate().has_value(), "an update leaves a cut");
      requireSound(mt, cut.front());
    }
  }
}

void askHeights(const TerrainModel& model, const RunContext& context) {
  const GroundHeights heights(model);
  std::vector<Vec2> places = {{NAN, 0}, {HUGE_VAL, 0}, {1e300, -1e300}};
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); v += 3) {
    const Vec3 p = model.mt.position(VertexId(v));
    places.push_back(model.toSource({p.x, p.y}));
    places.push_back(model.toSource({p.x + 0.3, p.y + 0.4}));
  }
  for (const double error : {0.0, 2.0}) {
    const auto found = heights.at(places, error, context);
    fuzz::require(found.has_value() && found->size() == places.size(), "every place has an answer or none");
    for (const auto& height : *found)
      fuzz::require(!height || height->triangle.index() < model.mt.triangleIdCount(),
                    "a height comes from a triangle that is there");
  }
}

void use(const TerrainModel& model, const RunContext& context) {
  describe(model, context);
  takeCuts(model, context);
  followCuts(model, context);
  askHeights(model, context);
  if (model.isRaster && std::uint64_t{model.columns} * model.rows > kMostSamples) return;
  const Status valid = validateModel(model, {.randomFronts = 2, .seed = 1}, context);
  fuzz::require(valid || !valid.error().message.empty(), "a broken law is named");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile memory;
  memory.set({data, size});
  const RunContext context = fuzz::oneThread();
  const auto file = openAmt(memory.path());
  if (!file) {
    fuzz::requireClear(file.error());
    return 0;
  }
  if (const Status same = checkAmtChecksums(*file, context); !same) fuzz::requireClear(same.error());
  const Status inRange = checkAmtIndices(*file, context);
  if (!inRange) {
    fuzz::requireClear(inRange.error());
    return 0;
  }
  const auto model = loadAmt(memory.path(), {AmtVerify::indices, {}}, context);
  fuzz::require(model || file->isPacked(), "a file whose indices are in range loads");
  if (!model) {
    fuzz::requireClear(model.error());
    return 0;
  }
  use(*model, context);
  const auto isCorner = [](const Box3& box) { return box.low.x <= 2 && box.low.y <= 2; };
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  AmtLoadOptions corner, coarse, coarseCorner;
  corner.verify = coarse.verify = coarseCorner.verify = AmtVerify::indices;
  corner.wanted = [&](const Box3& box) { return isCorner(box) ? 0 : kNothing; };
  coarse.wanted = [](const Box3&) { return 0.5; };
  coarseCorner.wanted = [&](const Box3& box) { return isCorner(box) ? 0.5 : 3; };
  for (const AmtLoadOptions& options : {corner, coarse, coarseCorner}) {
    const auto part = loadAmt(memory.path(), options, context);
    if (part) {
      takeCuts(*part, context);
    } else {
      fuzz::requireClear(part.error());
    }
  }
  return 0;
}
