// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/object_runs.h"

#include <algorithm>

#include "io/files/text_scan.h"

namespace arete {

ObjectRuns::ObjectRuns(MeshRef mesh) {
  constexpr std::uint32_t kNone = MeshAttributes::kNone;
  const std::vector<std::uint32_t>& objectOf = mesh.attributes.objectOf;
  const std::size_t objects = mesh.attributes.objects.size(), triangles = mesh.shape.triangles.size();
  std::vector<bool> isUsed(objects), isListed(objects);
  for (const std::uint32_t object : objectOf)
    if (object != kNone) isUsed[object] = true;
  std::size_t nextEmpty = 0;
  const auto addEmpty = [&](std::size_t before, std::size_t at) {
    for (; nextEmpty < before; ++nextEmpty)
      if (!isUsed[nextEmpty]) runs.push_back({static_cast<std::uint32_t>(nextEmpty), at, at});
  };
  for (std::size_t t = 0; t < triangles;) {
    const std::uint32_t object = objectOf.empty() ? kNone : objectOf[t];
    std::size_t end = objectOf.empty() ? triangles : t;
    while (end < triangles && objectOf[end] == object) ++end;
    if (object == kNone) {
      isAnyBehind = isAnyBehind || !runs.empty();
    } else {
      addEmpty(object, t);
      areDivided = areDivided || isListed[object];
      isListed[object] = true;
    }
    runs.push_back({object, t, end});
    t = end;
  }
  addEmpty(objects, triangles);
}

std::string nameOnOneLine(const std::string& name) {
  std::string text = text::onOneLine(name);
  text.erase(text.begin(), std::ranges::find_if_not(text, text::isBlank));
  while (!text.empty() && text::isBlank(text.back())) text.pop_back();
  return text;
}

}  // namespace arete
