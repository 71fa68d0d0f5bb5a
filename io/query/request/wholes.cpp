// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/request/wholes.h"

#include "terrain/model/relief.h"

namespace arete {

Wholes wholesOf(const TerrainModel& model) {
  return {reliefOf(model), model.mt.finestTriangleCount()};
}

Wholes wholesOf(const SurfaceModel& model) {
  return {model.diagonal, model.mt.finestTriangleCount()};
}

}  // namespace arete
