// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/common/file.h"
#include "io/formats/ply/header.h"
#include "io/formats/ply/notes.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The properties that an attribute becomes: a scalar for each component, or one list.
struct PlyColumn {
  const Attribute* attribute;
  std::vector<std::string> properties;  ///< one name, if it is a list
  bool isList = false;
};

/// What a PLY holds of the attributes of a mesh, and how.
struct PlyColumns {
  /// Of vertices; of faces; lists of faces with values for each corner, by wedge.
  std::vector<PlyColumn> vertices, faces, corners;
  std::vector<PlyNote> notes;
  std::vector<std::string> lost;
  std::list<Attribute> converted;  ///< that columns refer to
};

/// Chooses properties that other programs know where there are some: nx ny nz, red green blue alpha, s t, and
/// the lists texcoord and color of faces. Other attributes keep their names where these are words that are
/// free; otherwise, and where vectors of vertices become scalars, a note gives the name.
///
/// Values are converted where the format means something else by them: texture coordinates count from the
/// lower side and are floats at corners, colors are sRGB, and directions are no fractions of integers. If
/// that rounds, `lost` says so. A color of 16 bits and linear becomes sRGB of 8 bits.
///
/// @param options which further properties there are.
/// @param withTextures whether faces have a texnumber.
PlyColumns plyColumns(const MeshAttributes& mesh, const MeshWriteOptions& options, bool withTextures);

/// "uchar" for a uint8.
std::string_view plyTypeName(PlyType type);

}  // namespace arete
