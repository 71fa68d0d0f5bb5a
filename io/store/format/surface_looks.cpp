// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names can be many (objects of a city), so the looks are a chunk of their own, and their values one of
// bytes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "io/files/text/json_tree.h"
#include "io/store/format/json_fields.h"
#include "io/store/format/surface_metadata.h"

namespace arete {
namespace {

using Json = nlohmann::json;
using json_fields::Choice;

/// More distances of attribute errors than any version writes.
constexpr std::size_t kMostDistances = 64;

constexpr std::array<Choice<ScalarType>, 8> kTypes = {{{ScalarType::int8, "int8"},
                                                       {ScalarType::uint8, "uint8"},
                                                       {ScalarType::int16, "int16"},
                                                       {ScalarType::uint16, "uint16"},
                                                       {ScalarType::int32, "int32"},
                                                       {ScalarType::uint32, "uint32"},
                                                       {ScalarType::float32, "float32"},
                                                       {ScalarType::float64, "float64"}}};
constexpr std::array<Choice<AttributeMeaning>, 5> kMeanings = {
    {{AttributeMeaning::other, "other"},
     {AttributeMeaning::normal, "normal"},
     {AttributeMeaning::tangent, "tangent"},
     {AttributeMeaning::textureCoords, "textureCoords"},
     {AttributeMeaning::color, "color"}}};
constexpr std::array<Choice<ColorSpace>, 3> kSpaces = {
    {{ColorSpace::none, "none"}, {ColorSpace::srgb, "srgb"}, {ColorSpace::linear, "linear"}}};

/// The reader and the writer visit the same fields, so a field cannot be in one of them only.
template <class Visitor, class A>
void visitAttribute(Visitor& visitor, A& a) {
  visitor.field("name", a.name);
  visitor.choice("meaning", a.meaning, kMeanings);
  visitor.choice("type", a.type, kTypes);
  visitor.flag("isNormalized", a.isNormalized);
  visitor.choice("colorSpace", a.colorSpace, kSpaces);
  visitor.flag("isFromTop", a.isFromTop);
}

template <class Visitor, class M>
void visitMaterial(Visitor& visitor, M& m) {
  visitor.field("name", m.name);
  visitor.field("baseColor", m.baseColor);
  visitor.flag("isDoubleSided", m.isDoubleSided);
  visitor.field("alphaMode", m.alphaMode);
  visitor.field("alphaCutoff", m.alphaCutoff);
}

template <class Visitor, class T>
void visitTexture(Visitor& visitor, T& t) {
  visitor.field("role", t.role);
  visitor.field("picture", t.picture);
  visitor.field("textureCoords", t.textureCoords);
}

template <class Visitor, class E>
void visitErrors(Visitor& visitor, E& e) {
  visitor.field("name", e.name);
  visitor.field("attribute", e.inFile);
  visitor.flag("ofWedges", e.ofWedges);
  visitor.field("length", e.length);
}

// This makes an object of one element of a list, with the fields that a visitor writes.
nlohmann::ordered_json written(const auto& visit) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  json_fields::Writer writer(object);
  visit(writer);
  return object;
}

/// The arrays of attributes by their names in the file.
auto attributeLists(auto& a) {
  return std::array{std::pair{"vertexAttributes", &a.vertexAttributes},
                    std::pair{"wedgeAttributes", &a.wedgeAttributes},
                    std::pair{"faceAttributes", &a.triangleAttributes}};
}
auto faceLists(auto& a) {
  return std::array{std::pair{"hasObjects", &a.objectOf}, std::pair{"hasGroups", &a.groupOf},
                    std::pair{"hasMaterials", &a.materialOf}, std::pair{"hasFaces", &a.faceOf}};
}

/// Reads a row of objects, one by one.
template <class Read>
void readRow(const Json& object, const char* key, std::string& problem, const Read& read) {
  const auto found = object.find(key);
  if (found == object.end()) return;
  if (!found->is_array()) {
    if (problem.empty()) problem = fmt::format("{} is not an array", key);
    return;
  }
  for (const Json& element : *found) {
    if (!element.is_object()) {
      if (problem.empty()) problem = fmt::format("{} holds what is not an object", key);
      return;
    }
    json_fields::Reader reader(element, problem);
    read(reader, element);
  }
}

}  // namespace

