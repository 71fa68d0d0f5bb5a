// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace arete::test {

/// All ids of a kind below a number, in order: idsBelow<VertexId>(mesh.vertexCount()).
template <class IdType>
std::vector<IdType> idsBelow(std::size_t count) {
  std::vector<IdType> ids;
  for (std::uint32_t index = 0; index < count; ++index) ids.push_back(IdType(index));
  return ids;
}

/// The ids of some numbers: idsOf<VertexId>({20, 41}).
template <class IdType>
std::vector<IdType> idsOf(std::initializer_list<std::uint32_t> numbers) {
  std::vector<IdType> ids;
  for (const std::uint32_t number : numbers) ids.push_back(IdType(number));
  return ids;
}

/// The id that is so many after another.
template <class IdType>
IdType after(IdType first, std::size_t steps) {
  return IdType(first.index() + static_cast<std::uint32_t>(steps));
}

}  // namespace arete::test
