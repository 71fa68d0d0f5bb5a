// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/objects/object_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/counted.h"

namespace arete {

std::string ObjectList::nameOf(std::size_t i) const {
  const std::string& name = scene_.objects()[i].name;
  return name.empty() ? std::string(scene_.drawables()[i]->subject().kind()) : name;
}

std::string ObjectList::select(std::size_t object) {
  if (object >= count()) return {};
  const bool wasAlone = isAlone();
  if (wasAlone && object != selected_) toggleAlone();
  selected_ = object;
  if (wasAlone && !isAlone()) toggleAlone();
  return nameOf(object);
}

std::string ObjectList::setLevel(const std::optional<HandLevel>& level) {
  object().level = level;
  if (!level) return nameOf(selected_) + ": level by the view";
  if (level->triangles > 0)
    return fmt::format("{}: at most {}", nameOf(selected_),
                       counted(level->triangles, "triangle", "triangles"));
  return fmt::format("{}: within {:.4g}", nameOf(selected_), level->error);
}

std::string ObjectList::multiply(double factor) {
  const std::uint64_t finest = subject().facts().triangles;
  const double now = object().level && object().level->triangles > 0 ? object().level->triangles
                                                                     : object().figures.triangles;
  // The coarsest cut may have more; it is then what a budget below it gives.
  const double next = std::clamp(std::round(now * factor), 4.0, double(std::max<std::uint64_t>(finest, 4)));
  return setLevel(HandLevel{.triangles = std::uint32_t(next)});
}

std::string ObjectList::toggleAlone() {
  std::vector<ShownObject>& objects = scene_.objects();
  if (isAlone()) {
    for (std::size_t i = 0; i < objects.size(); ++i) objects[i].isShown = wasShown_[i];
    wasShown_.clear();
    return "all objects";
  }
  for (const ShownObject& each : objects) wasShown_.push_back(each.isShown);
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i].isShown = i == selected_;
  return nameOf(selected_) + " alone";
}

}  // namespace arete
