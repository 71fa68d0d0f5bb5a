// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply/findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/file/text_scan.h"

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

void PlyFindings::warn(std::vector<std::string>& warnings) const {
  if (linesWithMore > 0)
    warnings.push_back(fmt::format(
        "{} lines have more values than the header states; these are left out (the first is line {})",
        linesWithMore, firstLineWithMore));
  if (scalarMisfits > 0)
    warnings.push_back(
        fmt::format("{} numbers do not fit the types that the header states; the nearest that do are taken",
                    scalarMisfits));
  if (smallFaces > 0)
    warnings.push_back(fmt::format("{} faces of fewer than three corners are left out", smallFaces));
  std::vector<std::string> names;
  for (const auto& [name, count] : elementsLeftOut)
    names.push_back(fmt::format("{} ({})", text::quotedToken(name), count));
  if (!names.empty()) warnings.push_back(fmt::format("its elements {} are left out", listOf(names)));
  names.clear();
  for (const std::string& name : varyingLists) names.push_back(text::quotedToken(name));
  if (!names.empty())
    warnings.push_back(fmt::format("its lists {}, whose lengths differ, are left out", listOf(names)));
  if (surplusProperties > 0)
    warnings.push_back(fmt::format(
        "{} properties of vertices and faces are left out, since there are too many", surplusProperties));
  if (facesLoseProperties)
    warnings.push_back("its faces lose their properties, since there are triangle strips as well");
  if (badTextureNumbers > 0)
    warnings.push_back(fmt::format(
        "{} faces have a texnumber without a comment TextureFile; they have no material", badTextureNumbers));
}

}  // namespace arete
