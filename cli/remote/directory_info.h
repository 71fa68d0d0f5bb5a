// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

/// Says what the metadata and the directory of a model say, which lie at the beginning of the file: what
/// needs its triangles (the curve, the relief, the largest error, numbers of triangles) is null in the
/// answer. Fetches nothing more of a file on a server.
///
/// Errors, naming the path: corrupt: the metadata.
Status sayOfDirectory(const AmtContainer& file, Session& session);

}  // namespace arete
