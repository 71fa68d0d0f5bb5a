// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/drop_attributes.h"

#include <fmt/format.h>

#include "cli/session/option_names.h"
#include "io/query/mesh/seams.h"
#include "surface/edit/drop_attributes.h"

namespace arete {
CLI::Option* addDropAttributesTo(CLI::App& command, std::vector<std::string>& names) {
  return command
      .add_option("--drop-attributes", names,
                  "Attributes to leave out, by their names, and objects, groups, materials")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME[,NAME]");
}

Status dropNamed(SurfaceMesh& mesh, const std::vector<std::string>& names) {
  Status dropped = dropAttributes(mesh, names);
  if (!dropped && dropped.error().code == ErrorCode::usage)
    dropped.error().culprit = fmt::format("--drop-attributes {}", dropped.error().culprit);
  return dropped;
}

std::string seamsOf(const SurfaceMesh& mesh) {
  return withOptionNames(seamsText(mesh));
}

}  // namespace arete
