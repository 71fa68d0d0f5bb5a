// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"

namespace arete {

/// Adds to an error what to do instead, where a command was given a file of another kind than it takes: of a
/// DEM or a mesh in place of an .amt, how to build one.
///
/// @param error its culprit is the file.
/// @param command its name, "extract".
Error withNextStep(Error error, const std::string& command);

}  // namespace arete
