// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete convert`: a mesh from one format into another.
void addConvertCommand(CLI::App& app, Session& session);

}  // namespace arete
