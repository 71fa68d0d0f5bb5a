// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/file_bytes.h"
#include "io/formats/common/faces.h"
#include "io/formats/common/file.h"

namespace arete {

/// The first and the last comment of a mesh that Arete wrote as text. Neither OBJ nor 2DM states its length,
/// so the last one shows that a file is whole.
inline constexpr std::string_view kMeshTextGenerator = "generator arete", kMeshTextEnd = "end";

/// Base of the readers of mesh formats that are lines of text: OBJ and 2DM. Walks over the lines, understands
/// the comments that Arete writes, and reports progress. A format implements readLine() and finish().
class MeshTextReader {
 public:
  /// @param file The bytes of FileBytes::readText(). Must outlive the reader.
  MeshTextReader(const FileBytes& file, std::string path, const RunContext& context);
  MeshTextReader(const MeshTextReader&) = delete;
  MeshTextReader& operator=(const MeshTextReader&) = delete;

  /// Reads the whole file. Call once.
  ///
  /// Errors: corrupt: from the format; a file with the comment "generator arete" and without "end" is
  /// truncated. unsupported: from the format. interrupted. O(file size).
  Result<MeshFile> read();

 protected:
  virtual ~MeshTextReader() = default;

  /// Reads the line that begins at at(). Leaves at() at the end of that line: at its '\n' or at end().
  virtual Status readLine() = 0;
  /// Checks and completes mesh() after the last line.
  virtual Status finish() = 0;

  const char*& at() { return at_; }
  const char* end() const { return end_; }
  /// The end of the line that at() is in: its '\n', or end().
  const char* lineEnd() const {
    const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    return newline ? static_cast<const char*>(newline) : end_;
  }
  MeshFile& mesh() { return mesh_; }
  /// Takes the faces of more than three corners; read() triangulates them after finish().
  MeshFaces& faces() { return faces_; }
  const std::string& path() const { return path_; }
  /// The file has the comment "generator arete".
  bool isOurs() const { return isOurs_; }

  /// Takes "crs <WKT>", "vertical_unit <unit>" and the two marks of Arete from a comment without its '#'.
  void takeComment(std::string_view comment);
  /// Letters, digits and underscores only, as the first word of a line in either format.
  static bool isKeyword(std::string_view word);
  /// Counts a line that is not read by its first word.
  void leaveOut(std::string_view keyword);
  /// Adds the sentence "its <lines> "l" (2), "p" (1) are left out" to the warnings, if any are.
  void warnOfLeftOut(std::string_view lines);
  /// @param place Where in the file. The sentence is "line <number> <what>".
  tl::unexpected<Error> corrupt(const char* place, std::string_view what) const;
  tl::unexpected<Error> unsupported(std::string message) const;

 private:
  const char* begin_;
  const char* at_;
  const char* end_;
  std::string path_;
  const RunContext& context_;
  MeshFile mesh_;
  MeshFaces faces_;
  bool isOurs_ = false, hasEnd_ = false;
  std::map<std::string, std::uint64_t, std::less<>> leftOut_;
  std::uint64_t leftOutOthers_ = 0;
};

}  // namespace arete
