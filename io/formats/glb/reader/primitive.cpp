// SPDX-License-Identifier: GPL-3.0-or-later
//
// A primitive that Draco compressed has its connectivity and some of its attributes from there, as numbers of
// the type that the accessor states: encoders keep whole numbers as floats and the other way round. What
// the accessors say of counts is often wrong there, and not used. Where Draco's bytes cannot be decoded, the
// accessors are read if they have bytes.
//
// Positions decide what a primitive is. An attribute that does not fit them is left out by name, so that
// damaged tangents do not cost the mesh.
#include "io/formats/glb/reader/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/formats/glb/accessors.h"
#include "io/formats/glb/extensions.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr const char *kPositions = "POSITION", *kDraco = "KHR_draco_mesh_compression";

tl::unexpected<Error> corrupt(std::string message) {
  return failure(ErrorCode::corrupt, std::move(message));
}

/// Whether an attribute may have that many components.
bool fits(const std::string& name, std::uint8_t components) {
  if (name == kPositions || name == "NORMAL") return components == 3;
  if (name == "TANGENT") return components == 4;
  if (name.starts_with("TEXCOORD_")) return components == 2;
  if (name.starts_with("COLOR_")) return components == 3 || components == 4;
  return true;
}

GltfElements packedElements(const std::string& bytes, ScalarType type, int components) {
  GltfElements elements;
  elements.first = bytes.data();
  elements.type = type;
  elements.components = elements.rows = static_cast<std::uint8_t>(components);
  elements.stride = sizeOf(type) * elements.components;
  elements.columnStride = static_cast<std::uint8_t>(elements.stride);
  elements.count = bytes.size() / elements.stride;
  return elements;
}

/// The numbers of an attribute as another type.
GltfElements converted(const GltfElements& from, ScalarType type) {
  Attribute numbers{.name = {}, .type = type, .components = from.components};
  std::vector<double> element(from.components);
  for (std::uint64_t i = 0; i < from.count; ++i) {
    for (std::size_t c = 0; c < element.size(); ++c)
      element[c] = isFloat(type) ? from.value(i, c) : from.number(i, c);
    numbers.append(element);
  }
  const auto bytes = std::make_shared<const std::string>(reinterpret_cast<const char*>(numbers.values.data()),
                                                         numbers.values.size());
  GltfElements to = packedElements(*bytes, type, from.components);
  to.owned = bytes;
  return to;
}

}  // namespace

Result<std::optional<GltfPrimitives::Draco>> GltfPrimitives::dracoOf(const Json& primitive) {
  const Json* const extension = extensionOf(primitive, kDraco);
  if (extension == nullptr) return std::nullopt;
  const auto decode = [&]() -> Result<std::optional<Draco>> {
    ARETE_TRY(const auto number, GltfDocument::wholeNumber(*extension, "bufferView"));
    const auto ids = extension->find("attributes");
    if (ids == extension->end() || !ids->is_object() || !ids->contains(kPositions))
      return corrupt("has Draco data without positions");
    auto known = draco_.find(number);
    if (known == draco_.end()) {
      draco_[number] = nullptr;  // so that damaged bytes are decoded once
      ARETE_TRY(const auto view, document_.views().view(document_, number));
      Result<DracoMesh> mesh = decodeDraco(view.bytes, document_.views().reservable(), context_);
      if (!mesh)
        return failure(mesh.error().code, fmt::format("bufferView {} {}", number, mesh.error().message));
      std::uint64_t bytes = mesh->indices.size() * sizeof(std::uint32_t);
      for (const DracoAttribute& attribute : mesh->attributes) bytes += attribute.bytes.size();
      ARETE_CHECK(document_.views().reserve(bytes));
      draco_[number] = std::make_shared<const DracoMesh>(std::move(*mesh));
      known = draco_.find(number);
    }
    if (known->second == nullptr) return corrupt("has damaged Draco data");
    return Draco{number, known->second, &*ids};
  };
  Result<std::optional<Draco>> draco = decode();
  if (draco || draco.error().code == ErrorCode::interrupted || draco.error().code == ErrorCode::outOfMemory)
    return draco;
  const auto position = GltfDocument::wholeNumber(primitive["attributes"], kPositions);
  if (!position) return draco;
  const auto accessor = document_.element("accessors", *position);
  if (!accessor || !(*accessor)->contains("bufferView")) return draco;
  return std::nullopt;
}

