// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Drops the messages of GDAL that no GdalErrors collects, such as those of its threads, which it would write
/// to stderr. For a program that owns its process.
void silenceGdal();

}  // namespace arete
