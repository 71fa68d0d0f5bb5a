// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keyword, the counts, a line per vertex, then a line per triangle. CRS and unit are comments.
#include <fmt/compile.h>
#include <fmt/format.h>

#include "io/file/file_writer.h"
#include "io/file/write_progress.h"
#include "io/mesh/comments.h"
#include "io/mesh/losses.h"
#include "io/mesh/off/off.h"
#include "io/mesh/text_reader.h"

namespace arete {

Result<MeshWriteReport> writeOff(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(fmt::format("OFF\n# {}\n", kMeshTextGenerator));
  file->write(meshComments(options));
  file->write(fmt::format("{} {} 0\n", mesh.positions.size(), mesh.triangles.size()));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[128];  // three doubles of at most 24 characters each
  const auto writeUpTo = [&](const char* end) { file->write({line, static_cast<std::size_t>(end - line)}); };
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("{} {} {}\n"), p.x, p.y, p.z));
  }
  for (const auto& t : mesh.triangles) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("3 {} {} {}\n"), t[0], t[1], t[2]));
  }
  file->write(fmt::format("# {}\n", kMeshTextEnd));
  if (const Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