Result<GltfAttribute> GltfPrimitives::attributeOf(const std::string& name, const Json& attributes,
                                                  const std::optional<Draco>& draco) const {
  GltfAttribute attribute;
  attribute.name = name;
  ARETE_TRY(const auto number, GltfDocument::wholeNumber(attributes, name.c_str()));
  attribute.source = number;
  if (!draco || !draco->attributes->contains(name)) {
    ARETE_TRY(const auto elements, document_.accessor(number, {}));
    attribute.elements = elements;
    return attribute;
  }
  ARETE_TRY(const auto id, GltfDocument::wholeNumber(*draco->attributes, name.c_str()));
  const auto found = std::ranges::find_if(draco->mesh->attributes, [&](const DracoAttribute& a) {
    return a.uniqueId >= 0 && std::uint64_t(a.uniqueId) == id;
  });
  if (found == draco->mesh->attributes.end() || found->components < 1 || found->components > 16)
    return corrupt(fmt::format("has no Draco attribute {}", id));
  attribute.elements = packedElements(found->bytes, found->type, found->components);
  attribute.elements.owned = draco->mesh;
  attribute.elements.isNormalized = found->normalized && !isFloat(found->type);
  if (attribute.elements.count < draco->mesh->points)
    return corrupt(fmt::format("has a Draco attribute of {} elements for {} points", attribute.elements.count,
                               draco->mesh->points));
  attribute.elements.count = draco->mesh->points;
  attribute.source |= (draco->view + 1) << 32;
  // The accessor says which type the numbers are meant to be of.
  if (const auto stated = document_.element("accessors", number)) {
    const auto component = GltfDocument::wholeNumber(**stated, "componentType");
    const auto type = component ? scalarTypeOf(*component) : std::nullopt;
    if (type && *type != found->type) attribute.elements = converted(attribute.elements, *type);
    const auto normalized = (*stated)->find("normalized");
    if (normalized != (*stated)->end() && normalized->is_boolean())
      attribute.elements.isNormalized = *normalized == true && !isFloat(attribute.elements.type);
  }
  return attribute;
}

Status GltfPrimitives::readAttributes(const Json& attributes, const std::optional<Draco>& draco,
                                      GltfPrimitive& to) {
  ARETE_TRY(GltfAttribute positions, attributeOf(kPositions, attributes, draco));
  if (!fits(kPositions, positions.elements.components))
    return corrupt(fmt::format("accessor {} is not of the type VEC3 that is needed", positions.source));
  if (positions.elements.count == 0) return corrupt("has no positions");
  to.attributes.push_back(std::move(positions));
  for (const auto& [name, value] : attributes.items()) {
    if (name == kPositions) continue;
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) {
      leftOut_.jointsWithoutSkin = true;
      continue;
    }
    Result<GltfAttribute> attribute = attributeOf(name, attributes, draco);
    if (!attribute)
      leftOut_.attributes[name] = attribute.error().message;
    else if (!fits(name, attribute->elements.components))
      leftOut_.attributes[name] = fmt::format("it has {} components", attribute->elements.components);
    else if (attribute->elements.count != to.vertices())
      leftOut_.attributes[name] =
          fmt::format("it is of {} vertices, of {}", attribute->elements.count, to.vertices());
    else
      to.attributes.push_back(std::move(*attribute));
  }
  return {};
}

