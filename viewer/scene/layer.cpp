// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/layer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "viewer/scene/space_content.h"

namespace arete {

std::string_view Layer::kind() const {
  static constexpr std::array<std::string_view, 4> kNames = {"a drape", "an overlay", "contours", "lines"};
  if (const auto* drawn = std::get_if<Drawn>(&content)) return *drawn ? (*drawn)->kind() : "nothing";
  return kNames[content.index()];
}

Layer& Layers::put(const std::string& name, decltype(Layer::content) content) {
  Layer* found = find(name);
  if (!found) found = &list_.emplace_back(Layer{.name = name, .content = {}});
  found->content = std::move(content);
  return *found;
}

void Layers::remove(std::string_view name) {
  std::erase_if(list_, [&](const Layer& layer) { return layer.name == name; });
}

Layer* Layers::find(std::string_view name) {
  const auto found = std::ranges::find(list_, name, &Layer::name);
  return found == list_.end() ? nullptr : &*found;
}

void Layers::move(std::size_t index, bool isUp) {
  if (isUp ? index + 1 < list_.size() : index > 0)
    std::swap(list_[index], list_[isUp ? index + 1 : index - 1]);
}

}  // namespace arete
