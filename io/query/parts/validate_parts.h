// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/file.h"
#include "terrain/laws/validate_model.h"

namespace arete {

struct ValidatePartsOptions {
  ValidateModelOptions laws;  ///< `rows` is not regarded
  /// Rows of samples of a part at most; within a memory budget it has fewer where it must.
  std::uint32_t mostRows = std::numeric_limits<std::uint32_t>::max();
};

/// What was checked where every law holds.
struct ValidatedParts {
  std::uint64_t parts = 0;
  std::uint64_t pages = 0;  ///< of the file, each of which was read once at least, and its checksums checked
  ErrorsChecked errors;     ///< of law 10, over all parts: a triangle counts in each that has it
};

/// Checks the laws of a raster in pages part by part: rows of samples at full resolution, with every ancestor
/// of their nodes, which is a multitriangulation in itself (validateModel()). Each node is in a part, and so
/// is each triangle with each sample below it: a stored number that breaks a law breaks it there. The
/// heights of all rows together have the checksum of the source. As many rows are taken at once as the memory
/// budget allows (engine/memory/required_memory.h).
///
/// A violation is the first one of the first part that has one. It names the rows, and triangles and nodes
/// by their numbers in the part.
/// Precondition: the file is in pages and of a raster.
/// Errors: brokenPromise: the violation; corrupt: a page; outOfMemory: the pages of a few rows are too many;
/// interrupted. O(as validateModel()), and the ancestors again for each part.
Result<ValidatedParts> validateInParts(const AmtFile& file, const ValidatePartsOptions& options = {},
                                       const RunContext& context = {});

}  // namespace arete
