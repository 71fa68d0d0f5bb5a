// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/counted.h"
#include "io/files/text_scan.h"

namespace arete {

namespace {

constexpr std::size_t kMostNamed = 8;

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMostNamed) list += fmt::format(" and {} more", names.size() - kMostNamed);
  return list;
}

}  // namespace

void PlyFindings::warn(Warnings& warnings) const {
  if (linesWithMore > 0)
    warnings.push_back(
        {WarningCode::omitted,
         fmt::format("{} more values than the header states; these are left out (the first is line {})",
                     counted(linesWithMore, "line has", "lines have"), firstLineWithMore)});
  if (scalarMisfits > 0)
    warnings.push_back(
        {WarningCode::completed,
         counted(scalarMisfits,
                 "number does not fit the type that the header states; the nearest that does is taken",
                 "numbers do not fit the types that the header states; the nearest that do are taken")});
  if (smallFaces > 0)
    warnings.push_back(
        {WarningCode::omitted, counted(smallFaces, "face of fewer than three corners is left out",
                                       "faces of fewer than three corners are left out")});
  std::vector<std::string> names;
  for (const auto& [name, count] : elementsLeftOut)
    names.push_back(fmt::format("{} ({})", text::quotedToken(name), count));
  if (!names.empty())
    warnings.push_back({WarningCode::omitted, fmt::format("its elements {} are left out", listOf(names))});
  names.clear();
  for (const std::string& name : varyingLists) names.push_back(text::quotedToken(name));
  if (!names.empty())
    warnings.push_back({WarningCode::omitted,
                        fmt::format("its lists {}, whose lengths differ, are left out", listOf(names))});
  if (surplusProperties > 0)
    warnings.push_back(
        {WarningCode::omitted,
         counted(surplusProperties, "property of vertices and faces is left out, since there are too many",
                 "properties of vertices and faces are left out, since there are too many")});
  if (facesLoseProperties)
    warnings.push_back(
        {WarningCode::omitted, "its faces lose their properties, since there are triangle strips as well"});
  if (badTextureNumbers > 0)
    warnings.push_back(
        {WarningCode::omitted,
         counted(badTextureNumbers, "face has a texnumber without a comment TextureFile; it has no material",
                 "faces have a texnumber without a comment TextureFile; they have no material")});
}

}  // namespace arete
