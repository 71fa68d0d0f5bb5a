// SPDX-License-Identifier: GPL-3.0-or-later
//
// ASCII STL is read word by word: facets of exactly three vertices between "solid" and "endsolid". The rest
// of the line of "solid" is a name. Some programs write "end solid", "end facet", "end loop".
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "io/file/text_scan.h"
#include "io/mesh/stl/read_parts.h"

namespace arete {
namespace {

/// Whether a number has more digits than any float32 needs.
bool isFinerThanFloat32(std::string_view number) {
  constexpr int kMostDigits = std::numeric_limits<float>::max_digits10;
  int digits = 0;
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if ((c > '0' && c <= '9') || (c == '0' && digits > 0)) ++digits;
  }
  return digits > kMostDigits;
}

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view file, std::string path, const RunContext& context)
      : begin_(file.data()),
        at_(file.data()),
        end_(file.data() + file.size()),
        path_(std::move(path)),
        context_(context) {}

  Result<MeshFile> read() {
    SurfaceMesh& mesh = result_.mesh;
    for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
      if (!equalsStlWord(word, "solid")) return corrupt(word, "where \"solid\" should be");
      const auto object = static_cast<std::uint32_t>(mesh.objects.size());
      mesh.objects.push_back(restOfLine());
      if (const Status ok = readFacets(); !ok) return tl::unexpected(ok.error());
      mesh.objectOf.resize(triangles_.size(), object);
      restOfLine();
    }
    if (triangles_.size() == 0) return failure(ErrorCode::unsupported, "holds no facet", path_);
    if (mesh.objects.size() == 1 && mesh.objects[0].empty()) {
      mesh.objects.clear();
      mesh.objectOf.clear();
    }
    triangles_.finish(result_, {});
    result_.frame.coordinates = "text";
    if (isFine_) result_.frame.rounding = {};
    return std::move(result_);
  }

 private:
  /// Empty at the end of the file.
  std::string_view nextWord() {
    while (at_ < end_ && text::isSpace(*at_)) ++at_;
    const char* from = at_;
    while (at_ < end_ && !text::isSpace(*at_)) ++at_;
    return {from, static_cast<std::size_t>(at_ - from)};
  }
  /// Without blanks at its ends.
  std::string restOfLine() {
    while (at_ < end_ && text::isBlank(*at_)) ++at_;
    const char* from = at_;
    while (at_ < end_ && *at_ != '\n') ++at_;
    const char* to = at_;
    while (to > from && text::isBlank(to[-1])) --to;
    return {from, to};
  }

  tl::unexpected<Error> corrupt(std::string_view word, std::string_view what) const {
    if (word.empty())
      return failure(ErrorCode::corrupt, "is truncated: it ends before its last line, \"endsolid\"", path_);
    return failure(
        ErrorCode::corrupt,
        fmt::format("line {} has {} {}", text::lineOf(begin_, word.data()), text::quotedToken(word), what),
        path_);
  }

  /// Whether a word, or it and the next one, are "end" and `what`.
  bool isEnd(std::string_view word, std::string_view what) {
    constexpr std::string_view kEnd = "end";
    if (word.size() == kEnd.size() + what.size())
      return equalsStlWord(word.substr(0, kEnd.size()), kEnd) &&
             equalsStlWord(word.substr(kEnd.size()), what);
    if (!equalsStlWord(word, kEnd)) return false;
    const char* const before = at_;
    if (equalsStlWord(nextWord(), what)) return true;
    at_ = before;
    return false;
  }

  Status expect(std::initializer_list<std::string_view> words) {
    for (const std::string_view expected : words)
      if (const std::string_view word = nextWord(); !equalsStlWord(word, expected))
        return corrupt(word, fmt::format("where \"{}\" should be", expected));
    return {};
  }

  Status readFacets() {
    for (;;) {
      const std::string_view word = nextWord();
      if (isEnd(word, "solid")) return {};
      if (!equalsStlWord(word, "facet")) return corrupt(word, "where \"facet\" or \"endsolid\" should be");
      if (Status ok = readFacet(); !ok) return ok;
    }
  }

  /// The normal, which some programs leave out or write as "nan": zeros then.
  Vec3 readNormal() {
    const char* const lineBegin = at_;
    restOfLine();
    const char* const lineEnd = at_;
    at_ = lineBegin;
    std::array<double, 3> xyz{};
    bool isNormal = equalsStlWord(nextWord(), "normal");
    for (double& value : xyz) {
      const std::string_view word = nextWord();
      const char* from = word.data();
      isNormal = isNormal && !word.empty() && text::scanNumber(from, word.data() + word.size(), value);
    }
    isNormal = isNormal && at_ <= lineEnd;
    at_ = lineEnd;
    return isNormal ? Vec3{xyz[0], xyz[1], xyz[2]} : Vec3{};
  }

  Status readFacet() {
    if (triangles_.size() % kStlTrianglesPerCancelCheck == 0) {
      context_.report("reading the mesh", double(at_ - begin_) / double(end_ - begin_));
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
    }
    if (triangles_.size() == kMostStlTriangles)
      return failure(ErrorCode::unsupported, "holds more triangles than an index can name", path_);
    const Vec3 normal = readNormal();
    if (Status ok = expect({"outer", "loop"}); !ok) return ok;
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      if (Status ok = expect({"vertex"}); !ok) return ok;
      for (double* value : {&corner.x, &corner.y, &corner.z}) {
        const std::string_view word = nextWord();
        const char* from = word.data();
        if (word.empty() || !text::scanNumber(from, word.data() + word.size(), *value))
          return corrupt(word, "where a number should be");
        if (!std::isfinite(*value)) return corrupt(word, "where a finite number should be");
        isFine_ = isFine_ || isFinerThanFloat32(word);
      }
    }
    for (const std::string_view what : {"loop", "facet"})
      if (const std::string_view word = nextWord(); !isEnd(word, what))
        return corrupt(word, fmt::format("where \"end{}\" should be", what));
    triangles_.add(corners, {}, normal);
    return {};
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  std::string path_;
  const RunContext& context_;
  StlTriangles triangles_;
  bool isFine_ = false;  // some program has written doubles
  MeshFile result_;
};

}  // namespace

Result<MeshFile> readAsciiStl(std::string_view file, std::string path, const RunContext& context) {
  return AsciiStlReader(file, std::move(path), context).read();
}

}  // namespace arete
