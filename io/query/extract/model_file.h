// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "io/store/amt/container.h"
#include "io/store/amt/file.h"

namespace arete {

/// Opens the model that a path names: a plain file; an address ("https://...", "/vsicurl/https://...") or a
/// file in a store of a cloud ("/vsis3/..."), of which parts are fetched when they are used (io/files/ranges,
/// with the settings of the process); or one of GDAL's other virtual file systems ("/vsizip/..."), which is
/// read into memory. What it holds, terrain or a surface, AmtContainer::isOfSurface() tells.
///
/// Errors, naming the path: as AmtContainer::open(), RangedFile::open() and readVirtualFile(). O(1), or
/// O(bytes) where it is read into memory.
Result<AmtContainer> openModelFile(const std::string& path, const AmtOpenOptions& options = {});

/// The same of a model of terrain. Errors: as well those of openAmt().
Result<AmtFile> openTerrainFile(const std::string& path, const AmtOpenOptions& options = {});

}  // namespace arete
