// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "cli/view/arguments.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

/// `arete view` of a surface: the window; with --headless one picture, or those of one turn around it and
/// their film.
///
/// Precondition: no option is stated that is for terrain. Errors: usage, naming the option; those of reading,
/// drawing and writing.
Status viewSurface(ViewArguments arguments, const AmtContainer& file, Session& session);

}  // namespace arete
