// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/named_importance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "surface/attributes/attribute_names.h"

namespace arete {

Result<std::optional<Importance>> importanceNamed(const SurfaceModel& model, const std::string& name) {
  std::optional<Importance> importance;
  if (name.empty()) return importance;
  const auto refused = [&](ErrorCode code, std::string why) {
    return failure(code, std::move(why), "importance " + name);
  };
  const auto named = findAttributes(model.attributes, name);
  if (!named) return refused(ErrorCode::usage, named.error().message);
  for (const NamedAttribute& one : *named) {
    const bool ofWedges = one.of == NamedAttribute::Of::wedges;
    if (!ofWedges && one.of != NamedAttribute::Of::vertices)
      return refused(ErrorCode::usage, "is not a number of vertices or corners");
    const Attribute& attribute =
        (ofWedges ? model.attributes.wedgeAttributes : model.attributes.vertexAttributes)[one.index];
    if (attribute.components != 1)
      return refused(ErrorCode::usage,
                     fmt::format("has {} numbers; a tolerance is divided by one", attribute.components));
    auto found = importanceOf(model, attribute, ofWedges);
    if (!found) return refused(found.error().code, found.error().message);
    if (!importance) {
      importance = std::move(*found);
      continue;
    }
    for (std::size_t t = 0; t < found->most.size(); ++t)
      importance->most[t] = std::max(importance->most[t], found->most[t]);
    importance->largest = std::max(importance->largest, found->largest);
    importance->least = std::min(importance->least, found->least);
  }
  return importance;
}

}  // namespace arete
