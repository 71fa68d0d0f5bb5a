// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads an OFF (Object File Format of Geomview), as text or binary: OFF, and COFF, NOFF, STOFF and their
/// combinations, whose vertices have colors, normals and texture coordinates. Faces have the colors behind
/// their corners. The keyword may be missing, or joined to the counts; the counts may lack the edges. Where
/// each record has a line of its own, a color may lack its alpha, whole numbers that the keyword does not
/// state are colors if they can be, and further values are left out, with a warning. Normals that follow the
/// colors, as MeshLab writes them in an NCOFF, are recognised by their length. Faces of one or two corners
/// and indices into a map of colors are left out with a warning. Understands the comments "# crs <WKT>" and
/// "# vertical_unit <unit>".
///
/// Colors are sRGB: bytes where the file has whole numbers up to 255, else floats. Floats are doubles where
/// their digits are no float's.
///
/// Binary OFF: io/formats/off/read_binary.h.
///
/// Errors: those of readMesh(). corrupt: also a file of Arete without its last line. unsupported: also
/// vertices of four or any number of coordinates (4OFF, nOFF).
Result<MeshFile> readOff(const std::filesystem::path& path, const RunContext& context = {});

/// Writes coordinates with the shortest digits that give the same double, and attributes of vertices named
/// normal, color and texcoord, and the color of faces, in Geomview's order. Everything else is lost, as
/// options.triangleErrors are. A color of vertices gets an alpha, since Geomview wants it, and a comment that
/// it had none.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writeOff(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
