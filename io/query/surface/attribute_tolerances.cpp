// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/attribute_tolerances.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

#include "io/formats/common/picture_pixels.h"
#include "io/formats/common/pictures.h"
#include "surface/attributes/attribute_distance.h"

namespace arete {
namespace {

constexpr std::uint32_t kMostSide = 65536;

tl::unexpected<Error> refused(const AttributeNumber& asked, std::string why) {
  return failure(ErrorCode::usage, std::move(why), "attributeErrors " + asked.name);
}

/// The longest side of any picture of the materials; 0: none can be read.
std::uint32_t longestSide(const SurfaceModel& model) {
  std::uint32_t longest = 0;
  const PictureSource source(model.attributes, {});
  for (const Material& material : model.attributes.materials)
    for (const TextureUse& texture : material.textures) {
      const auto bytes = source.read(texture.picture);
      if (!bytes) continue;
      if (const auto picture = decodePicture(bytes->bytes, kMostSide))
        longest = std::max({longest, picture->width, picture->height});
    }
  return longest;
}

bool isPlaceInPicture(const SurfaceModel& model, const AttributeErrors& errors) {
  const MeshAttributes& a = model.attributes;
  return std::ranges::any_of(errors.ofWedges ? a.wedgeAttributes : a.vertexAttributes, [&](const auto& one) {
    return one.name == errors.inFile && one.meaning == AttributeMeaning::textureCoords;
  });
}

}  // namespace

Result<std::vector<AttributeTolerance>> attributeTolerances(const SurfaceModel& model,
                                                            std::span<const AttributeNumber> asked) {
  std::vector<AttributeTolerance> tolerances;
  for (const AttributeNumber& one : asked) {
    const auto found = findAttributes(model.attributes, one.name);
    if (!found) return refused(one, found.error().message);
    const bool isPart = std::ranges::any_of(*found, [](const NamedAttribute& a) {
      return a.of != NamedAttribute::Of::vertices && a.of != NamedAttribute::Of::wedges;
    });
    if (isPart) {
      if (!model.boundsLines)
        return refused(one, "is not bounded: an earlier version built the model, whose lines may move");
      continue;
    }
    if (model.attributeErrors.empty())
      return refused(one, "is not bounded in this model: build it with its attributes (`boundsAttributes`)");
    double scale = 1;
    bool isFound = false;
    for (std::size_t i = 0; i < model.attributeErrors.size(); ++i) {
      const AttributeErrors& errors = model.attributeErrors[i];
      if (errors.name != one.name && errors.inFile != one.name) continue;
      isFound = true;
      if (one.unit == "px") {
        if (!isPlaceInPicture(model, errors))
          return refused(one, "is not of texture coordinates, so it is not counted in pixels");
        const std::uint32_t side = longestSide(model);
        if (side == 0)
          return refused(one,
                         "cannot be counted in pixels: no picture of its materials is in the model; "
                         "state its own unit: 2 pixels of 1024 are 0.00195");
        scale = 1.0 / side;
      }
      tolerances.push_back({i, one.number * scale});
    }
    if (!isFound) return refused(one, "is not bounded in this model");
  }
  return tolerances;
}

std::vector<AttributeNumber> statedAttributeErrors(const SurfaceModel& model, const Cut& cut) {
  std::vector<AttributeNumber> stated;
  const std::vector<double> largest = attributeErrorsOf(model, cut);
  for (std::size_t i = 0; i < largest.size(); ++i) {
    const AttributeErrors& errors = model.attributeErrors[i];
    const MeshAttributes& a = model.attributes;
    std::string unit;
    for (const Attribute& attribute : errors.ofWedges ? a.wedgeAttributes : a.vertexAttributes)
      if (attribute.name == errors.inFile) unit = AttributeDistance(attribute).unit();
    stated.push_back({errors.name, largest[i], unit == "units" ? "" : unit});
  }
  return stated;
}

}  // namespace arete
