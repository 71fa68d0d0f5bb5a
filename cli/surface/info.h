// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

/// `arete info` of the .amt file of a surface.
/// @param at the errors of its curve, as --at states them; empty: round shares of the diagonal.
/// @param mostPoints how many of these shares at most; the largest are kept.
/// Errors: those of loadSurfaceAmt(); usage, naming the option.
Status sayAboutSurface(const AmtContainer& file, const std::string& at, std::size_t mostPoints,
                       Session& session);

}  // namespace arete
