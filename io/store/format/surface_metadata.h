// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/store/format/metadata_head.h"
#include "io/store/format/summary.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The content of the metadata chunk of a surface: all of a model but its arrays and its looks.
struct SurfaceMetadata : AmtHead {
  std::uint64_t wedges = 0;
  bool hasDoubles = false;   ///< places are doubles, not floats
  bool hasAllFaces = false;  ///< every triangle has a face number, not only those of the finest front
  std::uint64_t finestTriangles = 0;
  AmtSummary summary;       ///< of a file in pages
  double positionStep = 0;  ///< of a packed file: see io/store/packed/packed.h
  SurfaceModel model;       ///< without mt, arrays and attributes
};

/// As for terrain (io/store/format/metadata.h).
SurfaceMetadata amtMetadataOf(const SurfaceModel& model, std::string writer);
std::optional<std::string> findAmtProblem(const SurfaceMetadata& metadata);
std::string toAmtJson(const SurfaceMetadata& metadata);
Result<SurfaceMetadata> fromSurfaceJson(std::string_view text);
AmtFacts amtFactsOf(const SurfaceMetadata& metadata);

/// What a file says of the looks of a surface: declarations of attributes and of their errors, objects,
/// groups, materials, pictures, as JSON. The values are in chunks of their own.
std::string toLooksJson(const SurfaceModel& model);
/// Reads it into model.attributes, without values. Errors: corrupt.
/// @param faces those that lists of numbers by face get.
/// @param attributeBytes the size of the values, which memory for these lists is held against.
/// @param pictureBytes receives the sizes of the pictures.
Status fromLooksJson(std::string_view text, std::uint64_t faces, std::uint64_t attributeBytes,
                     SurfaceModel& model, std::vector<std::uint64_t>& pictureBytes);

/// The codes of all errors of attributes, one attribute after the other.
std::vector<std::uint16_t> attributeErrorCodesOf(const SurfaceModel& model);
/// Takes them apart. Errors: corrupt: another number than the declarations need.
Status takeAttributeErrorCodes(std::span<const std::uint16_t> codes, SurfaceModel& model);

/// The values of all attributes one after the other, then the objects, groups, materials and file's faces of
/// the faces, as far as there are.
std::vector<std::byte> attributeBytesOf(const SurfaceModel& model);
/// Takes them apart. Errors: corrupt: another number of bytes than the declarations need.
Status takeAttributeBytes(std::span<const std::byte> bytes, std::uint64_t vertices, SurfaceModel& model);

}  // namespace arete
