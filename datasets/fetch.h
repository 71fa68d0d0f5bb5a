// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "datasets/catalogue.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Cuts a box out of a public DEM into a GeoTIFF, samples, NODATA and CRS as published. Tiles that do not
/// exist (open sea in most collections) are left out, as NODATA, and named in `warnings`. The file appears
/// whole or not at all.
///
/// Errors: usage (the box), notFound (no tile could be read: no network, or only sea), unreadable (the output
/// cannot be written), interrupted.
Status fetchPublicDem(const PublicDem& dem, const Box2& degrees, std::string_view mirror,
                      const std::string& output, Warnings& warnings, const RunContext& context = {});

}  // namespace arete
