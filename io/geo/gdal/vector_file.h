// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/geo/gdal/support.h"

namespace arete {

/// Opens a file of vectors, of which nothing has been cut off as far as its format tells: by the length that
/// its header states (io/geo/gdal/file_length.h), by its records (io/geo/gdal/whole_text.h), and by what GDAL
/// says meanwhile.
///
/// @param kind Completes "is not a ...": "set of points".
/// @param options "NAME=value", as the driver takes them.
/// @param errors The innermost scope of the caller. Messages of the opening that are no error move to
/// `warnings`.
///
/// Errors: those of explainOpenFailure(). unreadable, corrupt: a part of the file is missing.
Result<GdalDatasetPtr> openVectors(const std::string& path, std::string_view kind, GdalErrors& errors,
                                   Warnings& warnings, const std::vector<std::string>& options = {});

/// Holds the features read against the count that the header of a FlatGeobuf states: GDAL ends without a word
/// where a file is cut between two of them. Layers of other formats pass.
///
/// Errors: corrupt: fewer were read.
Status checkFeatureCount(GDALDataset& dataset, OGRLayer& layer, std::uint64_t read);

}  // namespace arete
