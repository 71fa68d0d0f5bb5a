// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "cli/arguments/option_kinds.h"
#include "engine/base/result.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// The words of a list with commas. Errors: usage: one that is not known, naming the option.
Result<std::set<std::string_view>> wordsOf(const char* option, std::string_view list,
                                           std::span<const std::string_view> known);

/// What is shown of surfaces, and under what light.
struct SurfaceLookArguments {
  std::string without;                ///< "textures,materials,vertex-colors"; empty: with all of them
  std::string shading, sides, light;  ///< empty: as the file says, under all of the light

  void addTo(CLI::App& command, const std::string& group, OptionKinds& kinds);
  /// Errors: usage: a word that is not in a list.
  Result<SurfaceLook> look() const;
};

}  // namespace arete
