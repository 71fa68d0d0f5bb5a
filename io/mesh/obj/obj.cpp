// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass over the text, line by line; "v" and "f" lines are scanned by hand, other lines are passed over
// once their first word looks like a word. A line that ends in a backslash goes on in the next (for "v" and
// "f" only: in comments and file names a backslash is a backslash). A face may name vertices that come later,
// so the largest index is remembered with its place and judged at the end.
//
// An OBJ does not say how long it is. Ours begin with "# generator arete" and end with "# end", so that a
// copy cut short is noticed.
#include "io/mesh/obj/obj.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "io/file/file_bytes.h"
#include "io/file/file_writer.h"
#include "io/file/text_scan.h"
#include "io/file/write_progress.h"
#include "io/mesh/comments.h"

namespace arete {

namespace {

constexpr std::string_view kGenerator = "generator arete", kEnd = "end";
constexpr std::size_t kLinesPerCancelCheck = 1 << 16;

class ObjReader {
 public:
  ObjReader(const FileBytes& file, std::string path, const RunContext& context)
      : begin_(file.begin()),
        at_(file.begin()),
        end_(file.end()),
        path_(std::move(path)),
        context_(context) {}

  Result<MeshFile> read() {
    if (end_ - at_ >= 3 && std::string_view(at_, 3) == "\xEF\xBB\xBF") at_ += 3;
    for (std::size_t line = 0; at_ < end_; ++line) {
      if (line % kLinesPerCancelCheck == 0) {
        context_.report("reading the mesh", double(at_ - begin_) / double(end_ - begin_));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
      }
      if (const Status ok = readLine(); !ok) return tl::unexpected(ok.error());
    }
    if (const Status ok = checkWhole(); !ok) return tl::unexpected(ok.error());
    return std::move(result_);
  }

 private:
  tl::unexpected<Error> corrupt(const char* place, std::string_view what) const {
    return failure(ErrorCode::corrupt, fmt::format("line {} {}", text::lineOf(begin_, place), what), path_);
  }

  Status readLine() {
    while (at_ < end_ && text::isBlank(*at_)) ++at_;
    if (at_ == end_) return {};
    if (*at_ == '\n') {
      ++at_;
      return {};
    }
    const char* word = at_;
    if (*at_ == '#') {
      toLineEnd();
      takeComment(std::string_view(word + 1, static_cast<std::size_t>(at_ - word - 1)));
      return {};
    }
    while (at_ < end_ && !text::isSpace(*at_)) ++at_;
    const std::string_view keyword(word, static_cast<std::size_t>(at_ - word));
    if (keyword == "v") return readVertex(word);
    if (keyword == "f") return readFace(word);
    for (const char c : keyword)
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'))
        return corrupt(word,
                       fmt::format("begins with {}, which is no OBJ keyword", text::quotedToken(keyword)));
    toLineEnd();
    return {};
  }

  void toLineEnd() {
    const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    at_ = newline ? static_cast<const char*>(newline) : end_;
  }

  /// To the next word of the line. False at its end.
  bool toNextWord() {
    while (at_ < end_) {
      if (text::isBlank(*at_)) {
        ++at_;
        continue;
      }
      if (*at_ == '\\') {
        const char* next = at_ + 1;
        if (next < end_ && *next == '\r') ++next;
        if (next < end_ && *next == '\n') {
          at_ = next + 1;
          continue;
        }
      }
      // Some writers put comments behind the numbers.
      return *at_ != '\n' && *at_ != '#';
    }
    return false;
  }

  Status readVertex(const char* line) {
    double xyz[3];
    for (double& value : xyz)
      if (!toNextWord() || !text::scanNumber(at_, end_, value))
        return corrupt(line, "is a vertex without three numbers");
    for (const double value : xyz)
      if (!std::isfinite(value)) return corrupt(line, "has a coordinate that is not finite");
    result_.mesh.positions.push_back({xyz[0], xyz[1], xyz[2]});
    // A weight or a colour may follow.
    for (double ignored; toNextWord();)
      if (!text::scanNumber(at_, end_, ignored))
        return corrupt(line, "is a vertex with something that is no number");
    toLineEnd();
    return {};
  }

