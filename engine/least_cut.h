// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "engine/criterion.h"
#include "engine/member_set.h"
#include "engine/multitriangulation.h"

namespace arete {

/// The least closed set C such that every triangle that fails the criterion, and whose creator is in C or
/// that is in the root, has its remover in C; nothing when stop(), asked now and then, said true. Of a
/// monotone criterion: O(its saturated cut), with one look at each of its nodes in their order; else O(least
/// set), nodes wherever they lie.
std::optional<MemberSet> leastMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                      const std::function<bool()>& stop);

}  // namespace arete
