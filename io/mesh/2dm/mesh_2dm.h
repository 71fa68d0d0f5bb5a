// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads a 2DM, the mesh of SMS that QGIS opens through MDAL: nodes (ND) and elements of three or four
/// corners (E3T, E4Q), under any numbers and in any order; node strings, names, materials and one-dimensional
/// elements are passed over. "# crs <WKT>" and "# vertical_unit <unit>" are understood. A file that Arete
/// wrote and that has lost its last line is refused as truncated. Errors as readMesh(); unsupported for
/// elements with curved sides (E6T, E8Q, E9Q).
Result<MeshFile> read2dm(const std::filesystem::path& path, const RunContext& context = {});

/// Writes nodes and elements numbered from 1, coordinates with as many digits as bring the same double back.
/// A 2DM has no card for a CRS or a unit: both stand in comments, which QGIS passes over (it asks for the
/// CRS). Errors as writeMesh().
Status write2dm(const TriangleMesh& mesh, const std::filesystem::path& path,
                const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
