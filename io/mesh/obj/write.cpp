// SPDX-License-Identifier: GPL-3.0-or-later
//
// A "v" line per vertex, then an "f" line per triangle, with the shortest digits that give the same double.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstdint>

#include "io/file/file_writer.h"
#include "io/file/write_progress.h"
#include "io/mesh/comments.h"
#include "io/mesh/losses.h"
#include "io/mesh/obj/obj.h"
#include "io/mesh/text_reader.h"

namespace arete {

Result<MeshWriteReport> writeObj(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(fmt::format("# {}\n", kMeshTextGenerator));
  file->write(meshComments(options));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[128];  // three doubles of at most 24 characters each
  const auto writeUpTo = [&](const char* end) { file->write({line, static_cast<std::size_t>(end - line)}); };
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("v {} {} {}\n"), p.x, p.y, p.z));
  }
  for (const auto& t : mesh.triangles) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("f {} {} {}\n"), std::uint64_t{t[0]} + 1,
                             std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1));
  }
  file->write(fmt::format("# {}\n", kMeshTextEnd));
  if (const Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
