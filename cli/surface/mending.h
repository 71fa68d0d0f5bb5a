// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What the build mended, in lines that begin with `begin`; empty if nothing.
std::string mendedText(const SurfaceRepairs& mending, const std::string& begin);
Json mendedJson(const SurfaceRepairs& mending);

}  // namespace arete
