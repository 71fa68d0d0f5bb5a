// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "io/query/extract/tin.h"
#include "io/store/amt/file.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The part of a file that requests need, and the cut that proved it to be enough.
struct PartAndCut {
  TerrainModel model;
  /// The cut of the only request, taken of `model` with its full tolerance; pass it to
  /// TinExtractor::extract(). Empty where the part follows from the request alone.
  std::optional<Cut> cut;
};

/// Reads the part of a file that these requests need. Their TINs are those of the whole file, with one
/// exception: the minimal cut of a packed file for a camera may have other triangles (a few less as a rule,
/// all within the tolerance). Its criterion bounds the error over a ball around a node's descendants, and a
/// packed file stores no such balls: they are made of the nodes that were read.
///
/// Where a format rounds heights, the part is enough for a tolerance smaller by TinExtractor::kReadReserve of
/// it. The whole file is read where a TIN is measured against all samples, fitted to them or shaded by them,
/// where a deadline alone ends the cut, and for a saturated cut by region, focus or camera of a packed file.
///
/// @param outline  a part of the file's model, its root at least
/// @return the part, and the cut where one had to be taken to know that the part is enough
/// Errors: usage: a request that makes no sense, a budget below the root's triangles; interrupted;
/// outOfMemory; those of AmtFile::read().
Result<PartAndCut> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                  const TerrainModel& outline, const RunContext& context = {});

}  // namespace arete
