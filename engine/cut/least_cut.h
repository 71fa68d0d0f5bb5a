// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "engine/criteria/criterion.h"
#include "engine/cut/member_set.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// The least closed set C such that every triangle that fails the criterion, and whose creator is in C or
/// that is in the root, has its remover in C; nothing if stop(), called now and then, returned true. For a
/// bounded criterion: O(its saturated cut), one visit per node in their order; else O(least set), by random
/// access. (If a file's errors break law 6, a bounded criterion's set can lack parents: frontOfClosure().)
std::optional<MemberSet> leastMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                      const std::function<bool()>& stop);

/// The same by a walk from the root, for any criterion. Calls stop() often. O(least set), by random access.
std::optional<MemberSet> leastMembersByWalk(const MultiTriangulation& mt, const Criterion& criterion,
                                            const std::function<bool()>& stop);

/// The least closed set for the least uniform error, `least` or more, whose front has at most so many
/// triangles; nothing if stop() returned true. Precondition: the budget is at least the root's triangles.
/// O(nodes of a cut of four times the triangles), about ten times.
std::optional<MemberSet> leastMembersWithin(const MultiTriangulation& mt, double least,
                                            std::uint32_t maxTriangles, const std::function<bool()>& stop);

/// A closed subset of the least set for a severity: of the criterion with this limit; or the root alone.
struct SetOfSeverity {
  MemberSet members;
  double severity = std::numeric_limits<double>::infinity();
};
/// A set whose front has at most maxTriangles, usually nine tenths of them; nothing if stop() returned true.
/// Preconditions: the criterion has a severityLimit(); the budget is at least the root's triangles.
/// O(saturated cut for four times the triangles), about ten times.
std::optional<SetOfSeverity> membersOfSeverityWithin(const MultiTriangulation& mt,
                                                     const BoundedCriterion& criterion,
                                                     std::uint32_t maxTriangles,
                                                     const std::function<bool()>& stop);

}  // namespace arete
