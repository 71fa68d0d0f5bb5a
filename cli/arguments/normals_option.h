// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "surface/normals/made_normals.h"

namespace arete {

/// The options --normals and --crease-angle of every command that writes a mesh of a surface.
struct NormalsArguments {
  struct Options {
    CLI::Option *normals = nullptr, *creaseAngle = nullptr;
  };
  Options addTo(CLI::App& command);

  NormalsOptions options = {};
};

}  // namespace arete
