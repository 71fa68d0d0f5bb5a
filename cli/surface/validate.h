// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"
#include "surface/laws/validate_surface.h"

namespace arete {

/// `arete validate` of the .amt file of a surface. Errors: those of loadSurfaceAmt(); brokenPromise: names
/// the law that is broken.
Status validateSurfaceFile(const AmtContainer& file, const SurfaceLawOptions& options, Session& session);

}  // namespace arete
