// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "io/query/surface/mesh_input.h"
#include "surface/diagnosis/diagnosis.h"

namespace arete {

/// All of a diagnosis, by the numbers of the file: docs/topics/meshes.md lists the fields.
Json diagnosisJson(const MeshDiagnosis& diagnosis, const MeshNumbers& numbers);

/// A position as a list of three numbers.
Json toJson(const Vec3& position);

}  // namespace arete
