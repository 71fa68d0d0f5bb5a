// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/mesh/file.h"

namespace arete {

/// One mesh file format. A new one is its own pair of files and a line in the table of mesh_file.cpp.
struct MeshFormat {
  std::string_view name;       ///< "PLY"
  std::string_view extension;  ///< lower case, with its dot: ".ply"
  Result<MeshFile> (*read)(const std::filesystem::path& path, const RunContext& context);  ///< null: cannot
  Status (*write)(const TriangleMesh& mesh, const std::filesystem::path& path,
                  const MeshWriteOptions& options,
                  const RunContext& context);  ///< null: cannot
  MeshFormatTraits holds = {};
};

/// The formats this build knows.
std::span<const MeshFormat> meshFormats();

/// The extensions of the formats that can be read or written: ".ply, .obj, .stl".
std::string readableMeshExtensions();
std::string writableMeshExtensions();

/// By the extension of the path, in either case. Errors: unsupported, naming the known formats.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path);

/// Whether readMesh() is the way to read a path: its extension says so, and a GeoPackage, which may as well
/// hold points or a raster, has surfaces.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a mesh in the format its extension names. Errors, always naming the path and, where there is one,
/// the line or element: notFound, unreadable, unsupported, corrupt (truncated, hostile or nonsense),
/// interrupted. Every index of the result is valid and every coordinate finite. O(file size).
Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a mesh in the format the extension of `path` names; the file appears whole or not at all.
/// Errors: unsupported, invalidData for a mesh that does not validate(), unreadable for the disk,
/// interrupted.
Status writeMesh(const TriangleMesh& mesh, const std::filesystem::path& path,
                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
