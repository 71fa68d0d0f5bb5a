// SPDX-License-Identifier: GPL-3.0-or-later
//
// The values are kept corner by corner. At the end a hash table finds, for each corner, the first wedge of
// its vertex that has the same bytes; the values of wedges move to the front of the list of corners, where no
// corner is lost since there are never more wedges than corners before.
#include "io/formats/ply/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/text_scan.h"
#include "io/formats/ply/scheme.h"

namespace arete {

namespace {

constexpr std::size_t kMostComponents = 255;

}  // namespace

PlyCorners::PlyCorners(std::vector<Attribute> attributes, std::size_t mostFill) : mostFill_(mostFill) {
  for (Attribute& attribute : attributes) lists_.emplace_back().attribute = std::move(attribute);
}

void PlyCorners::clearValues() {
  for (List& list : lists_) list.values.clear();
}

Result<std::span<const std::uint32_t>> PlyCorners::addFace(std::span<const std::uint32_t> vertices,
                                                           std::uint64_t face) {
  if (vertexOf_.size() + vertices.size() >= MeshAttributes::kNone)
    return failure(ErrorCode::unsupported, "has more corners of faces than can be numbered", {});
  for (List& list : lists_) take(list, vertices.size(), face);
  numbers_.clear();
  for (const std::uint32_t vertex : vertices) {
    numbers_.push_back(static_cast<std::uint32_t>(vertexOf_.size()));
    vertexOf_.push_back(vertex);
  }
  return std::span<const std::uint32_t>(numbers_);
}

void PlyCorners::take(List& list, std::size_t corners, std::uint64_t face) {
  if (list.isDropped) return;
  Attribute& attribute = list.attribute;
  const std::size_t length = list.values.size() / sizeOf(attribute.type);
  std::size_t missing = 0;  // bytes of corners without values
  // The first list that divides evenly among the corners decides how many components there are.
  if (attribute.components == 0 && length > 0 && length % corners == 0 &&
      length / corners <= kMostComponents) {
    attribute.components = static_cast<std::uint8_t>(length / corners);
    missing = vertexOf_.size() * attribute.elementBytes();
  }
  const bool fits = attribute.components > 0 && length == corners * attribute.components;
  if (!fits) {
    if (list.misfits++ == 0) list.firstMisfit = face;
    list.hadValues = list.hadValues || length > 0;
    list.values.clear();
    if (attribute.components == 0) return;
    missing = corners * attribute.elementBytes();
  }
  // Faces without values are filled with zeros, within a limit, so that a small file cannot take all memory.
  fill_ += missing;
  if (fill_ > mostFill_) {
    list.isDropped = true;
    attribute.values = {};
    return;
  }
  attribute.values.resize(attribute.values.size() + missing);
  attribute.values.insert(attribute.values.end(), list.values.begin(), list.values.end());
}

void PlyCorners::join(SurfaceMesh& mesh, Warnings& warnings) {
  for (const List& list : lists_) {
    const std::string name = text::quotedToken(list.attribute.name);
    if (list.isDropped || (list.attribute.components == 0 && list.hadValues))
      warnings.push_back(
          {WarningCode::omitted,
           fmt::format("of its faces the lists {} have other lengths than their corners; they are "
                       "left out",
                       name)});
    else if (list.misfits > 0 && list.attribute.components > 0)
      warnings.push_back(
          {WarningCode::completed,
           fmt::format("{} no list {} that fits the corners, which are 0 there (the first is face {})",
                       counted(list.misfits, "face has", "faces have"), name, list.firstMisfit)});
  }
  std::erase_if(lists_, [](const List& l) { return l.isDropped || l.attribute.components == 0; });
  if (lists_.empty()) {
    mesh.wedges.clear();
    return;
  }

  const auto bytesOf = [](const List& list, std::size_t corner) {
    const std::size_t size = list.attribute.elementBytes();
    return std::string_view(reinterpret_cast<const char*>(list.attribute.values.data()) + corner * size,
                            size);
  };
  // The table is at most half full.
  std::vector<std::uint32_t> table(std::bit_ceil(vertexOf_.size() * 2 + 1), MeshAttributes::kNone);
  std::vector<std::uint32_t> wedgeOf(vertexOf_.size());
  std::uint32_t wedges = 0;
  for (std::size_t corner = 0; corner < vertexOf_.size(); ++corner) {
    std::uint64_t hash = vertexOf_[corner];
    for (const List& list : lists_)
      hash = (hash ^ std::hash<std::string_view>()(bytesOf(list, corner))) * 0x9E3779B97F4A7C15u;
    std::size_t slot = (hash >> 32) & (table.size() - 1);
    const auto isWedge = [&](std::uint32_t wedge) {
      return vertexOf_[wedge] == vertexOf_[corner] && std::ranges::all_of(lists_, [&](const List& list) {
               return bytesOf(list, wedge) == bytesOf(list, corner);
             });
    };
    while (table[slot] != MeshAttributes::kNone && !isWedge(table[slot]))
      slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == MeshAttributes::kNone) {
      table[slot] = wedges;
      vertexOf_[wedges] = vertexOf_[corner];
      for (List& list : lists_) {
        const std::size_t size = list.attribute.elementBytes();
        std::memmove(list.attribute.values.data() + wedges * size,
                     list.attribute.values.data() + corner * size, size);
      }
      ++wedges;
    }
    wedgeOf[corner] = table[slot];
  }
  // So far the triangles name corners; from here on they name wedges.
  for (auto& triangle : mesh.wedges)
    for (std::uint32_t& corner : triangle) corner = wedgeOf[corner];
  mesh.wedgeCount = wedges;
  for (List& list : lists_) {
    list.attribute.values.resize(wedges * list.attribute.elementBytes());
    list.attribute.values.shrink_to_fit();
    giveMeaning(list.attribute);
    mesh.wedgeAttributes.push_back(std::move(list.attribute));
  }
}

}  // namespace arete
