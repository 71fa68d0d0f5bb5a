// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "measure/near_numbers.h"
#include "surface/attributes/attribute_names.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// A mesh, where its pictures are, and its shape as it is compared: in metres where the mesh has degrees.
struct AttributeSubject {
  const SurfaceMesh& mesh;
  std::filesystem::path folder = {};    ///< MeshFile::folder
  const TriangleMesh* shape = nullptr;  ///< null: the mesh's own
};

/// How far one attribute of a source is from another mesh's.
struct AttributeDeviation {
  std::string name;           ///< as options have it: "uv"
  std::string unit;           ///< AttributeDistance::unit(): "pixels", "" of what is equal or not
  bool isEquality = false;    ///< labels, materials, objects, groups
  std::string notComparable;  ///< why the other mesh has nothing to compare with; empty: it has
  std::optional<double> expected = {};
  bool isKept = true;  ///< what is expected
  NumbersFound found = {};
};

struct AttributeOptions {
  /// E: the largest distance of the other point, in the unit of the shapes.
  double within = 0;
  bool isStated = true;  ///< E was stated, and is a promise; else NearNumbersOptions::reachesOwn
  /// In pixels where "px" is behind the number.
  std::vector<AttributeNumber> expected = {};
  std::uint64_t samples = 0;  ///< NearNumbersOptions::samples
  std::uint64_t seed = 1;
};

struct AttributeReport {
  double within = 0;
  std::vector<AttributeDeviation> attributes;  ///< all that the source has, in the order of namedAttributes()
  /// Charts of the source's texture coordinates (chartsByPlace()), and how many of them are compared with no
  /// other chart's; 0: one of the meshes has no coordinates.
  std::uint64_t charts = 0, chartsApart = 0;
  Warnings warnings;
};

/// For points x of the source the least distance, over points y of the other mesh with |x - y| <= E, of each
/// attribute by itself (measure/near_numbers.h). x is compared with what belongs to the same material, object
/// and chart alone, where the other mesh has triangles of these (matchCharts()). Texture coordinates are
/// counted from the same side of the picture, and linear colours are brought to sRGB where one mesh has the
/// one and one the other.
///
/// Largest distances are at most what is expected, but for the rounding of 32-bit floats: 2^-22 of the
/// largest number, 0.0001 degrees. Errors: as measureNearNumbers(); usage, with "expectAttribute" and the
/// name as culprit: the source has no such attribute; pixels of what has none; no material has a picture;
/// a picture that PictureSource refuses.
Result<AttributeReport> measureAttributes(const AttributeSubject& other, const AttributeSubject& source,
                                          const AttributeOptions& options, const RunContext& context = {});

/// Whether all that is expected is kept. Errors: brokenPromise, with the first that is not and its place.
Status checkAttributes(const AttributeReport& report);

}  // namespace arete
