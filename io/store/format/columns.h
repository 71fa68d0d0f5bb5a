// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"
#include "io/store/format/layout.h"
#include "io/store/format/shapes.h"

namespace arete {

/// What a column is: an array that an .amt file holds, and all that reading, writing, copying and checking
/// need to know of it. Which columns a kind of model has is in its schema (schema.h).

/// The counts that determine the sizes of all chunks of a file.
struct AmtCounts {
  std::uint64_t rootVertices = 0, rootTriangles = 0, nodes = 0, slots = 0;
  std::uint64_t isolated = 0, fixedVertices = 0;
};

/// What decides which columns a file has and how long they are: what its metadata says, and, of the last
/// three, its directory.
struct AmtFacts {
  ModelKind kind = ModelKind::terrain;
  AmtCounts counts;

  // Of a heightfield.
  bool isLattice = false;
  HeightEncoding::Type heights = HeightEncoding::Type::float64;

  // Of a surface.
  bool hasDoubles = false, hasAllFaces = false, hasWedges = false;
  std::uint64_t finestTriangles = 0;

  bool isPacked = false, hasDisplacement = false;
  bool isPaged = false;                   ///< packed in pages
  std::optional<std::uint64_t> segments;  ///< of a file that has checksums of them
};

/// What a column has an element for.
enum class AmtPer : std::uint8_t {
  rootTriangle,
  node,
  nodeOrEnd,  ///< a node, and one more
  slot,
  triangle,  ///< a triangle id: of the root, or a slot
  floorTriangle,
  block,  ///< a cluster or a cluster group of nodes
  hint,   ///< 64 slots
  vertex,
  finestTriangle,  ///< a triangle that no node removes
  isolated,
  fixedVertex,
  segment,
  any  ///< as many as there are
};

/// How a packed file holds a column.
enum class AmtCoding : std::uint8_t {
  raw,           ///< as a plain file does
  walked,        ///< PNOD: follows from the walk over the nodes
  outward,       ///< PNOD: codes of magnitudes
  delta,         ///< PNOD: as differences from what is predicted
  derived,       ///< not at all: it is computed when the nodes are unpacked
  numbers,       ///< PNUM
  displacement,  ///< PDSP
  dropped,       ///< not at all: a packed file does without
  packed         ///< a plain file does not have it: it is what the others are packed in
};

/// As a file's description says it.
std::string_view toString(AmtPer per);
std::string_view toString(AmtCoding coding);

/// Whether a file must have a column that its facts call for.
enum class AmtNeed : std::uint8_t { always, whereFound };

/// One row of a schema.
struct AmtColumn {
  AmtTag tag{};
  AmtScalar scalar = AmtScalar::u8;
  std::uint8_t components = 1;
  AmtPer per = AmtPer::any;
  AmtCoding coding = AmtCoding::raw;
  AmtNeed need = AmtNeed::always;
  std::uint32_t since = kAmtVersion;  ///< the first version of the format that has it
  std::uint32_t flags = 0;            ///< kAmtRequired
  /// Whether a file of such facts has it. Null: every file.
  bool (*when)(const AmtFacts&) = nullptr;

  constexpr std::string_view name() const { return {tag.data(), tag.size()}; }
  constexpr std::uint32_t elementBytes() const { return bytesOf(scalar) * components; }
  constexpr bool isFloating() const { return scalar == AmtScalar::f32 || scalar == AmtScalar::f64; }
  constexpr bool isIn(const AmtFacts& facts) const {
    const bool isOfForm = facts.isPacked ? coding == AmtCoding::raw || coding == AmtCoding::packed
                                         : coding != AmtCoding::packed;
    return isOfForm && (when == nullptr || when(facts));
  }

  static constexpr std::uint32_t bytesOf(AmtScalar scalar) {
    switch (scalar) {
      case AmtScalar::u8:
        return 1;
      case AmtScalar::u16:
      case AmtScalar::i16:
        return 2;
      case AmtScalar::u32:
      case AmtScalar::f32:
        return 4;
      default:
        return 8;
    }
  }
};

/// The number of elements. Precondition: not AmtPer::any.
std::uint64_t amtCountOf(AmtPer per, const AmtFacts& facts);

/// The shape of a column's chunk. @param bytes of the chunk, where it may have any number
inline AmtShape amtShapeOf(const AmtColumn& column, const AmtFacts& facts, std::uint64_t bytes) {
  const std::uint32_t size = column.elementBytes();
  return {column.tag, column.scalar, size,
          column.per == AmtPer::any ? bytes / size : amtCountOf(column.per, facts)};
}

/// Where an owner has an array.
template <class Owner>
struct AmtPlaceIn {
  std::span<const std::byte> (*bytes)(const Owner&) = nullptr;
  /// Points a span to the bytes, or copies them to a vector.
  void (*put)(Owner&, std::span<const std::byte>) = nullptr;

