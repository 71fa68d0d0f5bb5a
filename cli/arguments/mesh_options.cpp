// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/mesh_options.h"

#include <fmt/format.h>

#include <utility>

#include "cli/arguments/arguments.h"

namespace arete {

Result<MeshTarget> meshTarget(const MeshOutput& output, const std::string& input, Session& session) {
  const Result<MeshFormat> format = meshFormatOf(output.path, output.format);
  if (!format)
    return failure(ErrorCode::usage, format.error().message, fmt::format("--output {}", output.path));
  const std::string path = output.open(session);
  ARETE_CHECK(checkOutput("--output", path, {input}));
  return MeshTarget{*format, path};
}

void addPlacingTo(CLI::App& command, MeshPlacing& placing) {
  command
      .add_option_function<std::string>(
          "--up", [&placing](const std::string& axis) { placing.up = axis == "y" ? MeshUp::y : MeshUp::z; },
          "Axis of the input that points up, y or z: the output has the axis up that its format has,\n"
          "y in glTF, z in all others (default: nothing is turned)")
      ->check(oneOf({"y", "z"}))
      ->type_name("AXIS");
  command
      .add_option(
          "--unit", placing.unit,
          fmt::format("Length of 1 in the input, {}: the output is in metres (default: nothing is scaled)",
                      fmt::join(meshUnitNames(), ", ")))
      ->check(oneOf(meshUnitNames()))
      ->type_name("UNIT");
}

}  // namespace arete
