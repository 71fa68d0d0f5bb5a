// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/criteria/region.h"
#include "io/files/existing_file.h"
#include "io/geo/bent/target.h"
#include "io/query/request/cut_request.h"
#include "surface/normals/made_normals.h"

namespace arete {

/// One mesh to take from a model, and the files to write.
struct ExtractRequest {
  CutRequest criterion;
  std::optional<Region> region;  ///< of terrain: criterion.region in plan coordinates
  /// A mesh by its extension; of terrain also .tif: sampled back on the source grid. Empty: a cut alone, of
  /// which readForExtract() reads what it needs.
  std::string output;
  std::string format;       ///< MeshWriteOptions::format; empty: by the extension
  PlaceTarget place = {};   ///< of terrain: where the mesh is led, with edges split where that bends it
  std::string certificate;  ///< JSON; empty = none
  std::string errorRaster;  ///< of terrain: GeoTIFF of z_TIN - z_DEM; empty = none
  /// What happens to the other layers of a GeoPackage that exists.
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  std::string map =
      {};  ///< of a surface: CSV of vertices and faces (io/query/surface/map_file.h); empty = none
  std::vector<std::string> dropAttributes = {};  ///< of a surface: names that dropAttributes() leaves out
  /// Of a surface made of the faces of the cut; smooth ones of terrain come from the finest triangles
  /// (io/query/extract/tin_normals.h).
  NormalsOptions normals = {};
  std::optional<int> packedBits = {};  ///< MeshPacking::positionBits of a packed glTF; empty: not packed
  bool flipsV = false;                 ///< of a surface: flipTextures()
  bool keepsMesh = false;         ///< of terrain: the result holds the mesh, and the error of each sample
  bool measuresBothWays = false;  ///< of a surface: also measure how far the result is from the source
};

}  // namespace arete
