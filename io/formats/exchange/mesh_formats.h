// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/formats/common/file.h"

namespace arete {

/// One mesh file format. A new format is a folder in io/formats and a line in the table of
/// mesh_formats.cpp.
struct MeshFormat {
  std::string_view name;       ///< "PLY"
  std::string_view extension;  ///< lower case, with its dot: ".ply"
  Result<MeshFile> (*read)(const std::filesystem::path& path,
                           const RunContext& context);  ///< null: not supported
  Result<MeshWriteReport> (*write)(MeshRef mesh, const std::filesystem::path& path,
                                   const MeshWriteOptions& options,
                                   const RunContext& context);  ///< null: not supported
  MeshFormatTraits holds = {};
};

/// The formats this build knows.
std::span<const MeshFormat> meshFormats();

/// The extensions of the formats that can be read or written: ".ply, .obj, .stl".
std::string readableMeshExtensions();
std::string writableMeshExtensions();

/// Finds the format by the extension of the path, in either case, or by its name.
///
/// @param name "ply": the extension without its dot, in either case; empty: the path decides.
///
/// Errors: unsupported: lists the known formats.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path, std::string_view name = {});

/// @return True if readMesh() can read the path: by its extension and, for a GeoPackage, if it holds surfaces
/// rather than points or a raster.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a mesh in the format that the extension or `name` says. Every index of the result is valid and every
/// coordinate finite. A soup is joined (io/formats/exchange/joined.h).
///
/// @param name as in meshFormatOf().
///
/// Errors, with the path as culprit and the line or element in the message: notFound, unreadable,
/// unsupported. corrupt: truncated, altered or invalid. interrupted. O(file size).
Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context = {},
                          std::string_view name = {});

/// As readMesh(), and a PLY of points, which has no faces, is a mesh without triangles.
Result<MeshFile> readMeshOrPoints(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a mesh in the format that options.format or the extension of `path` names. The file and those
/// beside it appear complete and together, or not at all; a pipe or a device is written in place.
///
/// Errors: unsupported; a GeoPackage to a pipe. invalidData: the mesh does not validate(). notFound,
/// unreadable, interrupted.
Result<MeshWriteReport> writeMesh(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
