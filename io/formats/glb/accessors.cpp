// SPDX-License-Identifier: GPL-3.0-or-later
//
// Columns of matrices begin at multiples of four bytes. A sparse accessor is put together once: its view or
// zeros, and over them the values at the indices that it lists. Its byteOffset is that of the view only; the
// indices and the values have their own.
#include "io/formats/glb/accessors.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace arete {

namespace {

/// Where no bytes are stated, every element is this one: the largest is a matrix of 16 doubles.
constexpr char kZeros[128] = {};

tl::unexpected<Error> wrong(std::uint64_t number, std::string_view what,
                            ErrorCode code = ErrorCode::corrupt) {
  return failure(code, fmt::format("accessor {} {}", number, what));
}

/// Sets components, rows and column stride. False for an unknown type.
bool setShape(GltfElements& elements, std::string_view type) {
  const std::size_t size = sizeOf(elements.type);
  if (type.starts_with("MAT")) {
    if (type != "MAT2" && type != "MAT3" && type != "MAT4") return false;
    elements.rows = static_cast<std::uint8_t>(type[3] - '0');
    elements.components = static_cast<std::uint8_t>(elements.rows * elements.rows);
    elements.columnStride = static_cast<std::uint8_t>((elements.rows * size + 3) / 4 * 4);
    return true;
  }
  if (type == "SCALAR")
    elements.components = 1;
  else if (type == "VEC2" || type == "VEC3" || type == "VEC4")
    elements.components = static_cast<std::uint8_t>(type[3] - '0');
  else
    return false;
  elements.rows = elements.components;
  elements.columnStride = static_cast<std::uint8_t>(elements.components * size);
  return true;
}

std::uint64_t elementBytes(const GltfElements& elements) {
  return std::uint64_t{elements.columnStride} * (elements.components / elements.rows);
}

/// Sets where the elements are. `stride` is that of the view, 0: they follow each other.
Status place(GltfElements& elements, const GltfViews::View& view, std::uint64_t offset, std::uint64_t number,
             std::uint64_t viewNumber) {
  const std::uint64_t size = elementBytes(elements);
  elements.stride = view.stride == 0 ? size : view.stride;
  if (elements.stride < size)
    return failure(ErrorCode::corrupt,
                   fmt::format("bufferView {} has a stride of {} bytes", viewNumber, elements.stride));
  if (offset + (elements.count - 1) * elements.stride + size > view.bytes.size())
    return wrong(number, fmt::format("of {} elements is longer than its bufferView", elements.count));
  elements.first = view.bytes.data() + offset;
  elements.owned = view.owned;
  return {};
}

/// The elements of the part "indices" or "values" of a sparse accessor.
Result<GltfElements> sparsePart(const GltfDocument& document, GltfViews& views, const nlohmann::json& sparse,
                                const char* part, GltfElements elements, std::uint64_t number) {
  const auto found = sparse.find(part);
  if (found == sparse.end() || !found->is_object())
    return wrong(number, fmt::format("is sparse without \"{}\"", part));
  const auto viewNumber = GltfDocument::wholeNumber(*found, "bufferView"),
             offset = GltfDocument::wholeNumber(*found, "byteOffset", 0);
  for (const auto* value : {&viewNumber, &offset})
    if (!*value) return wrong(number, value->error().message);
  if (std::string_view(part) == "indices") {
    const auto type = GltfDocument::wholeNumber(*found, "componentType");
    if (!type) return wrong(number, type.error().message);
    const auto scalar = scalarTypeOf(*type);
    if (!scalar ||
        (*scalar != ScalarType::uint8 && *scalar != ScalarType::uint16 && *scalar != ScalarType::uint32))
      return wrong(number, "has sparse indices that are not unsigned whole numbers");
    elements.type = *scalar;
    setShape(elements, "SCALAR");
  }
  ARETE_TRY(const auto view, views.view(document, *viewNumber));
  ARETE_CHECK(place(elements, view, *offset, number, *viewNumber));
  return elements;
}

/// Puts a sparse accessor together. `elements` has its view, or zeros.
Status applySparse(const GltfDocument& document, GltfViews& views, const nlohmann::json& sparse,
                   std::uint64_t number, GltfElements& elements) {
  const std::uint64_t size = elementBytes(elements);
  auto known = views.sparse.find(number);
  if (known == views.sparse.end()) {
    if (!sparse.is_object()) return wrong(number, "is sparse without \"indices\"");
    const auto count = GltfDocument::wholeNumber(sparse, "count");
    if (!count) return wrong(number, count.error().message);
    if (*count == 0 || *count > elements.count)
      return wrong(number, fmt::format("has {} sparse values of {} elements", *count, elements.count));
    GltfElements shape = elements;
    shape.count = *count;
    ARETE_TRY(const auto indices, sparsePart(document, views, sparse, "indices", shape, number));
    ARETE_TRY(const auto values, sparsePart(document, views, sparse, "values", shape, number));
    ARETE_CHECK(views.reserve(size * elements.count));
    std::string whole(size * elements.count, '\0');
    if (elements.stride > 0)
      for (std::uint64_t i = 0; i < elements.count; ++i)
        std::memcpy(whole.data() + i * size, elements.first + i * elements.stride, size);
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < *count; ++i) {
      const std::uint64_t at = indices.index(i);
      if (at < next || at >= elements.count)
        return wrong(number, fmt::format("has the sparse index {} out of order or range", at));
      std::memcpy(whole.data() + at * size, values.first + i * values.stride, size);
      next = at + 1;
    }
    known = views.sparse.emplace(number, std::make_shared<const std::string>(std::move(whole))).first;
  }
  elements.owned = known->second;
  elements.first = known->second->data();
  elements.stride = size;
  return {};
}

}  // namespace