  Status readFace(const char* line) {
    std::uint32_t first = 0, before = 0;
    std::size_t corners = 0;
    for (; toNextWord(); ++corners) {
      std::int64_t index = 0;
      const auto [behind, error] = std::from_chars(at_, end_, index);
      if (error != std::errc{}) return corrupt(line, "is a face with a corner that is no number");
      at_ = behind;
      while (at_ < end_ && (*at_ == '/' || *at_ == '-' || (*at_ >= '0' && *at_ <= '9'))) ++at_;
      if (at_ < end_ && !text::isSpace(*at_))
        return corrupt(line, "is a face with a corner that is not of the form a/b/c");
      const auto known = static_cast<std::int64_t>(result_.mesh.positions.size());
      if (index < 0) index += known + 1;
      if (index < 1 || index > std::int64_t(std::numeric_limits<std::uint32_t>::max()))
        return corrupt(line, "is a face that names a vertex that cannot be");
      if (index > largestIndex_) {
        largestIndex_ = index;
        largestIndexLine_ = line;
      }
      const auto vertex = static_cast<std::uint32_t>(index - 1);
      if (corners == 0) first = vertex;
      if (corners >= 2) result_.mesh.triangles.push_back({first, before, vertex});
      before = vertex;
    }
    if (corners < 3) return corrupt(line, fmt::format("is a face of {} corners", corners));
    toLineEnd();
    return {};
  }

  void takeComment(std::string_view comment) {
    while (!comment.empty() && text::isBlank(comment.back())) comment.remove_suffix(1);
    if (!comment.empty() && comment.front() == ' ') comment.remove_prefix(1);
    isOurs_ = isOurs_ || comment == kGenerator;
    hasEnd_ = hasEnd_ || comment == kEnd;
    const auto take = [&](std::string_view key, std::string& value) {
      if (comment.size() > key.size() && comment.starts_with(key)) value = comment.substr(key.size());
    };
    take("crs ", result_.crsWkt);
    take("vertical_unit ", result_.verticalUnit);
  }

  Status checkWhole() const {
    const TriangleMesh& mesh = result_.mesh;
    if (largestIndex_ > std::int64_t(mesh.positions.size()))
      return corrupt(largestIndexLine_,
                     fmt::format("names vertex {} of {}", largestIndex_, mesh.positions.size()));
    if (isOurs_ && !hasEnd_)
      return failure(ErrorCode::corrupt, "is truncated: its last line, \"# end\", is missing", path_);
    if (!isOurs_ && mesh.positions.empty()) return failure(ErrorCode::corrupt, "holds no vertex", path_);
    if (!isOurs_ && mesh.triangles.empty()) return failure(ErrorCode::unsupported, "holds no face", path_);
    if (mesh.positions.size() >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::unsupported, "holds more vertices than an index can name", path_);
    return {};
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  std::string path_;
  const RunContext& context_;
  MeshFile result_;
  std::int64_t largestIndex_ = 0;
  const char* largestIndexLine_ = nullptr;
  bool isOurs_ = false, hasEnd_ = false;
};

}  // namespace

Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> file = FileBytes::read(path);
  if (!file) return tl::unexpected(file.error());
  return ObjReader(*file, path.string(), context).read();
}

Status writeObj(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                const RunContext& context) {
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(fmt::format("# {}\n", kGenerator));
  file->write(meshComments(options));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[128];  // three doubles of at most 24 characters each
  const auto writeUpTo = [&](const char* end) { file->write({line, static_cast<std::size_t>(end - line)}); };
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("v {} {} {}\n"), p.x, p.y, p.z));
  }
  for (const auto& t : mesh.triangles) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("f {} {} {}\n"), std::uint64_t{t[0]} + 1,
                             std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1));
  }
  file->write(fmt::format("# {}\n", kEnd));
  return file->finish();
}

}  // namespace arete
