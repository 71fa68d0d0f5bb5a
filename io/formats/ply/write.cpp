// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header as text, then one record per vertex and per face, each filled in place in the writer's buffer,
// or in one of its own if it is larger than that.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "io/files/file_writer.h"
#include "io/files/text_scan.h"
#include "io/files/write_progress.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/losses.h"
#include "io/formats/ply/columns.h"
#include "io/formats/ply/ply.h"
#include "io/formats/ply/textures.h"

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

/// Lists of corners are three times as long as a vector; a length of one byte is what every program reads.
bool hasShortLength(const PlyColumn& corners) {
  return corners.attribute->components * 3 <= std::numeric_limits<std::uint8_t>::max();
}

std::string propertiesOf(const std::vector<PlyColumn>& columns, bool areCorners = false) {
  std::string lines;
  for (const PlyColumn& column : columns)
    for (const std::string& name : column.properties)
      lines += fmt::format("property {}{} {}\n",
                           !column.isList                          ? ""
                           : !areCorners || hasShortLength(column) ? "list uchar "
                                                                   : "list uint ",
                           plyTypeName(column.attribute->type), name);
  return lines;
}

/// Whether floats of 32 bits hold every coordinate to the bit. Those of terrain are doubles, whatever they
/// hold.
bool areFloats(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  if (options.up == MeshUp::z) return false;
  const auto isFloat = [](double number) {
    const auto rounded = static_cast<float>(number);
    return std::bit_cast<std::uint64_t>(double{rounded}) == std::bit_cast<std::uint64_t>(number);
  };
  return std::ranges::all_of(mesh.positions,
                             [&](const Vec3& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); });
}

std::string headerOf(const TriangleMesh& mesh, const MeshWriteOptions& options, const PlyColumns& columns,
                     const PlyTextures& textures, bool areFloats) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment generator arete\n";
  if (!options.crsWkt.empty()) header += commentLines("crs ", "crs+ ", text::onOneLine(options.crsWkt));
  if (!options.verticalUnit.empty())
    header += fmt::format("comment vertical_unit {}\n", text::onOneLine(options.verticalUnit));
  if (options.metresAbout)
    header += fmt::format("comment {}{}\n", kMetresAboutKey, metresAboutText(*options.metresAbout));
  for (const std::string& note : options.notes) header += commentLines("", "", text::onOneLine(note));
  for (const PlyNote& note : columns.notes) header += plyComment(note);
  for (const std::string& picture : textures.pictures)
    header += fmt::format("comment TextureFile {}\n", picture);
  header += fmt::format("element vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n",
                        mesh.positions.size(), areFloats ? "float" : "double");
  if (!options.vertexQualities.empty()) header += "property float quality\n";
  if (!options.vertexColors.empty())
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  header += propertiesOf(columns.vertices);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  if (!options.triangleErrors.empty()) header += "property float error\n";
  header += propertiesOf(columns.corners, true);
  if (!textures.numbers.empty()) header += "property int texnumber\n";
  header += propertiesOf(columns.faces);
  return header + "end_header\n";
}

char* putElement(char* to, const PlyColumn& column, std::size_t element) {
  const auto bytes = column.attribute->element(element);
  if (column.isList) to = putBytes(to, column.attribute->components);
  std::memcpy(to, bytes.data(), bytes.size());
  return to + bytes.size();
}

char* putCorners(char* to, const PlyColumn& column, const std::array<std::uint32_t, 3>& wedges) {
  const std::uint32_t length = column.attribute->components * 3u;
  to = hasShortLength(column) ? putBytes(to, static_cast<std::uint8_t>(length)) : putBytes(to, length);
  for (const std::uint32_t wedge : wedges) {
    const auto bytes = column.attribute->element(wedge);
    std::memcpy(to, bytes.data(), bytes.size());
    to += bytes.size();
  }
  return to;
}

std::size_t sizeOfRecord(const std::vector<PlyColumn>& columns) {
  std::size_t size = 0;
  for (const PlyColumn& column : columns) size += (column.isList ? 1 : 0) + column.attribute->elementBytes();
  return size;
}

/// Hands out room for records of one size.
class Records {
 public:
  Records(FileWriter& file, std::size_t size) : file_(file), size_(size) {
    if (size > FileWriter::kCapacity) large_.resize(size);
  }
  char* begin() { return large_.empty() ? file_.reserve(size_) : large_.data(); }
  void end() {
    if (!large_.empty()) file_.write({large_.data(), large_.size()});
  }

