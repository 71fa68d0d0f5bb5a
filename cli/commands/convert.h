// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete convert`: writes a mesh in another format, or an .amt plain or packed.
void addConvertCommand(CLI::App& app, Session& session);

}  // namespace arete