std::string toLooksJson(const SurfaceModel& model) {
  const MeshAttributes& a = model.attributes;
  JsonTree tree(nlohmann::ordered_json::object());
  nlohmann::ordered_json& looks = *tree;
  json_fields::Writer top(looks);
  for (const auto& [key, attributes] : attributeLists(a))
    for (const Attribute& attribute : *attributes)
      // The number of components is a byte in memory, and a number like any other in the file.
      looks[key].push_back(written([&](auto& w) {
        visitAttribute(w, attribute);
        w.field("components", std::uint32_t{attribute.components});
      }));
  for (const AttributeErrors& errors : model.attributeErrors)
    looks["attributeErrors"].push_back(written([&](auto& w) {
      visitErrors(w, errors);
      w.field("scale", errors.scale.base());
    }));
  if (!model.attributeDistances.empty()) looks["attributeDistances"] = model.attributeDistances;
  top.optional("objects", a.objects);
  top.optional("groups", a.groups);
  for (const auto& [key, list] : faceLists(a)) top.flag(key, !list->empty());
  for (const Material& material : a.materials)
    looks["materials"].push_back(written([&](auto& w) {
      visitMaterial(w, material);
      std::vector<std::string> verbatim;
      for (const auto& [format, text] : material.verbatim) {
        verbatim.push_back(format);
        verbatim.push_back(text);
      }
      w.optional("verbatim", verbatim);
    }));
  // Textures come after the materials, as lists within them.
  for (std::size_t m = 0; m < a.materials.size(); ++m)
    for (const TextureUse& texture : a.materials[m].textures)
      looks["materials"][m]["textures"].push_back(written([&](auto& w) { visitTexture(w, texture); }));
  for (const EmbeddedPicture& picture : a.pictures)
    looks["pictures"].push_back(written([&](auto& w) {
      w.field("name", picture.name);
      w.field("mimeType", picture.mimeType);
      w.field("bytes", std::uint64_t{picture.bytes.size()});
    }));
  return looks.dump(1) + "\n";
}

Status fromLooksJson(std::string_view text, std::uint64_t faces, std::uint64_t attributeBytes,
                     SurfaceModel& model, std::vector<std::uint64_t>& pictureBytes) {
  const JsonTree tree(Json::parse(text, nullptr, false));
  const Json& looks = *tree;
  if (!looks.is_object()) return failure(ErrorCode::corrupt, "chunk LOOK is not a JSON object");
  std::string problem;
  MeshAttributes& a = model.attributes;
  json_fields::Reader top(looks, problem);
  // An attribute gets its type here and its values later, from another chunk.
  for (const auto& list : attributeLists(a))
    readRow(looks, list.first, problem, [&](json_fields::Reader& r, const Json&) {
      Attribute& attribute = list.second->emplace_back();
      visitAttribute(r, attribute);
      std::uint32_t components = 0;
      r.field("components", components);
      if ((components == 0 || components > 255) && problem.empty())
        problem = fmt::format("attribute {} has {} components", attribute.name, components);
      attribute.components = static_cast<std::uint8_t>(components);
    });
  readRow(looks, "attributeErrors", problem, [&](json_fields::Reader& r, const Json&) {
    AttributeErrors& errors = model.attributeErrors.emplace_back();
    visitErrors(r, errors);
    std::uint32_t base = 0;
    r.field("scale", base);
    errors.scale = OutwardScale::fromBase(base);
    if (!(errors.length >= 0 && std::isfinite(errors.length)) && problem.empty())
      problem = fmt::format("the errors of {} have a length of {}", errors.name, errors.length);
    if (!std::isfinite(errors.scale.decode(OutwardScale::kMaxCode)) && problem.empty())
      problem = fmt::format("the errors of {} have the scale {}", errors.name, base);
  });
  // Earlier versions have none.
  if (const auto distances = looks.find("attributeDistances"); distances != looks.end()) {
    bool isGood = distances->is_array() && distances->size() <= kMostDistances;
    double last = 0;
    for (const Json& distance : isGood ? *distances : Json::array()) {
      isGood = isGood && distance.is_number() && distance.get<double>() > last;
      if (!isGood) break;
      model.attributeDistances.push_back(last = distance.get<double>());
    }
    if (!isGood)
      return failure(ErrorCode::corrupt,
                     "chunk LOOK: attributeDistances is not an array of a few rising numbers");
  }
  top.optional("objects", a.objects);
  top.optional("groups", a.groups);
  for (const auto& [key, list] : faceLists(a)) {
    bool has = false;
    top.flag(key, has);
    if (!has) continue;
    // The number of faces is only stated; that of the values is how many there are.
    if (faces > attributeBytes / sizeof(std::uint32_t))
      return failure(ErrorCode::corrupt, fmt::format("chunk ATTR has {} bytes, too few for {} of {} faces",
                                                     attributeBytes, key, faces));
    list->resize(faces);
  }
  readRow(looks, "materials", problem, [&](json_fields::Reader& r, const Json& object) {
    Material& material = a.materials.emplace_back();
    visitMaterial(r, material);
    std::vector<std::string> verbatim;
    r.optional("verbatim", verbatim);
    for (std::size_t i = 0; i + 1 < verbatim.size(); i += 2) material.verbatim[verbatim[i]] = verbatim[i + 1];
    readRow(object, "textures", problem,
            [&](json_fields::Reader& t, const Json&) { visitTexture(t, material.textures.emplace_back()); });
  });
  // The sizes of the pictures are returned, since their bytes lie in another chunk one after the other.
  readRow(looks, "pictures", problem, [&](json_fields::Reader& r, const Json&) {
    EmbeddedPicture& picture = a.pictures.emplace_back();
    r.field("name", picture.name);
    r.field("mimeType", picture.mimeType);
    r.field("bytes", pictureBytes.emplace_back());
  });
  if (!problem.empty()) return failure(ErrorCode::corrupt, fmt::format("chunk LOOK: {}", problem));
  return {};
}

