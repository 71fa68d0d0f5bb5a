// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header as text, then one record per vertex and per face, each filled in place in the writer's buffer.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "io/file/file_writer.h"
#include "io/file/text_scan.h"
#include "io/file/write_progress.h"
#include "io/mesh/losses.h"
#include "io/mesh/ply/ply.h"

namespace arete {

// Records are copied to the file as they lie in memory.
static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

/// MeshLab rejects a PLY with a line of 511 bytes or more, and the WKT of a CRS has about a thousand.
constexpr std::size_t kLongestPart = 240;

/// "comment <key> <text>". A long text continues on further lines that begin with `more` instead of `key`. No
/// UTF-8 character is split.
std::string commentLines(std::string_view key, std::string_view more, std::string_view text) {
  std::string lines;
  do {
    std::size_t size = std::min(text.size(), kLongestPart);
    while (size > 1 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) --size;
    lines += fmt::format("comment {}{}\n", lines.empty() ? key : more, text.substr(0, size));
    text.remove_prefix(size);
  } while (!text.empty());
  return lines;
}

std::string headerOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment generator arete\n";
  if (!options.crsWkt.empty()) header += commentLines("crs ", "crs+ ", text::onOneLine(options.crsWkt));
  if (!options.verticalUnit.empty())
    header += fmt::format("comment vertical_unit {}\n", text::onOneLine(options.verticalUnit));
  for (const std::string& note : options.notes) header += commentLines("", "", text::onOneLine(note));
  header += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                        mesh.positions.size());
  if (!options.vertexQualities.empty()) header += "property float quality\n";
  if (!options.vertexColors.empty())
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  if (!options.triangleErrors.empty()) header += "property float error\n";
  return header + "end_header\n";
}

}  // namespace

Result<MeshWriteReport> writePly(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  const auto refuse = [&](std::string message) {
    return failure(ErrorCode::invalidData, std::move(message), path.string());
  };
  if (const Status ok = written.validate(); !ok) return refuse(ok.error().message);
  if (mesh.positions.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
    return refuse(
        fmt::format("{} vertices are more than a PLY of int indices can name", mesh.positions.size()));
  if (!options.triangleErrors.empty() && options.triangleErrors.size() != mesh.triangles.size())
    return refuse(
        fmt::format("{} errors for {} triangles", options.triangleErrors.size(), mesh.triangles.size()));
  for (const std::size_t values : {options.vertexQualities.size(), options.vertexColors.size()})
    if (values != 0 && values != mesh.positions.size())
      return refuse(fmt::format("{} values for {} vertices", values, mesh.positions.size()));
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(headerOf(mesh, options));
  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);

  const bool withQualities = !options.vertexQualities.empty(), withColors = !options.vertexColors.empty();
  const std::size_t vertexSize =
      3 * sizeof(double) + (withQualities ? sizeof(float) : 0) + (withColors ? 3 : 0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (progress.shouldStop()) return progress.interrupted();
    const Vec3& p = mesh.positions[v];
    char* to = putBytes(putBytes(putBytes(file->reserve(vertexSize), p.x), p.y), p.z);
    if (withQualities) to = putBytes(to, options.vertexQualities[v]);
    if (withColors) putBytes(to, options.vertexColors[v]);
  }
  const bool withErrors = !options.triangleErrors.empty();
  const std::size_t faceSize = 1 + 3 * sizeof(std::int32_t) + (withErrors ? sizeof(float) : 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (progress.shouldStop()) return progress.interrupted();
    char* to = putBytes(file->reserve(faceSize), std::uint8_t{3});
    for (const std::uint32_t v : mesh.triangles[t]) to = putBytes(to, static_cast<std::int32_t>(v));
    if (withErrors) putBytes(to, options.triangleErrors[t]);
  }
  if (const Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
