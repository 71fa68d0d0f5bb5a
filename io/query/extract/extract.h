// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/extract/model.h"
#include "io/query/extract/tin.h"
#include "io/query/request/extract_request.h"
#include "io/query/surface/extractor.h"

namespace arete {

/// What became of a request to a model of either kind.
using ExtractReport = std::variant<ExtractedTin, ExtractedSurface>;

/// Takes the cut of a request, fits or displaces it, writes it, reads it back and measures it where that is
/// asked for, and writes the certificate. The files appear whole and together, or none. Several requests
/// share more where they go to one TinExtractor or SurfaceExtractor, which this calls.
/// @param modelPath  the file's name, for the certificate
/// Errors: as TinExtractor::extract() and SurfaceExtractor::extract().
Result<ExtractReport> extract(const Model& model, const ExtractRequest& request,
                              const RunContext& context = {}, const std::string& modelPath = {});

/// The report as JSON, as `arete extract --json` prints it.
nlohmann::ordered_json toJson(const ExtractRequest& request, const ExtractReport& report);

/// What ended the refinement where an error and a budget are stated, or a deadline: "maxError",
/// "maxTriangles", "deadline"; empty: nothing to say.
std::string_view endedBy(const CutRequest& request, bool isComplete);

}  // namespace arete
