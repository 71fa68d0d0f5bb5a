// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace arete {

/// Arrays beside the core of a multitriangulation, of one kind of model or of both: one element for each
/// triangle id, vertex or node. The span of a column that a multitriangulation does not have is
/// empty. What a column is per, and how files hold it, is in the schema (io/store/format/schema.h).

/// Names a column: its place among all, and the type of its elements.
template <class T>
struct ColumnKey {
  using Element = T;
  unsigned index;
};

/// By triangle id, of a heightfield: z_TIN - z_reference lies in [-below, above] over the whole triangle.
/// Codes of MtArrays::scale.
inline constexpr ColumnKey<std::uint16_t> kBelow{0}, kAbove{1};
/// By triangle id, of a surface: the root mean square of the distances whose largest one is the error. Codes
/// of MtArrays::scale.
inline constexpr ColumnKey<std::uint16_t> kRms{2};
inline constexpr unsigned kColumnKeys = 3;

/// The columns of a multitriangulation. Cheap to copy: it refers to memory of others.
class Columns {
 public:
  /// Empty if the model has no such column. O(1).
  template <class T>
  std::span<const T> of(ColumnKey<T> key) const {
    const Entry& entry = entries_[key.index];
    return {static_cast<const T*>(entry.data), entry.size};
  }
  template <class T>
  void set(ColumnKey<T> key, std::span<const T> elements) {
    entries_[key.index] = {elements.data(), elements.size()};
  }
  template <class T, class Elements>
  void set(ColumnKey<T> key, const Elements& elements) {
    set(key, std::span<const T>(elements));
  }
  template <class T>
  void drop(ColumnKey<T> key) {
    entries_[key.index] = {};
  }

 private:
  struct Entry {
    const void* data = nullptr;
    std::size_t size = 0;
  };
  std::array<Entry, kColumnKeys> entries_;
};

}  // namespace arete
