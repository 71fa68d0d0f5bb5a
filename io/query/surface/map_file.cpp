// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/map_file.h"

#include <fmt/format.h>

#include "io/files/file_writer.h"
#include "surface/model/surface_mesh.h"

namespace arete {

Status writeNumberMap(const std::string& path, const NumberMap& map) {
  ARETE_TRY(FileWriter out, FileWriter::create(path));
  out.write("what,output,input\n");
  const auto inFile = [](const auto& number, std::uint32_t i) {
    return number ? number(i) : std::uint64_t{i};
  };
  for (std::size_t v = 0; v < map.vertexOf.size(); ++v)
    out.write(fmt::format("vertex,{},{}\n", v, inFile(map.vertexOfFile, map.vertexOf[v])));
  for (std::uint32_t f = 0; f < map.triangleFor.size(); ++f)
    if (map.triangleFor[f] != MeshAttributes::kNone)
      out.write(fmt::format("face,{},{}\n", map.triangleFor[f], inFile(map.faceOfFile, f)));
  return out.finish();
}

void renumberForFile(std::span<std::uint32_t> triangleFor, const std::vector<std::uint32_t>& triangleOf) {
  if (triangleOf.empty()) return;
  std::vector<std::uint32_t> placeOf(triangleOf.size());
  for (std::uint32_t i = 0; i < placeOf.size(); ++i) placeOf[triangleOf[i]] = i;
  for (std::uint32_t& triangle : triangleFor)
    if (triangle != MeshAttributes::kNone) triangle = placeOf[triangle];
}

}  // namespace arete
