// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass over the text, line by line. "v" and "f" lines are scanned by hand; a line with another keyword is
// skipped. A line that ends in a backslash continues in the next one ("v" and "f" only: in comments and file
// names a backslash is a backslash). A face may name vertices that come later, so the largest index is kept
// with its line and checked at the end.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "io/file/file_bytes.h"
#include "io/file/text_scan.h"
#include "io/mesh/obj/obj.h"
#include "io/mesh/text_reader.h"

namespace arete {

namespace {

class ObjReader final : public MeshTextReader {
 public:
  using MeshTextReader::MeshTextReader;

 private:
  Status readLine() override {
    while (at() < end() && text::isBlank(*at())) ++at();
    if (at() == end() || *at() == '\n') return {};
    const char* word = at();
    if (*at() == '#') {
      at() = lineEnd();
      takeComment(std::string_view(word + 1, static_cast<std::size_t>(at() - word - 1)));
      return {};
    }
    while (at() < end() && !text::isSpace(*at())) ++at();
    const std::string_view keyword(word, static_cast<std::size_t>(at() - word));
    if (keyword == "v") return readVertex(word);
    if (keyword == "f") return readFace(word);
    if (!isKeyword(keyword))
      return corrupt(word, fmt::format("begins with {}: unknown OBJ keyword", text::quotedToken(keyword)));
    at() = lineEnd();
    return {};
  }

  /// Moves to the next word of the line. False at its end.
  bool toNextWord() {
    const char*& p = at();
    while (p < end()) {
      if (text::isBlank(*p)) {
        ++p;
        continue;
      }
      if (*p == '\\') {
        const char* next = p + 1;
        if (next < end() && *next == '\r') ++next;
        if (next < end() && *next == '\n') {
          p = next + 1;
          continue;
        }
      }
      // Some writers put comments behind the numbers.
      return *p != '\n' && *p != '#';
    }
    return false;
  }

  Status readVertex(const char* line) {
    double xyz[3];
    for (double& value : xyz)
      if (!toNextWord() || !text::scanNumber(at(), end(), value))
        return corrupt(line, "is a vertex without three numbers");
    for (const double value : xyz)
      if (!std::isfinite(value)) return corrupt(line, "has a coordinate that is not finite");
    mesh().mesh.positions.push_back({xyz[0], xyz[1], xyz[2]});
    // A weight or a colour may follow.
    for (double ignored; toNextWord();)
      if (!text::scanNumber(at(), end(), ignored))
        return corrupt(line, "is a vertex with a value that is not a number");
    at() = lineEnd();
    return {};
  }

  Status readFace(const char* line) {
    corners_.clear();
    while (toNextWord()) {
      const char*& p = at();
      std::int64_t index = 0;
      const auto [behind, error] = std::from_chars(p, end(), index);
      if (error != std::errc{}) return corrupt(line, "is a face with a corner that is not a number");
      p = behind;
      while (p < end() && (*p == '/' || *p == '-' || (*p >= '0' && *p <= '9'))) ++p;
      if (p < end() && !text::isSpace(*p))
        return corrupt(line, "is a face with a corner that is not of the form a/b/c");
      const auto known = static_cast<std::int64_t>(mesh().mesh.positions.size());
      if (index < 0) index += known + 1;
      if (index < 1 || index > std::int64_t(std::numeric_limits<std::uint32_t>::max()))
        return corrupt(line, "is a face with a vertex index out of range");
      if (index > largestIndex_) {
        largestIndex_ = index;
        largestIndexLine_ = line;
      }
      corners_.push_back(static_cast<std::uint32_t>(index - 1));
    }
    if (corners_.size() < 3) return corrupt(line, fmt::format("is a face of {} corners", corners_.size()));
    faces().add(mesh().mesh, corners_);
    at() = lineEnd();
    return {};
  }

  Status finish() override {
    const TriangleMesh& read = mesh().mesh;
    if (largestIndex_ > std::int64_t(read.positions.size()))
      return corrupt(largestIndexLine_,
                     fmt::format("names vertex {} of {}", largestIndex_, read.positions.size()));
    if (!isOurs() && read.positions.empty()) return failure(ErrorCode::corrupt, "holds no vertex", path());
    if (!isOurs() && read.triangles.empty()) return unsupported("holds no face");
    if (read.positions.size() >= std::numeric_limits<std::uint32_t>::max())
      return unsupported("holds more vertices than an index can name");
    return {};
  }

  std::vector<std::uint32_t> corners_;
  std::int64_t largestIndex_ = 0;
  const char* largestIndexLine_ = nullptr;
};

}  // namespace

Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> file = FileBytes::readText(path);
  if (!file) return tl::unexpected(file.error());
  return ObjReader(*file, path.string(), context).read();
}

}  // namespace arete
