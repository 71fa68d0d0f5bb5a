// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/build_options.h"

namespace arete {

std::string_view toString(HoleShape shape) {
  return shape == HoleShape::delaunay ? "delaunay" : "fidelity";
}

}  // namespace arete
