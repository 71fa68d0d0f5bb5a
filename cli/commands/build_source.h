// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/arguments/arguments.h"
#include "cli/session/session.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/source/source.h"
#include "io/store/amt/expected_size.h"

namespace arete {

/// Reads what `arete build` builds of (io/query/source/source.h), and writes its warnings. Errors name
/// options.
///
/// @param kind terrain, surface or points; empty: the file says.
Result<Source> readSource(const DemArguments& dem, const std::string& kind, Session& session);

/// Says, before the work, about how large the file will be, as announceSize() does of a size
/// (cli/surface/build.h).
ExpectedAmtSize announceSize(const DemRead& dem, const std::string& output, bool isPacked, Session& session);

}  // namespace arete
