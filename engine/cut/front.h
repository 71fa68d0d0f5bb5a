// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/cut/cut.h"
#include "engine/cut/member_set.h"

namespace arete {

/// Triangles of the front of a closed set. O(members).
std::uint64_t frontSize(const MultiTriangulation& mt, const MemberSet& set);
/// The front of a closed set. O(members), parallel, the same for any thread count.
Cut frontOf(const MultiTriangulation& mt, const MemberSet& set);
/// The same, with the parents that the set lacks. (Spheres and saturated errors that no build makes, but a
/// file may hold, can be so far out that a cut lacks some.)
Cut frontOfClosure(const MultiTriangulation& mt, const MemberSet& set);

}  // namespace arete
