// SPDX-License-Identifier: GPL-3.0-or-later
//
// ASCII STL is read word by word: facets of exactly three vertices between "solid" and "endsolid". The rest
// of the line of "solid" is a name, unless the file has more on that line. Some programs write "end solid",
// "end facet", "end loop".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/stl/read_parts.h"

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
      mesh.objects.push_back(name("facet"));
      ARETE_CHECK(readFacets());
      mesh.objectOf.resize(triangles_.size(), object);
      name("solid");
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
  /// The name of a solid, without blanks at its ends: the rest of the line. Where the file has more on that
  /// line, the name ends before it: at "facet normal", "facet outer" or "endsolid" behind "solid", at "solid"
  /// behind "endsolid". A name may have these words alone.
  std::string name(std::string_view next) {
    while (at_ < end_ && text::isBlank(*at_)) ++at_;
    const char* const from = at_;
    const char* const lineEnd = lineEndOf(at_);
    const char* to = lineEnd;
    while (at_ < lineEnd) {
      const std::string_view word = nextWord();
      if (word.empty() || word.data() >= lineEnd) break;
      const char* const behind = at_;
      const bool isNext = next == "facet" ? isFacet(word, lineEnd) || isEndOfSolid(word, lineEnd)
                                          : equalsStlWord(word, next) &&
                                                (holdsFacet(behind, lineEnd) || isFacetBehind(lineEnd));
      at_ = behind;
      if (!isNext) continue;
      to = word.data();
      break;
    }
    at_ = to;
    while (to > from && text::isBlank(to[-1])) --to;
    return {from, to};
  }

  /// Whether the words from here to the end of the line hold a facet.
  bool holdsFacet(const char* from, const char* lineEnd) {
    const char* const before = at_;
    bool found = false;
    at_ = from;
    while (!found && at_ < lineEnd) {
      const std::string_view word = nextWord();
      if (word.empty() || word.data() >= lineEnd) break;
      found = isFacet(word, lineEnd);
    }
    at_ = before;
    return found;
  }

  /// Whether a word begins a facet: "normal" or "outer loop" follow it on the line.
  bool isFacet(std::string_view word, const char* lineEnd) {
    if (!equalsStlWord(word, "facet")) return false;
    const char* const before = at_;
    const std::string_view next = nextWord();
    const std::string_view behind = nextWord();
    at_ = before;
    if (behind.empty() || behind.data() >= lineEnd) return false;
    const char* number = behind.data();
    double value = 0;
    const bool isNumber = text::scanNumber(number, behind.data() + behind.size(), value) ||
                          text::lowered(behind).find("nan") != std::string::npos;
    return equalsStlWord(next, "normal") ? isNumber
                                         : equalsStlWord(next, "outer") && equalsStlWord(behind, "loop");
  }

  /// Of a solid without facets that has one line with others.
  bool isEndOfSolid(std::string_view word, const char* lineEnd) {
    if (!equalsStlWord(word, "endsolid")) return false;
    return holdsFacet(at_, lineEnd) || (word.data() + word.size() >= lineEnd && !isFacetBehind(lineEnd));
  }

  bool isFacetBehind(const char* lineEnd) {
    const char* const before = at_;
    at_ = lineEnd;
    const bool isNext = equalsStlWord(nextWord(), "facet");
    at_ = before;
    return isNext;
  }

  /// The end of the line of a place, which a file of one line looks for once.
  const char* lineEndOf(const char* at) {
    if (lineBegin_ == nullptr || at < lineBegin_ || at > lineEnd_) {
      lineBegin_ = at;
      lineEnd_ = std::find(at, end_, '\n');
    }
    return lineEnd_;
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
      ARETE_CHECK(readFacet());
    }
  }

  /// The normal, which some programs leave out or write as "nan": zeros then.
  Vec3 readNormal() {
    std::array<double, 3> xyz{};
    std::size_t numbers = 0;
    bool isNormal = true, isFirst = true;
    const char* const lineEnd = lineEndOf(at_);
    for (;;) {
      const char* const before = at_;
      const std::string_view word = nextWord();
      if (word.empty() || word.data() >= lineEnd || equalsStlWord(word, "outer")) {
        at_ = before;
        break;
      }
      if (std::exchange(isFirst, false)) {
        isNormal = equalsStlWord(word, "normal");
        continue;
      }
      const char* from = word.data();
      double value = 0;
      isNormal = isNormal && numbers < 3 && text::scanNumber(from, word.data() + word.size(), value);
      if (isNormal) xyz[numbers++] = value;
    }
    isNormal = isNormal && numbers == 3;
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
    ARETE_CHECK(expect({"outer", "loop"}));
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      ARETE_CHECK(expect({"vertex"}));
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
  const char* lineBegin_ = nullptr;  // lineEndOf()
  const char* lineEnd_ = nullptr;
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
