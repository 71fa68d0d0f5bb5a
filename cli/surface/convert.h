// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

struct SurfaceConvertArguments {
  std::string output;
  bool isPacked = false, isPaged = false;
  int positionBits = 0;
};

/// `arete convert` of the .amt of a surface to its plain or packed form. Errors: those of loadSurfaceAmt()
/// and writeSurfaceModel().
Status convertSurfaceFile(const SurfaceConvertArguments& arguments, const AmtContainer& file,
                          Session& session);

/// The option --position-bits of the commands that write packed surfaces; 0: the vertices stay.
CLI::Option* addPositionBitsTo(CLI::App& command, int& positionBits);

}  // namespace arete
