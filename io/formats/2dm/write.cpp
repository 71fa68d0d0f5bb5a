// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements first, then the nodes that they name, both numbered from 1; coordinates with the shortest digits
// that give the same double. The last word of an element is the number of its material.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "io/files/file_writer.h"
#include "io/files/write_progress.h"
#include "io/formats/2dm/2dm.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/losses.h"
#include "io/formats/common/text_reader.h"

namespace arete {

namespace {

/// Whether the format holds an attribute of triangles.
bool isMaterial(const Attribute& a) {
  return a.name == k2dmMaterialName && a.components == 1 && !isFloat(a.type) && a.type != ScalarType::uint32;
}

}  // namespace

Result<MeshWriteReport> write2dm(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  ARETE_TRY(FileWriter file, FileWriter::create(path));

  file.write(fmt::format("MESH2D\n# {}\n", kMeshTextGenerator));
  file.write(meshComments(options));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[160];  // three doubles of at most 24 characters each and a number
  const auto writeUpTo = [&](const char* end) { file.write({line, static_cast<std::size_t>(end - line)}); };
  const auto& attributes = written.attributes.triangleAttributes;
  const auto materials = std::ranges::find_if(attributes, isMaterial);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (progress.shouldStop()) return progress.interrupted();
    const auto& t = mesh.triangles[i];
    const auto material = materials == attributes.end() ? 1 : std::int64_t(materials->numbers(i).front());
    writeUpTo(fmt::format_to(line, FMT_COMPILE("E3T {} {} {} {} {}\n"), i + 1, std::uint64_t{t[0]} + 1,
                             std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1, material));
  }
  std::uint64_t number = 0;
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("ND {} {} {} {}\n"), ++number, p.x, p.y, p.z));
  }
  file.write(fmt::format("# {}\n", kMeshTextEnd));
  ARETE_CHECK(file.finish());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {.triangleAttribute = isMaterial})};
}

}  // namespace arete
