// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/mesh.h"

#include "cli/mesh/crop.h"
#include "cli/mesh/decimate.h"
#include "cli/mesh/info.h"
#include "cli/mesh/place.h"
#include "cli/mesh/repair.h"

namespace arete {

void addMeshCommand(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("mesh", "Examine, mend, crop, place and decimate surfaces of triangles");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  arete mesh info   scan.ply\n"
      "  arete mesh repair scan.obj -o clean.obj\n"
      "  arete mesh crop   scan.obj -o part.obj --box 0,0,0,10,10,2\n"
      "  arete mesh place  scan.obj -o turned.obj --turn 0,90,0\n"
      "  arete mesh decimate scan.obj -o small.obj --max-triangles 5000\n"
      "\narete mesh COMMAND --help lists the options of a command.");
  addMeshInfoCommand(*command, session);
  addMeshRepairCommand(*command, session);
  addMeshCropCommand(*command, session);
  addMeshPlaceCommand(*command, session);
  addMeshDecimateCommand(*command, session);
}

}  // namespace arete
