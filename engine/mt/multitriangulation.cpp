// SPDX-License-Identifier: GPL-3.0-or-later
// Counts follow from the arrays alone: a closed star adds two triangles to a front, an open one adds one.
#include "engine/mt/multitriangulation.h"

#include <algorithm>

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

std::uint32_t MultiTriangulation::bandBegin(std::uint32_t band) const {
  const auto isAbove = [&](OutwardScale::Code code) { return bandOf(code) > band; };
  return static_cast<std::uint32_t>(
      std::partition_point(a_.saturatedError.begin(), a_.saturatedError.end(), isAbove) -
      a_.saturatedError.begin());
}

double MultiTriangulation::largestError() const {
  if (nodeCount() == 0) return 0;
  const auto first = a_.saturatedError.first(bandEnd(bandOf(a_.saturatedError[0])));
  return a_.scale.decode(*std::max_element(first.begin(), first.end()));
}

}  // namespace arete