/// The standard itself has no 5124 and 5130; extensions use them for whole numbers of 32 bits and doubles.
std::optional<ScalarType> scalarTypeOf(std::uint64_t componentType) {
  switch (componentType) {
    case 5120:
      return ScalarType::int8;
    case 5121:
      return ScalarType::uint8;
    case 5122:
      return ScalarType::int16;
    case 5123:
      return ScalarType::uint16;
    case 5124:
      return ScalarType::int32;
    case 5125:
      return ScalarType::uint32;
    case 5126:
      return ScalarType::float32;
    case 5130:
      return ScalarType::float64;
    default:
      return std::nullopt;
  }
}

Result<GltfElements> readAccessor(const GltfDocument& document, GltfViews& views, std::uint64_t number,
                                  std::string_view type) {
  ARETE_TRY(const auto found, document.element("accessors", number));
  const nlohmann::json& accessor = *found;
  const auto typeName = accessor.find("type");
  if (typeName == accessor.end() || !typeName->is_string() || (!type.empty() && *typeName != type))
    return wrong(number, fmt::format("is not of the type {} that is needed", type.empty() ? "VEC3" : type));
  const auto count = GltfDocument::wholeNumber(accessor, "count"),
             component = GltfDocument::wholeNumber(accessor, "componentType"),
             offset = GltfDocument::wholeNumber(accessor, "byteOffset", 0);
  // Each member is checked before it is used, and the message names the accessor, since a file has many.
  for (const auto* value : {&count, &component, &offset})
    if (!*value) return wrong(number, value->error().message);
  GltfElements elements;
  const auto scalar = scalarTypeOf(*component);
  if (!scalar) return wrong(number, fmt::format("has the unknown component type {}", *component));
  elements.type = *scalar;
  if (!setShape(elements, typeName->get_ref<const std::string&>()))
    return wrong(number, "is of no known type");
  if (*count == 0) return wrong(number, "has no elements");
  elements.count = *count;
  const auto normalized = accessor.find("normalized");
  elements.isNormalized = normalized != accessor.end() && *normalized == true && !isFloat(*scalar);

  // Without a view all elements are zeros, read from one place again and again; a sparse list may change
  // some.
  if (accessor.contains("bufferView")) {
    const auto viewNumber = GltfDocument::wholeNumber(accessor, "bufferView");
    if (!viewNumber) return wrong(number, viewNumber.error().message);
    ARETE_TRY(const auto view, views.view(document, *viewNumber));
    ARETE_CHECK(place(elements, view, *offset, number, *viewNumber));
  } else {
    elements.first = kZeros;
    elements.stride = 0;
  }
  if (const auto sparse = accessor.find("sparse"); sparse != accessor.end())
    ARETE_CHECK(applySparse(document, views, *sparse, number, elements));
  return elements;
}

}  // namespace arete
