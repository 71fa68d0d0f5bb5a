// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "surface/normals/made_normals.h"

namespace arete {

/// The options --normals and --crease-angle of every command that writes a mesh.
struct NormalsArguments {
  struct Options {
    CLI::Option *normals = nullptr, *creaseAngle = nullptr;
  };
  /// @param ofSmooth, ofCreases added to the sentences about them
  Options addTo(CLI::App& command, const char* ofSmooth = "", const char* ofCreases = "");

  /// A vertex of terrain has one normal unless --crease-angle is stated.
  NormalsOptions ofTerrain() const;

  NormalsOptions options = {};
  CLI::Option* creaseAngleOption = nullptr;
};

}  // namespace arete
