// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "engine/criteria/criterion.h"

namespace arete {

using CriterionParts = std::vector<std::shared_ptr<const Criterion>>;

/// Fine enough for every part. Its severity is the largest of the parts that are not satisfied, so their
/// severities must have the same unit. Bounded if all parts are. Precondition: at least one part, none null.
std::shared_ptr<const Criterion> allOf(CriterionParts parts);

/// Fine enough for at least one part. Its severity is the smallest of the parts': the part that is nearest to
/// being satisfied. Bounded if all parts are. Precondition: at least one part, none null.
std::shared_ptr<const Criterion> anyOf(CriterionParts parts);

}  // namespace arete
