// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace arete {

/// Triangles in an order for which a small cache of vertices suffices, and which compresses well. Each keeps
/// its corners, perhaps turned, and its orientation. O(n).
std::vector<std::uint32_t> orderForCache(const std::vector<std::uint32_t>& indices, std::size_t vertices);

/// By vertex: its number in the order of first use; vertices without a use come last. O(n).
std::vector<std::uint32_t> orderOfFirstUse(const std::vector<std::uint32_t>& indices, std::size_t vertices);

/// The bytes of elements as EXT_meshopt_compression has them, mode ATTRIBUTES.
/// @param stride A multiple of four, at most 256.
std::string encodeMeshoptVertices(const std::string& bytes, std::size_t count, std::size_t stride);

/// Likewise, mode TRIANGLES.
std::string encodeMeshoptTriangles(const std::vector<std::uint32_t>& indices, std::size_t vertices);

/// Unit vectors for the filter OCTAHEDRAL with 8 bits a component: four bytes each. The fourth number, the
/// sign of a tangent, is kept.
std::string encodeOctahedral(std::span<const std::array<float, 4>> vectors);

}  // namespace arete
