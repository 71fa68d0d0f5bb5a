// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

ModelKind kindOf(const AmtContainer& file);

/// Which options of a command are for one kind of model alone: their help says so, and one check refuses them
/// with a model of the other kind. All other options are for both.
class OptionKinds {
 public:
  OptionKinds() = default;
  /// @param ofTerrain, ofSurfaces how the help of an option begins that is for one kind.
  OptionKinds(std::string_view ofTerrain, std::string_view ofSurfaces);

  /// Declares an option to be for one kind. Its help begins with the kind from now on: "Of terrain: ".
  /// @return the option.
  CLI::Option* ofTerrain(CLI::Option* option) { return declare(option, ModelKind::terrain); }
  CLI::Option* ofSurfaces(CLI::Option* option) { return declare(option, ModelKind::surface); }
  /// Declares all options of a group of the help, so far, to be for terrain.
  void groupOfTerrain(CLI::App& command, const std::string& group);
  /// Declares some values of an option to be for one kind; one that ends in ':' is the start of values. The
  /// option's help says which.
  void valuesOf(ModelKind kind, const CLI::Option* option, std::vector<std::string> values);

  /// The first option that was stated and is not for that kind, as "--focus", or as "--fit rms" where its
  /// value is not. O(options).
  std::optional<std::string> statedForOther(ModelKind kind) const;
  /// Refuses statedForOther().
  /// @param hint what the user can do instead; empty: nothing.
  /// Errors: usage, with the option as the culprit.
  Status refuseOther(ModelKind kind, const std::string& hint = "") const;

 private:
  struct Declared {
    const CLI::Option* option = nullptr;
    ModelKind kind = ModelKind::terrain;
    std::vector<std::string> values{};  // empty: whatever its value
  };

  CLI::Option* declare(CLI::Option* option, ModelKind kind);

  std::string ofTerrain_ = "Of terrain", ofSurfaces_ = "Of a surface";
  std::vector<Declared> declared_;
};

}  // namespace arete
