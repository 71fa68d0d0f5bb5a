// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"

namespace arete {

/// `arete info` of a scene: its files, its objects, where they stand and how many triangles they have.
/// Errors: readScene(), openScene().
Status sayAboutScene(const std::string& path, Session& session);

}  // namespace arete
