// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/multitriangulation.h"
#include "engine/result.h"
#include "engine/run_context.h"
#include "io/amt_file.h"
#include "io/wanted_error.h"

namespace arete {

/// Reads of a file that is not packed what is wanted of its multitriangulation, and checks that, as
/// AmtFile::read() does of all: the first of its nodes, as mapped, where the same is wanted everywhere or
/// every other one of them is wanted; else these nodes and their parents, copied, numbered anew. Either way a
/// cut of it is that of the whole (see WantedError), saturated ones by place included. Errors: those of
/// checkAmt(). Precondition: AmtFile::hasPieces(), verify is not none. O(pages of the file + nodes read),
/// parallel.
Result<MultiTriangulation> readAmtPart(const AmtFile& file, const WantedError& wanted, AmtVerify verify,
                                       const RunContext& context = {});

}  // namespace arete