  constexpr explicit operator bool() const { return bytes != nullptr; }
};

/// A column, and where a multitriangulation or a model in memory has it; neither: a file is written with
/// bytes that are made for it.
template <class Model>
struct AmtRow : AmtColumn {
  AmtPlaceIn<MtArrays> mt = {};
  AmtPlaceIn<Model> model = {};
};

namespace amt_rows {

/// The scalar and the number of components of a C++ type.
template <class T>
struct ElementOf;
template <AmtScalar kScalar, std::uint8_t kComponents>
struct Element {
  static constexpr AmtScalar scalar = kScalar;
  static constexpr std::uint8_t components = kComponents;
};
template <>
struct ElementOf<std::byte> : Element<AmtScalar::u8, 1> {};
template <>
struct ElementOf<std::uint8_t> : Element<AmtScalar::u8, 1> {};
template <>
struct ElementOf<std::int8_t> : Element<AmtScalar::u8, 1> {};  // a file has no scalar of its own for it
template <>
struct ElementOf<std::uint16_t> : Element<AmtScalar::u16, 1> {};
template <>
struct ElementOf<std::uint32_t> : Element<AmtScalar::u32, 1> {};
template <>
struct ElementOf<float> : Element<AmtScalar::f32, 1> {};
template <>
struct ElementOf<double> : Element<AmtScalar::f64, 1> {};
template <>
struct ElementOf<Vec2> : Element<AmtScalar::f64, 2> {};
template <>
struct ElementOf<Vec3> : Element<AmtScalar::f64, 3> {};
template <>
struct ElementOf<Sphere> : Element<AmtScalar::f32, 4> {};
template <>
struct ElementOf<std::uint64_t> : Element<AmtScalar::u32, 2> {};  // as above
template <class T, std::size_t N>
struct ElementOf<std::array<T, N>> : Element<ElementOf<T>::scalar, N> {};

/// The array that is reached from an owner by a path of members: a span, or a vector.
template <class Owner, auto... kMembers>
struct Path {
  using Array = std::remove_cvref_t<decltype((std::declval<Owner&>().*....*kMembers))>;
  using Value = std::remove_const_t<typename Array::value_type>;

  static std::span<const std::byte> bytes(const Owner& owner) {
    return std::as_bytes(std::span((owner.*....*kMembers)));
  }
  static void put(Owner& owner, std::span<const std::byte> bytes) {
    const std::span elements(reinterpret_cast<const Value*>(bytes.data()), bytes.size() / sizeof(Value));
    Array& to = (owner.*....*kMembers);
    if constexpr (std::is_same_v<Array, std::span<const Value>>)
      to = elements;
    else
      to.assign(elements.begin(), elements.end());
  }
};

/// What is stated of a column beside its tag, what it is per, its coding and where it is.
struct More {
  AmtNeed need = AmtNeed::always;
  std::uint32_t since = kAmtVersion;
  std::uint32_t flags = 0;
  bool (*when)(const AmtFacts&) = nullptr;
};

template <class T>
constexpr AmtColumn columnOf(AmtTag tag, AmtPer per, AmtCoding coding, const More& more) {
  return {tag,
          ElementOf<T>::scalar,
          ElementOf<T>::components,
          per,
          coding,
          more.need,
          more.since,
          more.flags,
          more.when};
}

/// An array of the multitriangulation.
template <class Model, auto... kMembers>
constexpr AmtRow<Model> ofMt(AmtTag tag, AmtPer per, AmtCoding coding, const More& more = {}) {
  using At = Path<MtArrays, kMembers...>;
  return {columnOf<typename At::Value>(tag, per, coding, more), {&At::bytes, &At::put}, {}};
}
/// A column of the multitriangulation.
template <class Model, auto kKey>
constexpr AmtRow<Model> ofColumn(AmtTag tag, AmtPer per, AmtCoding coding, const More& more = {}) {
  using T = typename decltype(kKey)::Element;
  return {columnOf<T>(tag, per, coding, more),
          {[](const MtArrays& a) { return std::as_bytes(a.columns.of(kKey)); },
           [](MtArrays& a, std::span<const std::byte> bytes) {
             a.columns.set(kKey,
                           std::span(reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)));
           }},
          {}};
}
/// An array of the model beside it.
template <class Model, auto... kMembers>
constexpr AmtRow<Model> ofModel(AmtTag tag, AmtPer per, AmtCoding coding, const More& more = {}) {
  using At = Path<Model, kMembers...>;
  return {columnOf<typename At::Value>(tag, per, coding, more), {}, {&At::bytes, &At::put}};
}
/// An array that is made for the file.
template <class Model, class T>
constexpr AmtRow<Model> made(AmtTag tag, AmtPer per, AmtCoding coding, const More& more = {}) {
  return {columnOf<T>(tag, per, coding, more), {}, {}};
}

}  // namespace amt_rows

}  // namespace arete
