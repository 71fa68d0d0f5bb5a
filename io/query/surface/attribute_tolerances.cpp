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
#include "surface/model/labels.h"

namespace arete {
namespace {

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
      if (const auto size = pictureSize(bytes->bytes)) longest = std::max({longest, (*size)[0], (*size)[1]});
    }
  return longest;
}

/// Why no cut keeps what is said of faces: only what parts differ by is a line of every cut. Null: it does.
const char* whyNotKept(const SurfaceModel& model, const NamedAttribute& a) {
  using Of = NamedAttribute::Of;
  if (a.of == Of::vertices || a.of == Of::wedges) return nullptr;
  if (a.of == Of::groups) return "is not kept by cuts: they may run across groups";
  if (a.of == Of::triangles && !isLabel(model.attributes.triangleAttributes[a.index]))
    return "is of faces and averaged, and not bounded";
  if (!model.boundsLines && model.mayHaveLines())
    return "is not bounded: an earlier version built the model, whose lines may move";
  return nullptr;
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
    bool isBounded = false;  // by vertices or corners
    for (const NamedAttribute& a : *found) {
      isBounded = isBounded || a.of == NamedAttribute::Of::vertices || a.of == NamedAttribute::Of::wedges;
      if (const char* const why = whyNotKept(model, a)) return refused(one, why);
    }
    if (!isBounded) continue;
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

std::vector<AttributeNumber> statedAttributeErrors(const SurfaceModel& model,
                                                   const StatedAttributes& stated) {
  std::vector<AttributeNumber> named;
  for (std::size_t i = 0; i < stated.largest.size(); ++i) {
    const AttributeErrors& errors = model.attributeErrors[i];
    const MeshAttributes& a = model.attributes;
    std::string unit;
    for (const Attribute& attribute : errors.ofWedges ? a.wedgeAttributes : a.vertexAttributes)
      if (attribute.name == errors.inFile) unit = AttributeDistance(attribute).unit();
    named.push_back({errors.name, stated.largest[i], unit == "units" ? "" : unit});
  }
  return named;
}

}  // namespace arete
