// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "io/amt/file.h"
#include "io/format/required_error.h"

namespace arete {

/// Reads of a file that is not packed what is wanted of its multitriangulation, and checks that, as
/// AmtFile::read() does of all: the first of its nodes, as mapped, where the same is wanted everywhere or
/// every other one of them is wanted; else these nodes and their parents, copied, numbered anew. Either way a
/// cut of it is that of the whole (see RequiredError), saturated ones by place included. Errors: those of
/// checkAmt(). Precondition: AmtFile::hasSegments(), verify is not none. O(pages of the file + nodes read),
/// parallel.
Result<MultiTriangulation> readAmtPart(const AmtFile& file, const RequiredError& wanted, AmtVerify verify,
                                       const RunContext& context = {});

}  // namespace arete
