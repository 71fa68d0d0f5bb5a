// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/cut.h"
#include "engine/member_set.h"

namespace arete {

/// The front of a closed set. O(members), parallel, the same for any thread count.
Cut frontOf(const MultiTriangulation& mt, const MemberSet& set);

}  // namespace arete
