// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"
#include "io/query/surface/mesh_input.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// What is in a mesh, and what is the matter with it.
struct MeshFacts {
  MeshDiagnosis diagnosis;
  double area = 0;
  std::optional<double> volume;  ///< of a solid; negative where the faces turn inwards
  std::uint64_t seamEdges = 0;
};

/// Examines a mesh. Errors: as diagnose(). O(n log n).
Result<MeshFacts> meshFactsOf(const SurfaceMesh& mesh, const DiagnosisOptions& options,
                              const RunContext& context = {});

/// The facts as JSON, as `arete mesh info --json` prints them: docs/topics/meshes.md lists the fields.
/// Findings name vertices and faces by the numbers of the file.
nlohmann::ordered_json meshFactsJson(const std::string& path, const MeshInput& input, const MeshFacts& facts);

/// Whether a picture is in the mesh or a file in its folder or below.
bool hasPicture(const MeshFile& file, const std::string& picture);

/// "float32".
std::string_view nameOf(ScalarType type);

}  // namespace arete
