// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// Calls visit(id) for the triangles that no node removes, in the order of their ids.
template <class Visit>
void forFinest(const MultiTriangulation& mt, const Visit& visit) {
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) visit(t);
}

}  // namespace arete