 private:
  FileWriter& file_;
  std::size_t size_;
  std::vector<char> large_;
};

/// What does not fit the mesh; empty: nothing.
std::string misfitOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  if (mesh.positions.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
    return fmt::format("{} vertices are more than a PLY of int indices can name", mesh.positions.size());
  if (!options.triangleErrors.empty() && options.triangleErrors.size() != mesh.triangles.size())
    return fmt::format("{} errors for {} triangles", options.triangleErrors.size(), mesh.triangles.size());
  for (const std::size_t values : {options.vertexQualities.size(), options.vertexColors.size()})
    if (values != 0 && values != mesh.positions.size())
      return fmt::format("{} values for {} vertices", values, mesh.positions.size());
  return {};
}

}  // namespace

Result<MeshWriteReport> writePly(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  // A mesh that does not fit the format or its options is refused before the file is created.
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  if (std::string misfit = misfitOf(mesh, options); !misfit.empty())
    return failure(ErrorCode::invalidData, std::move(misfit), path.string());
  ARETE_TRY(FileWriter file, FileWriter::create(path));
  ARETE_TRY(const PlyTextures textures, plyTextures(written, path, options));
  const PlyColumns columns = plyColumns(written.attributes, options, !textures.numbers.empty());

  const bool withFloats = areFloats(mesh, options);
  file.write(headerOf(mesh, options, columns, textures, withFloats));
  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);

  // All records of vertices have one size, and so do all of faces, as each face has three corners. So each
  // record is filled in place.
  const bool withQualities = !options.vertexQualities.empty(), withColors = !options.vertexColors.empty();
  Records vertices(file, 3 * (withFloats ? sizeof(float) : sizeof(double)) +
                             (withQualities ? sizeof(float) : 0) + (withColors ? 3 : 0) +
                             sizeOfRecord(columns.vertices));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (progress.shouldStop()) return progress.interrupted();
    const Vec3& p = mesh.positions[v];
    char* to = vertices.begin();
    for (const double number : {p.x, p.y, p.z})
      to = withFloats ? putBytes(to, static_cast<float>(number)) : putBytes(to, number);
    if (withQualities) to = putBytes(to, options.vertexQualities[v]);
    if (withColors) to = putBytes(to, options.vertexColors[v]);
    for (const PlyColumn& column : columns.vertices) to = putElement(to, column, v);
    vertices.end();
  }

  // Lists of corners have a length before their values, in a byte where it fits.
  const bool withErrors = !options.triangleErrors.empty(), withNumbers = !textures.numbers.empty();
  std::size_t faceSize = 1 + 3 * sizeof(std::int32_t) + (withErrors ? sizeof(float) : 0) +
                         (withNumbers ? sizeof(std::int32_t) : 0) + sizeOfRecord(columns.faces);
  for (const PlyColumn& column : columns.corners)
    faceSize += (hasShortLength(column) ? 1 : sizeof(std::uint32_t)) + 3 * column.attribute->elementBytes();
  Records faces(file, faceSize);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (progress.shouldStop()) return progress.interrupted();
    char* to = putBytes(faces.begin(), std::uint8_t{3});
    for (const std::uint32_t v : mesh.triangles[t]) to = putBytes(to, static_cast<std::int32_t>(v));
    if (withErrors) to = putBytes(to, options.triangleErrors[t]);
    for (const PlyColumn& column : columns.corners) to = putCorners(to, column, written.attributes.wedges[t]);
    if (withNumbers) to = putBytes(to, textures.numbers[t]);
    for (const PlyColumn& column : columns.faces) to = putElement(to, column, t);
    faces.end();
  }
  ARETE_CHECK(file.finish());

  // The columns say themselves what they lose; the rest is what the format has no place for.
  const MeshHolds::Test any = [](const Attribute&) { return true; };
  MeshWriteReport report{.lost = lossesOf(written.attributes, {.vertexAttribute = any,
                                                               .wedgeAttribute = any,
                                                               .triangleAttribute = any,
                                                               .materials = true,
                                                               .pictures = true}),
                         .filesBeside = textures.files};
  report.lost.insert(report.lost.end(), columns.lost.begin(), columns.lost.end());
  report.lost.insert(report.lost.end(), textures.lost.begin(), textures.lost.end());
  return report;
}

}  // namespace arete
