// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements first, then the nodes that they name, both numbered from 1; coordinates with the shortest digits
// that give the same double.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstdint>

#include "io/file/file_writer.h"
#include "io/file/write_progress.h"
#include "io/mesh/2dm/2dm.h"
#include "io/mesh/comments.h"
#include "io/mesh/losses.h"
#include "io/mesh/text_reader.h"

namespace arete {

Result<MeshWriteReport> write2dm(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(fmt::format("MESH2D\n# {}\n", kMeshTextGenerator));
  file->write(meshComments(options));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[160];  // three doubles of at most 24 characters each and a number
  const auto writeUpTo = [&](const char* end) { file->write({line, static_cast<std::size_t>(end - line)}); };
  std::uint64_t number = 0;
  for (const auto& t : mesh.triangles) {
    if (progress.shouldStop()) return progress.interrupted();
    // The last column is the material.
    writeUpTo(fmt::format_to(line, FMT_COMPILE("E3T {} {} {} {} 1\n"), ++number, std::uint64_t{t[0]} + 1,
                             std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1));
  }
  number = 0;
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("ND {} {} {} {}\n"), ++number, p.x, p.y, p.z));
  }
  file->write(fmt::format("# {}\n", kMeshTextEnd));
  if (const Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
