// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/normals_option.h"

#include <fmt/format.h>

#include <string>

#include "cli/arguments/arguments.h"

namespace arete {

NormalsArguments::Options NormalsArguments::addTo(CLI::App& command, const char* ofSmooth,
                                                  const char* ofCreases) {
  Options added;
  added.normals =
      command
          .add_option_function<std::string>(
              "--normals",
              [this](const std::string& kind) {
                options.kind = kind == "flat"     ? NormalsKind::flat
                               : kind == "smooth" ? NormalsKind::smooth
                                                  : NormalsKind::keep;
              },
              fmt::format(
                  "Normals to write: those there are (keep, default), of each triangle (flat), or smooth "
                  "but where they are hard in the file and beyond --crease-angle (smooth{})",
                  ofSmooth))
          ->check(oneOf({"keep", "flat", "smooth"}))
          ->type_name("KIND");
  added.creaseAngle =
      command
          .add_option("--crease-angle", options.creaseAngleDegrees,
                      fmt::format("Between faces that are turned by more degrees, smooth normals are hard "
                                  "(default {}{})",
                                  kCreaseDegrees, ofCreases))
          ->check(CLI::Range(0.0, 180.0))
          ->needs(added.normals)
          ->type_name("DEG");
  creaseAngleOption = added.creaseAngle;
  return added;
}

NormalsOptions NormalsArguments::ofTerrain() const {
  NormalsOptions terrain = options;
  if (creaseAngleOption == nullptr || creaseAngleOption->count() == 0) terrain.creaseAngleDegrees = 180;
  return terrain;
}

}  // namespace arete
