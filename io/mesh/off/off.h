// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/file.h"

namespace arete {

/// Reads an OFF (Object File Format of Geomview) as text: OFF, and COFF, NOFF, STOFF and their combinations,
/// whose colours, normals and texture coordinates are skipped. The keyword may be missing, or joined to the
/// counts; the counts may lack the edges; values beyond those of a vertex or a face are skipped, up to the
/// end of the line. Faces of one or two corners are left out with a warning. Understands the comments
/// "# crs <WKT>" and "# vertical_unit <unit>".
///
/// Errors: those of readMesh(). corrupt: also a file of Arete without its last line. unsupported: also binary
/// OFF, and vertices of four or any number of coordinates (4OFF, nOFF).
Result<MeshFile> readOff(const std::filesystem::path& path, const RunContext& context = {});

/// Writes coordinates with the shortest digits that give the same double. An OFF cannot hold
/// options.triangleErrors.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writeOff(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
