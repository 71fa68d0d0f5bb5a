// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/cut.h"
#include "engine/member_set.h"

namespace arete {

/// The front of a closed set; of one that is not, with the parents that it lacks. (Spheres that no build
/// makes, but a file may hold, can be so far out that a saturated cut by place lacks some.) O(members),
/// parallel, the same for any thread count.
Cut frontOf(const MultiTriangulation& mt, const MemberSet& set);

}  // namespace arete
