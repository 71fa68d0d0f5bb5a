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
/// that is in the root, has its remover in C; nothing when stop(), asked now and then, said true. Of a
/// monotone criterion: O(its saturated cut), with one look at each of its nodes in their order; else O(least
/// set), nodes wherever they lie. (Of errors that no build makes, but a file may hold, a monotone criterion's
/// set can lack parents: frontOfClosure().)
std::optional<MemberSet> leastMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                      const std::function<bool()>& stop);

/// The same by a walk from the root, whatever the criterion, which hears a wish to stop soon. O(least set),
/// nodes wherever they lie.
std::optional<MemberSet> leastMembersByWalk(const MultiTriangulation& mt, const Criterion& criterion,
                                            const std::function<bool()>& stop);

/// The least closed set for the least uniform error, `least` or more, whose front has at most so many
/// triangles; nothing when stop(), asked now and then, said true. Precondition: the budget holds the root.
/// O(the nodes of a cut of four times the triangles), some ten times.
std::optional<MemberSet> leastMembersWithin(const MultiTriangulation& mt, double least,
                                            std::uint32_t maxTriangles, const std::function<bool()>& stop);

/// A closed set that is part of the least one for a severity: of that for the criterion with this limit, or
/// the root alone.
struct SetOfSeverity {
  MemberSet members;
  double severity = std::numeric_limits<double>::infinity();
};
/// One whose front has no more than so many triangles, and most often nine tenths of them; nothing when
/// stop(), asked now and then, said true. Preconditions: the criterion is monotone and has a severityLimit();
/// the budget holds the root. O(the saturated cut for four times the triangles), some ten times.
std::optional<SetOfSeverity> membersOfSeverityWithin(const MultiTriangulation& mt,
                                                     const BoundedCriterion& criterion,
                                                     std::uint32_t maxTriangles,
                                                     const std::function<bool()>& stop);

}  // namespace arete
