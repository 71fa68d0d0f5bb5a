// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// Codes the root, before the nodes of packet 0: every number as the difference from the one before it. The
/// writer's arrays hold the root already; the reader's are filled. For `Form` and `Io` see node_coder.h.
/// @return false if the numbers are invalid
template <class Form, class Io>
bool codeRoot(Arrays& a, Io& io) {
  if (!Form::codeRootVertices(a, io)) return false;
  std::uint64_t corner = 0;
  for (std::uint32_t t = 0; t < a.roots; ++t)
    for (std::uint32_t& c : a.rootTriangles[t]) {
      corner += static_cast<std::uint64_t>(codeSigned(io, kFloorStream, kRootCornerTable,
                                                      std::int64_t{c} - static_cast<std::int64_t>(corner)));
      if (corner >= a.rootVertices) return false;
      c = static_cast<std::uint32_t>(corner);
    }
  a.joinRoot();
  return true;
}

}  // namespace arete::packed
