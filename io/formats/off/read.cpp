// SPDX-License-Identifier: GPL-3.0-or-later
//
// Word by word: keyword, counts, vertices, faces. Geomview reads words and cares for lines only where the
// colour of a face ends. Many files, however, have more or fewer values on the line of a vertex than their
// keyword states. So the lines are counted: if there is one for each vertex and face, a line is a record, and
// what it has counts (io/formats/off/values.h); otherwise a vertex has as many values as the keyword says.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "io/formats/common/text_reader.h"
#include "io/formats/off/keyword.h"
#include "io/formats/off/off.h"
#include "io/formats/off/read_binary.h"
#include "io/formats/off/values.h"

namespace arete {

namespace {

class OffReader final : public MeshTextReader {
 public:
  using MeshTextReader::MeshTextReader;

 private:
  enum class Stage : std::uint8_t { keyword, counts, vertices, faces, done };
  /// Behind coordinates or corners that are kept: more than any kind of OFF has.
  static constexpr std::size_t kMostValues = 16;

  Status readLine() override {
    line_ = at();
    const char* const newline = lineEnd();
    wordsEnd_ = std::find(line_, newline, '#');
    if (const char* first = std::find_if_not(line_, newline, text::isBlank);
        first == wordsEnd_ && first < newline) {
      const std::string_view comment(first + 1, static_cast<std::size_t>(newline - first - 1));
      takeComment(comment);
      withoutAlpha_ = withoutAlpha_ || comment.find(kOffWithoutAlpha) == 1;
    }
    Status status;
    for (std::string_view word = nextWord(); status && !word.empty(); word = nextWord()) status = take(word);
    at() = newline;
    if (stage_ == Stage::vertices && lineIsRecord_ && valueCount_ >= 3) endVertex();
    // The number of edges may be missing, or stand on the next line.
    if (status && stage_ == Stage::counts && numbers_.size() == 2 && !nextLineIsOneWord())
      status = beginVertices();
    return status;
  }

  /// The next word of the line; empty at its end.
  std::string_view nextWord() {
    const char*& p = at();
    while (p < wordsEnd_ && text::isBlank(*p)) ++p;
    const char* from = p;
    while (p < wordsEnd_ && !text::isBlank(*p)) ++p;
    return {from, static_cast<std::size_t>(p - from)};
  }
  void skipLine() { at() = wordsEnd_; }

  Status take(std::string_view word) {
    switch (stage_) {
      case Stage::keyword:
        return takeKeyword(word);
      case Stage::counts:
        return takeCount(word);
      case Stage::vertices:
        return takeVertexValue(word);
      case Stage::faces:
        return takeFaceValue(word);
      case Stage::done:
        skipLine();
        return {};
    }
    return {};
  }

  /// "OFF" with letters before it that say what else a vertex has, or digits behind it, or nothing at all.
  Status takeKeyword(std::string_view word) {
    if (hasKeyword_ && text::lowered(word) == "binary")
      return unsupported("is a binary OFF whose first line has more than the keyword and \"BINARY\"");
    if (hasKeyword_ || (word.front() >= '0' && word.front() <= '9' && word.front() != '4')) {
      stage_ = Stage::counts;
      return takeCount(word);
    }
    const Result<OffKeyword> keyword = offKeywordOf(word);
    if (!keyword && keyword.error().code == ErrorCode::unsupported)
      return unsupported(keyword.error().message);
    if (!keyword && word.front() != '4') return corrupt(line_, keyword.error().message);
    if (keyword) {
      hasKeyword_ = true;
      keyword_ = *keyword;
      if (keyword->behind.empty()) return {};
    }
    stage_ = Stage::counts;
    return takeCount(keyword ? keyword->behind : word);
  }

