// SPDX-License-Identifier: GPL-3.0-or-later
//
// A hash table of corners with linear probing numbers the wedges while faces are read. When all lists are
// known, texture coordinates that are equal get the same index, and normals too, and the wedges are numbered
// anew: exporters list a value again for each corner, and such corners are no seam.
#include "io/formats/obj/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/formats/common/text_numbers.h"

namespace arete {
namespace {

constexpr std::size_t kFewestSlots = 64;

std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
  return h ^ (h >> 31);
}

std::size_t hashOf(const ObjCorners::Corner& corner) {
  std::uint64_t h = 0;
  for (const std::uint32_t value : {corner.vertex, corner.texcoord, corner.normal})
    h = mixed(h + 0x9E3779B97F4A7C15U + value);
  return h;
}

/// By element of three numbers: the first of the same bits.
std::vector<std::uint32_t> firstOfEqual(const std::vector<double>& numbers) {
  const auto bytes = [&](std::size_t i) {
    return std::string_view(reinterpret_cast<const char*>(numbers.data() + 3 * i), 3 * sizeof(double));
  };
  std::vector<std::uint32_t> first(numbers.size() / 3);
  std::unordered_map<std::string_view, std::uint32_t> known(first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    first[i] = known.emplace(bytes(i), static_cast<std::uint32_t>(i)).first->second;
  return first;
}

/// One list, as seen by the corners.
struct Named {
  const char* what;
  std::size_t beyond = 0, missing = 0;
  std::vector<std::uint32_t> first;
  std::vector<bool> isNamed;

  Named(const char* name, const std::vector<double>& numbers)
      : what(name), first(firstOfEqual(numbers)), isNamed(first.size()) {}

  std::uint32_t operator()(std::uint32_t index) {
    if (index == ObjCorners::kNone) {
      ++missing;
      return ObjCorners::kNone;
    }
    if (index >= first.size()) {
      ++beyond;
      return ObjCorners::kNone;
    }
    isNamed[index] = true;
    return first[index];
  }
  bool isAny() const { return std::ranges::find(isNamed, true) != isNamed.end(); }

  void warn(Warnings& warnings) const {
    const auto unnamed = std::ranges::count(isNamed, false);
    if (unnamed > 0)
      warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of its {} {} belong to no corner and are left out", unnamed,
                                             isNamed.size(), what)});
    if (beyond > 0)
      warnings.push_back(
          {WarningCode::completed,
           fmt::format("corners name {} that are not there; they count as without any", what)});
    if (isAny() && missing + beyond > 0)
      warnings.push_back({WarningCode::completed,
                          fmt::format("some corners have {} and some have none; those get zeros", what)});
  }
};

}  // namespace

void ObjCorners::addTexcoord(std::span<const double> numbers) {
  for (std::size_t i = 0; i < 3; ++i) texcoords_.push_back(i < numbers.size() ? numbers[i] : 0);
  // Some exporters write a third coordinate to every texture, which is 0.
  if (numbers.size() > 2 && numbers[2] != 0) texcoordNumbers_ = 3;
}

void ObjCorners::addNormal(const std::array<double, 3>& numbers) {
  normals_.insert(normals_.end(), numbers.begin(), numbers.end());
}

void ObjCorners::begin(SurfaceMesh& mesh) {
  hasWedges_ = true;
  // The faces before name vertices alone, and their wedges say no more.
  mesh.wedges.reserve(mesh.triangles.capacity());
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> wedges;
    for (std::size_t k = 0; k < 3; ++k) wedges[k] = wedgeOf({.vertex = triangle[k]});
    mesh.wedges.push_back(wedges);
  }
}

void ObjCorners::grow(std::size_t slots) {
  slots_.assign(slots, ObjCorners::kNone);
  for (std::size_t w = 0; w < corners_.size(); ++w) {
    std::size_t slot = hashOf(corners_[w]) & (slots - 1);
    while (slots_[slot] != ObjCorners::kNone) slot = (slot + 1) & (slots - 1);
    slots_[slot] = static_cast<std::uint32_t>(w);
  }
}

std::uint32_t ObjCorners::wedgeOf(const Corner& corner) {
  // The table is at most half full.
  if (2 * (corners_.size() + 1) > slots_.size()) grow(std::max(kFewestSlots, 2 * slots_.size()));
  std::size_t slot = hashOf(corner) & (slots_.size() - 1);
  for (; slots_[slot] != ObjCorners::kNone; slot = (slot + 1) & (slots_.size() - 1))
    if (corners_[slots_[slot]] == corner) return slots_[slot];
  slots_[slot] = static_cast<std::uint32_t>(corners_.size());
  corners_.push_back(corner);
  return slots_[slot];
}

void ObjCorners::finish(MeshFile& file) {
  SurfaceMesh& mesh = file.mesh;
  Named texcoords("texture coordinates", texcoords_), normals("normals", normals_);
  // So far wedges have the indices of the file; now corners of equal values become one.
  std::vector<Corner> given = std::exchange(corners_, {});
  slots_.clear();
  for (Corner& corner : given)
    corner = {
        .vertex = corner.vertex, .texcoord = texcoords(corner.texcoord), .normal = normals(corner.normal)};
  texcoords.warn(file.warnings);
  normals.warn(file.warnings);
  if (!texcoords.isAny() && !normals.isAny()) {
    mesh.wedges.clear();
    return;
  }
  std::vector<std::uint32_t> wedgeOfGiven;
  wedgeOfGiven.reserve(given.size());
  for (const Corner& corner : given) wedgeOfGiven.push_back(wedgeOf(corner));
  for (auto& triangle : mesh.wedges)
    for (std::uint32_t& wedge : triangle) wedge = wedgeOfGiven[wedge];
  mesh.wedgeCount = static_cast<std::uint32_t>(corners_.size());

  const auto addAttribute = [&](std::string_view name, AttributeMeaning meaning, int components,
                                const std::vector<double>& numbers, std::uint32_t Corner::*index) {
    std::vector<double> ofWedges;
    ofWedges.reserve(corners_.size() * static_cast<std::size_t>(components));
    // A corner that names no index has zeros.
    for (const Corner& corner : corners_)
      for (int i = 0; i < components; ++i)
        ofWedges.push_back(corner.*index == ObjCorners::kNone
                               ? 0
                               : numbers[3 * std::size_t{corner.*index} + std::size_t(i)]);
    mesh.wedgeAttributes.push_back(
        attributeOfTextNumbers(std::string(name), meaning, static_cast<std::uint8_t>(components), ofWedges));
  };
  if (texcoords.isAny())
    addAttribute(kTexcoordName, AttributeMeaning::textureCoords, texcoordNumbers_, texcoords_,
                 &Corner::texcoord);
  if (normals.isAny()) addAttribute(kNormalName, AttributeMeaning::normal, 3, normals_, &Corner::normal);
}

}  // namespace arete
