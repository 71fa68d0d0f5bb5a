// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/base/vec.h"
#include "io/query/surface/mesh_input.h"
#include "surface/diagnosis/diagnosis.h"

namespace arete {

/// All of a diagnosis, by the numbers of the file: docs/topics/meshes.md lists the fields.
nlohmann::ordered_json diagnosisJson(const MeshDiagnosis& diagnosis, const MeshNumbers& numbers);

/// A position as a list of three numbers.
nlohmann::ordered_json positionJson(const Vec3& position);

}  // namespace arete
