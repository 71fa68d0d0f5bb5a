// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace arete {

/// A 32-bit index whose type says what it indexes, so that a vertex cannot be used as a triangle.
/// Invalid by default.
template <class Tag>
class Id {
 public:
  static constexpr std::uint32_t kInvalid = 0xFFFFFFFFu;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t value) : value_(value) {}

  constexpr std::uint32_t index() const { return value_; }
  constexpr bool isValid() const { return value_ != kInvalid; }
  constexpr auto operator<=>(const Id&) const = default;

 private:
  std::uint32_t value_ = kInvalid;
};

using VertexId = Id<struct VertexTag>;
using TriangleId = Id<struct TriangleTag>;
using NodeId = Id<struct NodeTag>;

}  // namespace arete

template <class Tag>
struct std::hash<arete::Id<Tag>> {
  std::size_t operator()(arete::Id<Tag> id) const noexcept { return std::hash<std::uint32_t>{}(id.index()); }
};
