// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/write_model.h"

#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/displacement/find_displacement.h"

namespace arete {
namespace {

Result<SurfaceModel> roundAndDisplace(const SurfaceModel& model, int positionBits,
                                      const RunContext& context) {
  ARETE_TRY(SurfaceModel rounded, roundSurface(model, positionBits, context));
  // Rounding that moved no place has left them.
  if (rounded.displacement.isEmpty()) {
    ARETE_TRY(SurfaceDisplacement displacement, findDisplacement(rounded, context));
    rounded.displacement = std::move(displacement);
  }
  return rounded;
}

}  // namespace

Status writeSurfaceModel(const std::string& path, const SurfaceModel& model, const RunContext& context,
                         const SurfaceWriteOptions& options) try {
  if (!options.isPacked || options.positionBits == 0 || model.displacement.isEmpty())
    return writeSurfaceAmt(path, model, context, options);
  const Result<SurfaceModel> rounded = roundAndDisplace(model, options.positionBits, context);
  if (!rounded) return failure(rounded.error().code, rounded.error().message, path);
  return writeSurfaceAmt(path, *rounded, context, options);
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