std::vector<std::uint16_t> attributeErrorCodesOf(const SurfaceModel& model) {
  std::vector<std::uint16_t> codes;
  for (const AttributeErrors& errors : model.attributeErrors)
    codes.insert(codes.end(), errors.codes.begin(), errors.codes.end());
  return codes;
}

Status takeAttributeErrorCodes(std::span<const std::uint16_t> codes, SurfaceModel& model) {
  const std::size_t triangles = (1 + model.attributeDistances.size()) * model.mt.triangleIdCount();
  if (codes.size() != model.attributeErrors.size() * triangles)
    return failure(ErrorCode::corrupt, fmt::format("chunk AERR has {} codes instead of {}", codes.size(),
                                                   model.attributeErrors.size() * triangles));
  for (std::size_t a = 0; a < model.attributeErrors.size(); ++a) {
    const auto own = codes.subspan(a * triangles, triangles);
    model.attributeErrors[a].codes.assign(own.begin(), own.end());
  }
  return {};
}

// The order is the order of the lists in the JSON, and within them of the attributes: nothing else says where
// a column begins.
std::vector<std::byte> attributeBytesOf(const SurfaceModel& model) {
  std::vector<std::byte> bytes;
  const auto add = [&](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  for (const auto& [key, attributes] : attributeLists(model.attributes))
    for (const Attribute& attribute : *attributes) add(attribute.values);
  for (const auto& [key, list] : faceLists(model.attributes)) add(std::as_bytes(std::span(*list)));
  return bytes;
}

/// The sum of all columns is compared with the chunk before anything is copied, so that no column reaches
/// beyond its end.
Status takeAttributeBytes(std::span<const std::byte> bytes, std::uint64_t vertices, SurfaceModel& model) {
  MeshAttributes& a = model.attributes;
  const std::array<std::uint64_t, 3> counts{vertices, a.wedgeCount, model.sourceFaces};
  std::uint64_t wanted = 0;
  std::size_t kind = 0;
  for (const auto& [key, attributes] : attributeLists(a)) {
    for (const Attribute& attribute : *attributes) wanted += counts[kind] * attribute.elementBytes();
    ++kind;
  }
  for (const auto& [key, list] : faceLists(a)) wanted += std::uint64_t{list->size()} * sizeof(std::uint32_t);
  if (wanted != bytes.size())
    return failure(ErrorCode::corrupt,
                   fmt::format("chunk ATTR has {} bytes instead of {}", bytes.size(), wanted));
  std::size_t at = 0;
  kind = 0;
  for (const auto& [key, attributes] : attributeLists(a)) {
    for (Attribute& attribute : *attributes) {
      const std::span<const std::byte> values = bytes.subspan(at, counts[kind] * attribute.elementBytes());
      attribute.values.assign(values.begin(), values.end());
      at += values.size();
    }
    ++kind;
  }
  for (const auto& [key, list] : faceLists(a)) {
    const std::size_t size = list->size() * sizeof(std::uint32_t);
    if (size > 0) std::memcpy(list->data(), bytes.data() + at, size);
    at += size;
  }
  return {};
}

}  // namespace arete