Status GltfPrimitives::readIndices(const Json& primitive, const std::optional<Draco>& draco,
                                   GltfPrimitive& to) const {
  to.corners = to.vertices();
  if (draco) {
    const auto& indices = draco->mesh->indices;
    GltfElements elements;
    elements.first = reinterpret_cast<const char*>(indices.data());
    elements.count = indices.size();
    elements.type = ScalarType::uint32;
    elements.stride = elements.columnStride = sizeof(std::uint32_t);
    elements.owned = draco->mesh;
    to.indices = elements;
    to.mode = GltfPrimitive::Mode::list;  // what Draco gives
    to.corners = elements.count;
  } else if (primitive.contains("indices")) {
    ARETE_TRY(const auto number, GltfDocument::wholeNumber(primitive, "indices"));
    ARETE_TRY(const auto found, document_.accessor(number, "SCALAR"));
    if (found.type != ScalarType::uint8 && found.type != ScalarType::uint16 &&
        found.type != ScalarType::uint32)
      return corrupt("has indices that are not unsigned whole numbers");
    to.indices = found;
    to.corners = found.count;
  }
  if (to.mode == GltfPrimitive::Mode::list && to.corners % 3 != 0)
    return corrupt(fmt::format("has {} corners, not a multiple of three", to.corners));
  return {};
}

Status GltfPrimitives::readTargets(const Json& primitive, const std::vector<double>& weights,
                                   GltfPrimitive& to) const {
  const auto targets = primitive.find("targets");
  if (targets == primitive.end()) return {};
  if (!targets->is_array()) return corrupt("has targets that are not a list");
  if (!weights.empty() && weights.size() != targets->size())
    return corrupt(fmt::format("has {} morph targets and {} weights", targets->size(), weights.size()));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Json& target = (*targets)[i];
    if (weights[i] == 0 || !target.is_object()) continue;
    for (const GltfAttribute& attribute : to.attributes) {
      if (!target.contains(attribute.name)) continue;
      ARETE_TRY(const auto number, GltfDocument::wholeNumber(target, attribute.name.c_str()));
      ARETE_TRY(const auto moves, document_.accessor(number, {}));
      if (moves.count != to.vertices())
        return corrupt(fmt::format("has {} positions and a morph target of {}", to.vertices(), moves.count));
      const bool isTangent = attribute.name == "TANGENT";  // whose sign does not move
      if (moves.components != (isTangent ? 3 : attribute.elements.components))
        return corrupt(fmt::format("has a morph target of {} components", moves.components));
      to.morphs.push_back({attribute.name, number, weights[i], moves});
      leftOut_.appliedMorphs = true;
    }
  }
  return {};
}

Result<std::optional<GltfPrimitive>> GltfPrimitives::read(const Json& primitive,
                                                          const std::vector<double>& weights) {
  if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object())
    return corrupt("has no attributes");
  const Json& attributes = primitive["attributes"];
  ARETE_TRY(const auto mode, GltfDocument::wholeNumber(primitive, "mode", 4));
  if (mode > 6) return corrupt(fmt::format("is of mode {}, which glTF does not have", mode));
  if (mode < 4) {
    ++leftOut_.pointsAndLines;
    return std::nullopt;
  }
  if (!attributes.contains(kPositions)) {
    ++leftOut_.withoutPositions;
    return std::nullopt;
  }
  GltfPrimitive read;
  read.mode = static_cast<GltfPrimitive::Mode>(mode);
  ARETE_TRY(const auto draco, dracoOf(primitive));
  ARETE_CHECK(readAttributes(attributes, draco, read));
  ARETE_CHECK(readIndices(primitive, draco, read));
  ARETE_CHECK(readTargets(primitive, weights, read));
  if (primitive.contains("material")) {
    const auto material = GltfDocument::wholeNumber(primitive, "material");
    if (material && document_.element("materials", *material))
      read.material = static_cast<std::uint32_t>(*material);
    else
      ++leftOut_.unknownMaterials;
  }
  return read;
}

}  // namespace arete
