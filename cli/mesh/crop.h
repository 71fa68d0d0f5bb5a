// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete mesh crop FILE -o OUT --box BOX`: takes the part of a mesh in a box.
void addMeshCropCommand(CLI::App& mesh, Session& session);

}  // namespace arete
