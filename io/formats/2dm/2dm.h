// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/formats/common/file.h"

namespace arete {

/// The attribute of triangles that holds the number of a material, one integer.
inline constexpr std::string_view k2dmMaterialName = "material";

/// Reads a 2DM, the mesh format of SMS, which QGIS opens through MDAL: nodes (ND) and elements of three or
/// four corners (E3T, E4Q), with any numbers and in any order. The numbers of their materials become the
/// attribute k2dmMaterialName of the triangles unless all are 1 or missing; an element without one has 0.
/// Other cards (node strings, names, one-dimensional elements) and further values are left out and counted in
/// MeshFile::warnings. Understands the comments "# crs <WKT>" and "# vertical_unit <unit>".
///
/// Errors: those of readMesh(). corrupt: also a file written by Arete that lacks its last line. unsupported:
/// also elements with curved sides (E6T, E8Q, E9Q).
Result<MeshFile> read2dm(const std::filesystem::path& path, const RunContext& context = {});

/// Writes nodes and elements numbered from 1, of the materials that the attribute k2dmMaterialName states,
/// else of material 1. Coordinates have the fewest digits that read back as the same double. The format has
/// no line type for a CRS or a unit, so both are comments. QGIS ignores them and prompts for the CRS.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> write2dm(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
