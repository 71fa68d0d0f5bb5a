// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/build_options.h"

namespace arete {

// The words that users type and that stand in files.
std::string_view toString(HoleShape shape) {
  return shape == HoleShape::delaunay ? "delaunay" : "fidelity";
}

}  // namespace arete
