// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/multitriangulation.h"

namespace arete {

std::uint64_t MultiTriangulation::triangleCount() const {
  std::uint64_t count = triangleIdCount();
  for (std::uint32_t n = 0; n < nodeCount(); ++n) count -= isOpen(NodeId(n)) ? 1 : 0;
  return count;
}

std::uint32_t MultiTriangulation::prefixTriangleCount(std::uint32_t n) const {
  // A closed star of k slots replaces k - 2 triangles by k; an open one of k slots replaces k - 2 by k - 1.
  std::uint32_t count = rootTriangleCount() + 2 * n;
  for (std::uint32_t i = 0; i < n; ++i) count -= isOpen(NodeId(i)) ? 1 : 0;
  return count;
}

}  // namespace arete
