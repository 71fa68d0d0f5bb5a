// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace arete {

/// An array whose elements belong to the ids of one kind, in their order: it is indexed by such an id and by
/// nothing else.
/// @tparam IdType an Id (engine/base/ids.h).
/// @tparam Array  what holds the elements, as std::vector or PagedArray.
template <class IdType, class Array>
class IdArray : public Array {
 public:
  using Array::Array;
  IdArray() = default;
  /// Takes the elements, in the order of their ids.
  explicit IdArray(Array elements) : Array(static_cast<Array&&>(elements)) {}

  decltype(auto) operator[](IdType id) { return Array::operator[](std::size_t{id.index()}); }
  decltype(auto) operator[](IdType id) const { return Array::operator[](std::size_t{id.index()}); }
};

}  // namespace arete
