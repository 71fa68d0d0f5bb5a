// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/file.h"
#include "io/store/format/required_error.h"

namespace arete {

/// Reads and checks the part of a file's multitriangulation that a query requires: the first nodes, as
/// mapped, where the same error is required everywhere or more than half of the nodes are needed; otherwise a
/// copy of the required nodes and their ancestors, renumbered. Cuts of the part are those of the whole (see
/// RequiredError), saturated cuts by place included.
/// Precondition: the file is not packed, AmtFile::hasSegments(), verify is not none.
/// Errors: those of checkAmt(). O(cluster groups of the file + nodes read), parallel.
Result<MultiTriangulation> readAmtPart(const AmtFile& file, const RequiredError& wanted, AmtVerify verify,
                                       const RunContext& context = {});

}  // namespace arete
