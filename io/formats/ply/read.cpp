// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole file is in memory. The header says which elements there are, comments what some properties mean;
// then the data is read (io/formats/ply/data.h), the same way in all three encodings.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "io/formats/common/comments.h"
#include "io/formats/ply/data.h"
#include "io/formats/ply/header.h"
#include "io/formats/ply/notes.h"
#include "io/formats/ply/ply.h"
#include "io/formats/ply/scalars.h"

namespace arete {

namespace {

/// Notes are looked up one by one.
constexpr std::size_t kMostNotes = 1000;

Status checkElements(const PlyHeader& header, bool needsFaces, const std::string& path) {
  const auto countOf = [&](std::string_view name) {
    return std::ranges::count_if(header.elements, [&](const PlyElement& e) { return e.name == name; });
  };
  for (const char* name : {"vertex", "face", "tristrips"})
    if (countOf(name) > 1)
      return failure(ErrorCode::corrupt, fmt::format("has two elements {}", text::quotedToken(name)), path);
  if (countOf("vertex") == 0) return failure(ErrorCode::corrupt, "has no element \"vertex\"", path);
  if (needsFaces && countOf("face") == 0 && countOf("tristrips") == 0)
    return failure(ErrorCode::unsupported, "has no element \"face\": it is a point cloud, not a mesh", path);

  for (const PlyElement& element : header.elements)
    if (element.name == "vertex" && element.count >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::corrupt,
                     fmt::format("claims {} vertices, more than an index can name", element.count), path);
  return {};
}

/// Gives elements and properties the names that the reader knows where only upper and lower case differ:
/// "X" is "x", unless there is an "x" as well.
void useKnownNames(PlyHeader& header) {
  const auto rename = [](auto& named, std::initializer_list<std::string_view> known) {
    for (const std::string_view name : known) {
      if (std::ranges::any_of(named, [&](const auto& one) { return one.name == name; })) continue;
      for (auto& one : named)
        if (text::lowered(one.name) == name) one.name = name;
    }
  };
  rename(header.elements, {"vertex", "face", "tristrips"});
  for (PlyElement& element : header.elements) {
    if (element.name == "vertex") rename(element.properties, {"x", "y", "z"});
    if (element.name == "face") rename(element.properties, {"vertex_indices", "vertex_index", "error"});
    if (element.name == "tristrips") rename(element.properties, {"vertex_indices", "vertex_index"});
  }
}

/// "crs X" sets `value` to X, and "crs+ Y" appends Y.
void takeComment(std::string_view comment, std::string_view key, std::string& value) {
  if (!comment.starts_with(key)) return;
  comment.remove_prefix(key.size());
  if (comment.starts_with(' '))
    value = comment.substr(1);
  else if (comment.starts_with("+ "))
    value += comment.substr(2);
}

PlyComments takeComments(const PlyHeader& header, MeshFile& file) {
  PlyComments comments;
  for (const std::string& comment : header.comments) {
    takeComment(comment, "crs", file.crsWkt);
    takeComment(comment, "vertical_unit", file.verticalUnit);
    if (comment.starts_with(kMetresAboutKey))
      file.metresAbout = readPlaceNumbers(std::string_view(comment).substr(kMetresAboutKey.size()));
    if (auto picture = plyTextureFile(comment)) comments.pictures.push_back(std::move(*picture));
    if (comments.notes.size() < kMostNotes)
      if (auto note = plyNoteOf(comment)) comments.notes.push_back(std::move(*note));
  }
  return comments;
}

Result<MeshFile> readFile(const std::filesystem::path& path, bool needsFaces, const RunContext& context) {
  const std::string name = path.string();
  ARETE_TRY(FileBytes file, FileBytes::read(path));
  // A text in UTF-16, or with a byte order mark.
  if (!file.view().starts_with("ply")) ARETE_CHECK(file.decodeText(path));
  ARETE_TRY(PlyHeader header, parsePlyHeader(file.view(), name));
  // Carriage returns that end the lines of the data.
  if (header.format == PlyFormat::ascii) ARETE_CHECK(file.decodeText(path));
  useKnownNames(header);
  ARETE_CHECK(checkElements(header, needsFaces, name));

  MeshFile result;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
    result.folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const PlyComments comments = takeComments(header, result);
  const auto readAs = [&]<class Scalars>(Scalars) {
    return PlyReader<Scalars>(file, header, comments, name, context).readInto(result);
  };
  Status read;
  switch (header.format) {
    case PlyFormat::ascii:
      read = readAs(TextPlyScalars{});
      break;
    case PlyFormat::littleEndian:
      read = readAs(BinaryPlyScalars<std::endian::little>{});
      break;
    case PlyFormat::bigEndian:
      read = readAs(BinaryPlyScalars<std::endian::big>{});
      break;
  }
  if (!read) return tl::unexpected(read.error());
  return result;
}

}  // namespace

Result<MeshFile> readPly(const std::filesystem::path& path, const RunContext& context) {
  return readFile(path, true, context);
}

Result<MeshFile> readPlyOfPoints(const std::filesystem::path& path, const RunContext& context) {
  return readFile(path, false, context);
}

}  // namespace arete
