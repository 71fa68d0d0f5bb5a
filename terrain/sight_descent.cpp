// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight_engine.h"

namespace arete {

std::unique_ptr<SightEngine> makeSightDescent(const TerrainModel&) {
  return nullptr;
}

}  // namespace arete