  bool wholeNumber(std::string_view word, std::uint64_t& number) const {
    const auto [behind, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && behind == word.data() + word.size();
  }

  Status takeCount(std::string_view word) {
    std::uint64_t number = 0;
    if (!wholeNumber(word, number))
      return corrupt(line_, fmt::format("has {} where the counts of vertices and faces should be",
                                        text::quotedToken(word)));
    numbers_.push_back(number);
    return numbers_.size() == 3 ? beginVertices() : Status();
  }

  bool nextLineIsOneWord() const {
    const auto isBlankOrEnd = [](char c) { return text::isSpace(c); };
    const char* from = std::find_if_not(lineEndOf(line_), end(), isBlankOrEnd);
    const char* behind = std::find_if(from, end(), isBlankOrEnd);
    return from < end() && *from != '#' &&
           std::find_if_not(behind, lineEndOf(from), text::isBlank) == lineEndOf(from);
  }
  const char* lineEndOf(const char* from) const { return std::find(from, end(), '\n'); }

  Status beginVertices() {
    vertices_ = numbers_[0];
    faceCount_ = numbers_[1];
    const auto left = static_cast<std::uint64_t>(end() - at());
    // A vertex takes three numbers and three blanks, a face one and one.
    if (vertices_ > left / 5 || faceCount_ > left)
      return failure(
          ErrorCode::corrupt,
          fmt::format("is truncated: {} and {} do not fit into the {} left",
                      counted(vertices_, "vertex", "vertices"), counted(faceCount_, "face", "faces"),
                      counted(left, "byte that is", "bytes that are")),
          path());
    if (vertices_ >= std::numeric_limits<std::uint32_t>::max())
      return unsupported("holds more vertices than an index can name");
    mesh().mesh.positions.reserve(vertices_);
    mesh().mesh.triangles.reserve(faceCount_);
    std::uint64_t lines = 0;
    for (const char* from = lineEndOf(at()); from < end() && lines < vertices_ + faceCount_;) {
      const char* const to = lineEndOf(++from);
      const char* const first = std::find_if_not(from, to, text::isBlank);
      lines += first < to && *first != '#' ? 1 : 0;
      from = to;
    }
    lineIsRecord_ = lines >= vertices_ + faceCount_;
    behind_.emplace(keyword_);
    stage_ = vertices_ > 0 ? Stage::vertices : faceCount_ > 0 ? Stage::faces : Stage::done;
    return {};
  }

  Status takeVertexValue(std::string_view word) {
    OffNumber number;
    if (!numberOf(word, number)) {
      if (lineIsRecord_ && valueCount_ >= 3) {
        skipLine();
        return {};
      }
      return corrupt(line_, fmt::format("has {} where a number of vertex {} should be",
                                        text::quotedToken(word), mesh().mesh.positions.size()));
    }
    if (valueCount_ < 3)
      xyz_[valueCount_] = number.value;
    else if (more_.size() < kMostValues)
      more_.push_back(number);
    ++valueCount_;
    if (valueCount_ == 3) {
      // No fault unless a face uses it.
      if (!std::isfinite(xyz_[0]) || !std::isfinite(xyz_[1]) || !std::isfinite(xyz_[2]))
        unusable_.emplace(mesh().mesh.positions.size(), line_);
      mesh().mesh.positions.push_back({xyz_[0], xyz_[1], xyz_[2]});
    }
    if (!lineIsRecord_ && valueCount_ == 3 + keyword_.values()) endVertex();
    return {};
  }

  void endVertex() {
    behind_->add(more_);
    more_.clear();
    valueCount_ = 0;
    if (mesh().mesh.positions.size() == vertices_) stage_ = faceCount_ > 0 ? Stage::faces : Stage::done;
  }

  static bool numberOf(std::string_view word, OffNumber& number) {
    const char* from = word.data();
    const char* const behind = from + word.size();
    number.isFloat = word.find_first_of(".eEnN") != std::string_view::npos;
    return text::scanNumber(from, behind, number.value) && from == behind;
  }

  Status takeFaceValue(std::string_view word) {
    std::uint64_t number = 0;
    if (!wholeNumber(word, number))
      return corrupt(line_, fmt::format("has {} where a whole number of face {} should be",
                                        text::quotedToken(word), facesRead_));
    if (!inFace_) {
      if (number > static_cast<std::uint64_t>(end() - at()))
        return corrupt(line_, fmt::format("is a face of {} corners, more than the file can hold", number));
      inFace_ = true;
      cornersOfFace_ = number;
      corners_.clear();
    } else {
      if (number >= vertices_) return corrupt(line_, fmt::format("names vertex {} of {}", number, vertices_));
      if (const auto found = unusable_.find(number); found != unusable_.end())
        return corrupt(found->second, "has a coordinate that is not finite");
      corners_.push_back(static_cast<std::uint32_t>(number));
    }
    if (corners_.size() < cornersOfFace_) return {};
    inFace_ = false;
    takeColor();
    // A face of fewer corners has no triangles, but counts.
    if (corners_.size() < 3) ++smallFaces_;
    faces().add(mesh().mesh, corners_);
    if (++facesRead_ == faceCount_) stage_ = Stage::done;
    return {};
  }

  /// What a line has behind the corners: three or four numbers are a colour, one is an index into a map of
  /// colours that the file does not have.
  void takeColor() {
    more_.clear();
    OffNumber number;
    for (std::string_view word = nextWord(); !word.empty() && numberOf(word, number); word = nextWord())
      if (more_.size() < kMostValues) more_.push_back(number);
    skipLine();
    if (more_.size() == 3 || more_.size() == 4)
      colors_.add(facesRead_, more_);
    else if (more_.size() == 1)
      ++indexedFaces_;
    else if (!more_.empty())
      ++oddFaces_;
    more_.clear();
  }

  Status finish() override {
    if (stage_ == Stage::keyword || stage_ == Stage::counts)
      return failure(ErrorCode::corrupt, "is not an OFF, or it ends before its counts of vertices and faces",
                     path());
    if (stage_ == Stage::vertices)
      return failure(ErrorCode::corrupt,
                     fmt::format("is truncated: it has {} of {}", mesh().mesh.positions.size(),
                                 counted(vertices_, "vertex", "vertices")),
                     path());
    if (stage_ == Stage::faces)
      return failure(
          ErrorCode::corrupt,
          fmt::format("is truncated: it has {} of {}", facesRead_, counted(faceCount_, "face", "faces")),
          path());
    if (mesh().mesh.triangles.empty() && !unusable_.empty())
      return corrupt(unusable_.begin()->second, "has a coordinate that is not finite");
    if (smallFaces_ > 0)
      mesh().warnings.push_back(
          {WarningCode::omitted, counted(smallFaces_, "face of fewer than three corners is left out",
                                         "faces of fewer than three corners are left out")});
    if (!isOurs() && mesh().mesh.triangles.empty())
      return unsupported("holds no face of three or more corners");
    if (behind_) behind_->finish(mesh().mesh, isOurs(), withoutAlpha_, mesh().warnings);
    takeColors();
    return {};
  }

  /// Listed by face (io/formats/common/faces.h).
  void takeColors() {
    if (indexedFaces_ > 0)
      mesh().warnings.push_back(
          {WarningCode::omitted,
           counted(indexedFaces_, "face has the index of a colour in a map, which is left out",
                   "faces have the index of a colour in a map, which is left out")});
    if (oddFaces_ > 0)
      mesh().warnings.push_back(
          {WarningCode::omitted,
           counted(oddFaces_, "face has values behind its corners that are no colour; these are left out",
                   "faces have values behind their corners that are no colour; these are left out")});
    if (colors_.isEmpty()) return;
    if (const std::size_t missing = colors_.missing(facesRead_); missing > 0)
      mesh().warnings.push_back(
          {WarningCode::completed, counted(missing, "face has no colour, others have; it is white",
                                           "faces have no colour, others have; they are white")});
    mesh().mesh.triangleAttributes.push_back(colors_.attribute(facesRead_, isOurs()));
  }

  const char* line_ = nullptr;
  const char* wordsEnd_ = nullptr;  // of the line: its end, or a comment
  Stage stage_ = Stage::keyword;
  bool hasKeyword_ = false, lineIsRecord_ = false, inFace_ = false, withoutAlpha_ = false;
  OffKeyword keyword_;
  std::size_t valueCount_ = 0;  // of the vertex that is read
  std::vector<std::uint64_t> numbers_;
  std::uint64_t vertices_ = 0, faceCount_ = 0, facesRead_ = 0, smallFaces_ = 0, cornersOfFace_ = 0;
  std::uint64_t indexedFaces_ = 0, oddFaces_ = 0;
  std::array<double, 3> xyz_{};
  std::vector<OffNumber> more_;  // behind the coordinates of a vertex or the corners of a face
  std::optional<OffVertices> behind_;
  OffColors colors_;                               // of faces
  std::map<std::uint64_t, const char*> unusable_;  // by vertex: lines with numbers that are not finite
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Result<MeshFile> readOff(const std::filesystem::path& path, const RunContext& context) {
  ARETE_TRY(FileBytes file, FileBytes::read(path));
  if (const auto begin = binaryOffBegin(file.view()))
    return readBinaryOff(file.view(), *begin, path.string(), context);
  ARETE_CHECK(file.decodeText(path));
  return OffReader(file, path.string(), context).read();
}

}  // namespace arete
