// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file of a surface is read whatever its checksums say; where its indices are in range, cuts and their
// meshes are taken from it and its laws are checked. What a wrong file answers does not matter; that it
// answers within its arrays does.
#include <cmath>

#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "fuzz/harness.h"
#include "io/store/amt/surface_file.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"

namespace {

using namespace arete;

void takeCuts(const SurfaceModel& model, const RunContext& context) {
  const double rootError = model.mt.largestError();
  const auto require = [&](const Result<Cut>& cut) {
    if (!cut) return fuzz::requireClear(cut.error());
    const SurfaceFront front = surfaceOf(model, *cut);
    fuzz::require(front.mesh.validate().has_value(), "the mesh of a cut names nothing that is not there");
  };
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated})
    for (const double error : {0.0, rootError / 4, HUGE_VAL}) {
      CutOptions options;
      options.method = method;
      require(takeCut(model.mt, UniformError(error), options, context));
      options.maxTriangles = model.mt.rootTriangleCount() + 9;
      if (method == CutMethod::minimal) options.order = std::make_shared<LargestSquaresFirst>();
      require(takeCut(model.mt, UniformError(error), options, context));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile memory;
  memory.set({data, size});
  const RunContext context = fuzz::oneThread();
  if (const auto whole = loadSurfaceAmt(memory.path(), {}, context); !whole)
    fuzz::requireClear(whole.error());
  const auto model = loadSurfaceAmt(memory.path(), {.verify = AmtVerify::indices}, context);
  if (!model) {
    fuzz::requireClear(model.error());
    return 0;
  }
  takeCuts(*model, context);
  // Of pages a part.
  const RequiredError some = [](const Box3& box) { return box.low.x < 0 ? 0 : HUGE_VAL; };
  for (const RequiredError& wanted : {requiredNowhere(), some}) {
    const auto part =
        loadSurfaceAmt(memory.path(), {.verify = AmtVerify::indices, .wanted = wanted}, context);
    if (part)
      takeCuts(*part, context);
    else
      fuzz::requireClear(part.error());
  }
  const Status valid = validateSurface(*model, {}, context);
  fuzz::require(valid || !valid.error().message.empty(), "a broken law is named");
  return 0;
}
