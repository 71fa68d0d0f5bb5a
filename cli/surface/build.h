// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/query/surface/build_model.h"
#include "io/store/amt/expected_size.h"

namespace arete {

struct SurfaceBuildArguments {
  std::string input, output;
  SurfaceFileOptions options;
  bool isPacked = false, isPaged = false;
  int positionBits = 0;
};

/// `arete build` of a mesh with faces: builds, writes, reports. Errors: those of
/// buildSurfaceModel() and writeSurfaceModel().
Status buildSurfaceFile(const SurfaceBuildArguments& arguments, MeshInput input, double secondsToRead,
                        Session& session);

/// Says, before the work, about how large the file will be in its plain and in its packed form; with --json
/// the answer says it. Warns where the file system of the output has less room than that.
void announceSize(const ExpectedAmtSize& size, const std::string& output, bool isPacked, Session& session);

}  // namespace arete
