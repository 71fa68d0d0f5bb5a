// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/unused.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arete {
namespace {

/// Leaves out what is not used; afterwards numberOf says the number of each of the others.
template <class T>
std::vector<std::uint32_t> keepUsed(std::vector<T>& things, const std::vector<bool>& isUsed) {
  std::vector<std::uint32_t> numberOf(things.size(), MeshAttributes::kNone);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (isUsed[i]) {
      numberOf[i] = kept;
      if (kept != i) things[kept] = std::move(things[i]);
      ++kept;
    }
  things.erase(things.begin() + std::ptrdiff_t(kept), things.end());
  return numberOf;
}

template <class T>
void keepNamed(std::vector<T>& things, std::vector<std::uint32_t>& numbers) {
  std::vector<bool> isUsed(things.size(), false);
  for (const std::uint32_t n : numbers)
    if (n != MeshAttributes::kNone) isUsed[n] = true;
  const std::vector<std::uint32_t> numberOf = keepUsed(things, isUsed);
  for (std::uint32_t& n : numbers)
    if (n != MeshAttributes::kNone) n = numberOf[n];
  if (things.empty()) numbers.clear();
}

/// The number of a picture in the mesh, as TextureUse::picture says it: "#2".
std::optional<std::size_t> embedded(const std::string& picture, std::size_t count) {
  if (!picture.starts_with('#')) return std::nullopt;
  std::size_t number = 0;
  const char* const last = picture.data() + picture.size();
  const auto [end, error] = std::from_chars(picture.data() + 1, last, number);
  if (error != std::errc{} || end != last || number >= count) return std::nullopt;
  return number;
}

}  // namespace

void removeUnusedNames(MeshAttributes& mesh) {
  keepNamed(mesh.objects, mesh.objectOf);
  keepNamed(mesh.groups, mesh.groupOf);
  keepNamed(mesh.materials, mesh.materialOf);
  const std::size_t pictures = mesh.pictures.size();
  std::vector<bool> isUsed(pictures, false);
  for (const Material& material : mesh.materials)
    for (const TextureUse& texture : material.textures)
      if (const auto number = embedded(texture.picture, pictures)) isUsed[*number] = true;
  if (std::ranges::find(isUsed, false) == isUsed.end()) return;
  const std::vector<std::uint32_t> numberOf = keepUsed(mesh.pictures, isUsed);
  for (Material& material : mesh.materials)
    for (TextureUse& texture : material.textures)
      if (const auto number = embedded(texture.picture, pictures))
        texture.picture = "#" + std::to_string(numberOf[*number]);
}

}  // namespace arete
