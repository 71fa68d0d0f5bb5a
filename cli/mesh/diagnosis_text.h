// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/query/surface/mesh_input.h"
#include "surface/diagnosis/diagnosis.h"

namespace arete {

/// The findings of a diagnosis, each kind with its first places, and the largest components and borders.
/// Lines, indented.
std::string diagnosisText(const MeshDiagnosis& diagnosis, const MeshNumbers& numbers);

}  // namespace arete
