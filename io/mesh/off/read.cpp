// SPDX-License-Identifier: GPL-3.0-or-later
//
// Word by word: keyword, counts, vertices, faces. Geomview reads words and cares for lines only where the
// colour of a face ends. Many files, however, have more values on the line of a vertex than their keyword
// states. So the lines are counted: if there is one for each vertex and face, a line is a record, and the
// rest of it is skipped; otherwise a vertex has as many values as the keyword says.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "io/file/file_bytes.h"
#include "io/file/text_scan.h"
#include "io/mesh/off/off.h"
#include "io/mesh/text_reader.h"

namespace arete {

namespace {

class OffReader final : public MeshTextReader {
 public:
  using MeshTextReader::MeshTextReader;

 private:
  enum class Stage { keyword, counts, vertices, faces, done };

  Status readLine() override {
    line_ = at();
    const char* const newline = lineEnd();
    wordsEnd_ = std::find(line_, newline, '#');
    if (const char* first = std::find_if_not(line_, newline, text::isBlank);
        first == wordsEnd_ && first < newline)
      takeComment(std::string_view(first + 1, static_cast<std::size_t>(newline - first - 1)));
    Status status;
    for (std::string_view word = nextWord(); status && !word.empty(); word = nextWord()) status = take(word);
    at() = newline;
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
      return unsupported("is a binary OFF, which Arete does not read");
    if (hasKeyword_ || (word.front() >= '0' && word.front() <= '9' && word.front() != '4')) {
      stage_ = Stage::counts;
      return takeCount(word);
    }
    const std::string upper = [&] {
      std::string letters(word);
      for (char& c : letters)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      return letters;
    }();
    const std::size_t off = upper.find("OFF");
    if (off == std::string::npos) {
      if (word.front() != '4') return corrupt(line_, "is not the first line of an OFF");
      stage_ = Stage::counts;
      return takeCount(word);
    }
    hasKeyword_ = true;
    const std::string_view before = word.substr(0, off), behind = word.substr(off + 3);
    if (before.find('4') != std::string_view::npos ||
        (before.find('n') != std::string_view::npos && word[off] == 'O'))
      return unsupported(fmt::format("is of the kind {}, whose vertices do not have three coordinates",
                                     text::quotedToken(word)));
    valuesOfVertex_ = 3;
    std::string_view rest = std::string_view(upper).substr(0, off);
    if (rest.starts_with("ST")) {
      valuesOfVertex_ += 2;
      rest.remove_prefix(2);
    }
    for (const char c : rest) {
      if (c != 'C' && c != 'N') return corrupt(line_, "is not the first line of an OFF");
      valuesOfVertex_ += c == 'C' ? 4 : 3;
    }
    if (behind.empty()) return {};
    stage_ = Stage::counts;
    return takeCount(behind);
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
          fmt::format("is truncated: {} vertices and {} faces do not fit into the {} bytes that are left",
                      vertices_, faceCount_, left),
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
    stage_ = vertices_ > 0 ? Stage::vertices : faceCount_ > 0 ? Stage::faces : Stage::done;
    return {};
  }

  Status takeVertexValue(std::string_view word) {
    double value = 0;
    const char* from = word.data();
    if (!text::scanNumber(from, word.data() + word.size(), value) || from != word.data() + word.size())
      return corrupt(line_, fmt::format("has {} where a number of vertex {} should be",
                                        text::quotedToken(word), mesh().mesh.positions.size()));
    if (valueCount_ < 3) xyz_[valueCount_] = value;
    ++valueCount_;
    if (valueCount_ == 3) {
      for (const double coordinate : xyz_)
        if (!std::isfinite(coordinate)) return corrupt(line_, "has a coordinate that is not finite");
      mesh().mesh.positions.push_back({xyz_[0], xyz_[1], xyz_[2]});
    }
    if (valueCount_ < (lineIsRecord_ ? 3 : valuesOfVertex_)) return {};
    valueCount_ = 0;
    if (lineIsRecord_) skipLine();
    if (mesh().mesh.positions.size() == vertices_) stage_ = faceCount_ > 0 ? Stage::faces : Stage::done;
    return {};
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
      corners_.push_back(static_cast<std::uint32_t>(number));
    }
    if (corners_.size() < cornersOfFace_) return {};
    inFace_ = false;
    skipLine();  // a colour
    if (corners_.size() < 3)
      ++smallFaces_;
    else
      faces().add(mesh().mesh, corners_);
    if (++facesRead_ == faceCount_) stage_ = Stage::done;
    return {};
  }

  Status finish() override {
    if (stage_ == Stage::keyword || stage_ == Stage::counts)
      return failure(ErrorCode::corrupt, "is not an OFF, or it ends before its counts of vertices and faces",
                     path());
    if (stage_ == Stage::vertices)
      return failure(
          ErrorCode::corrupt,
          fmt::format("is truncated: it has {} of {} vertices", mesh().mesh.positions.size(), vertices_),
          path());
    if (stage_ == Stage::faces)
      return failure(ErrorCode::corrupt,
                     fmt::format("is truncated: it has {} of {} faces", facesRead_, faceCount_), path());
    if (smallFaces_ > 0)
      mesh().warnings.push_back(
          fmt::format("{} faces of fewer than three corners are left out", smallFaces_));
    if (!isOurs() && mesh().mesh.triangles.empty())
      return unsupported("holds no face of three or more corners");
    return {};
  }

  const char* line_ = nullptr;
  const char* wordsEnd_ = nullptr;  // of the line: its end, or a comment
  Stage stage_ = Stage::keyword;
  bool hasKeyword_ = false, lineIsRecord_ = false, inFace_ = false;
  std::size_t valuesOfVertex_ = 3, valueCount_ = 0;
  std::vector<std::uint64_t> numbers_;
  std::uint64_t vertices_ = 0, faceCount_ = 0, facesRead_ = 0, smallFaces_ = 0, cornersOfFace_ = 0;
  std::array<double, 3> xyz_{};
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Result<MeshFile> readOff(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> file = FileBytes::readText(path);
  if (!file) return tl::unexpected(file.error());
  return OffReader(*file, path.string(), context).read();
}

}  // namespace arete
