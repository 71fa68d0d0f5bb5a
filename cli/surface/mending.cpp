// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/mending.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "cli/arguments/arguments.h"

namespace arete {

std::string mendedText(const SurfaceRepairs& m, const std::string& begin) {
  std::string text;
  for (const auto& [count, what] :
       {std::pair{m.duplicateFaces, "duplicate faces left out"},
        {m.degenerateFaces, "faces without area left out"},
        {m.splitFaces, "faces added by splits at vertices of faces without area"},
        {m.joinedVertices, "vertices joined where a face without area was between them"},
        {m.turnedFaces, "faces turned to agree with their neighbours"},
        {m.addedVertices, "vertices added, one for each further fan"},
        {m.unusedVertices, "vertices without a face left out"}})
    if (count > 0) text += fmt::format("{}{}: {}\n", begin, what, grouped(count));
  return text;
}

Json mendedJson(const SurfaceRepairs& m) {
  return {{"duplicateFaces", m.duplicateFaces}, {"degenerateFaces", m.degenerateFaces},
          {"splitFaces", m.splitFaces},         {"joinedVertices", m.joinedVertices},
          {"turnedFaces", m.turnedFaces},       {"addedVertices", m.addedVertices},
          {"unusedVertices", m.unusedVertices}, {"dropsFlatNormals", m.dropsFlatNormals}};
}

}  // namespace arete
