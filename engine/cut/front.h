// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/cut/cut.h"
#include "engine/cut/member_set.h"

namespace arete {

/// The number of triangles of the front of a closed set. O(members).
std::uint64_t frontSize(const MultiTriangulation& mt, const MemberSet& set);
/// The front of a closed set. O(members), parallel, the same for any thread count.
Cut frontOf(const MultiTriangulation& mt, const MemberSet& set);
/// The front of a set together with the parents that it lacks. (A file may have spheres and saturated errors
/// that break law 6, and a cut by them may lack parents.)
Cut frontOfClosure(const MultiTriangulation& mt, const MemberSet& set);

}  // namespace arete
