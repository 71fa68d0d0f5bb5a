// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass over the lines; the first word of each is its card. Elements name nodes by number, and a node may
// come after the elements that name it, so numbers become indices at the end: by themselves where the nodes
// are numbered 1, 2, 3, ... as most programs do, by a sorted list otherwise.
//
// A 2DM does not say how long it is. Ours say "# generator arete" and end with "# end", so that a copy cut
// short is noticed. Readers that follow the format pass over lines whose card they do not know.
#include "io/mesh/2dm/mesh_2dm.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>
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

class Reader2dm {
 public:
  Reader2dm(const FileBytes& file, std::string path, const RunContext& context)
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
      const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
      line_ = at_;
      lineEnd_ = newline ? static_cast<const char*>(newline) : end_;
      if (const Status ok = readLine(); !ok) return tl::unexpected(ok.error());
      at_ = newline ? lineEnd_ + 1 : end_;
    }
    if (!isMesh_) return failure(ErrorCode::corrupt, "is no 2DM: it is empty", path_);
    if (isOurs_ && !hasEnd_)
      return failure(ErrorCode::corrupt, "is truncated: its last line, \"# end\", is missing", path_);
    if (!isOurs_ && result_.mesh.triangles.empty())
      return failure(ErrorCode::unsupported, "holds no element of three or four corners", path_);
    if (const Status ok = numbersToIndices(); !ok) return tl::unexpected(ok.error());
    return std::move(result_);
  }

 private:
  tl::unexpected<Error> corrupt(const char* place, std::string_view what) const {
    return failure(ErrorCode::corrupt, fmt::format("line {} {}", text::lineOf(begin_, place), what), path_);
  }

  /// The next word of the line; empty at its end.
  std::string_view nextWord() {
    while (at_ < lineEnd_ && text::isBlank(*at_)) ++at_;
    const char* from = at_;
    while (at_ < lineEnd_ && !text::isBlank(*at_)) ++at_;
    return {from, static_cast<std::size_t>(at_ - from)};
  }

  Status readLine() {
    const std::string_view card = nextWord();
    if (card.empty()) return {};
    if (!isMesh_ && card != "MESH2D") return corrupt(line_, "is not MESH2D, with which a 2DM begins");
    isMesh_ = true;
    if (card.front() == '#') {
      takeComment(std::string_view(card.data() + 1, static_cast<std::size_t>(lineEnd_ - card.data() - 1)));
      return {};
    }
    if (card == "ND") return readNode();
    if (card == "E3T") return readElement(3);
    if (card == "E4Q") return readElement(4);
    if (card == "E6T" || card == "E8Q" || card == "E9Q")
      return failure(ErrorCode::unsupported,
                     fmt::format("line {} is an element with curved sides ({}), which Arete does not read",
                                 text::lineOf(begin_, line_), card),
                     path_);
    for (const char c : card)
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'))
        return corrupt(line_,
                       fmt::format("begins with {}, which is no card of a 2DM", text::quotedToken(card)));
    return {};
  }

  bool nextNumber(std::uint32_t& number) {
    const std::string_view word = nextWord();
    const auto [behind, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && behind == word.data() + word.size() && !word.empty();
  }

  Status readNode() {
    std::uint32_t number = 0;
    if (!nextNumber(number)) return corrupt(line_, "is a node without a number of its own");
    std::array<double, 3> xyz;
    for (double& value : xyz) {
      const std::string_view word = nextWord();
      const char* from = word.data();
      if (word.empty() || !text::scanNumber(from, from + word.size(), value))
        return corrupt(line_, "is a node without three coordinates");
      if (!std::isfinite(value)) return corrupt(line_, "has a coordinate that is not finite");
    }
    auto& positions = result_.mesh.positions;
    areInOrder_ = areInOrder_ && number == positions.size() + 1;
    numbers_.push_back(number);
    positions.push_back({xyz[0], xyz[1], xyz[2]});
    return {};
  }

  Status readElement(int corners) {
    std::uint32_t number = 0;
    if (!nextNumber(number)) return corrupt(line_, "is an element without a number of its own");
    std::array<std::uint32_t, 4> nodes{};
    for (int k = 0; k < corners; ++k)
      if (!nextNumber(nodes[std::size_t(k)]))
        return corrupt(line_, fmt::format("is an element without {} nodes", corners));
    result_.mesh.triangles.push_back({nodes[0], nodes[1], nodes[2]});
    if (corners == 4) result_.mesh.triangles.push_back({nodes[0], nodes[2], nodes[3]});
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

  Status numbersToIndices() {
    if (numbers_.size() >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::unsupported, "holds more nodes than an index can name", path_);
    const auto count = static_cast<std::uint32_t>(numbers_.size());
    const auto missing = [&](std::size_t triangle, std::uint32_t number) {
      return failure(ErrorCode::corrupt,
                     fmt::format("triangle {} names node {}, which is not there", triangle, number), path_);
    };
    auto& triangles = result_.mesh.triangles;
    if (areInOrder_) {
      for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t& v : triangles[t]) {
          if (v < 1 || v > count) return missing(t, v);
          --v;
        }
      return {};
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> byNumber;
    byNumber.reserve(count);
    for (std::uint32_t v = 0; v < count; ++v) byNumber.emplace_back(numbers_[v], v);
    std::ranges::sort(byNumber);
    for (std::size_t i = 1; i < byNumber.size(); ++i)
      if (byNumber[i].first == byNumber[i - 1].first)
        return failure(ErrorCode::corrupt, fmt::format("there are two nodes {}", byNumber[i].first), path_);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::uint32_t& v : triangles[t]) {
        const auto found =
            std::ranges::lower_bound(byNumber, v, {}, &std::pair<std::uint32_t, std::uint32_t>::first);
        if (found == byNumber.end() || found->first != v) return missing(t, v);
        v = found->second;
      }
    return {};
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  const char* line_ = nullptr;
  const char* lineEnd_ = nullptr;
  std::string path_;
  const RunContext& context_;
  MeshFile result_;  // triangles hold the numbers of nodes until all are read
  std::vector<std::uint32_t> numbers_;
  bool areInOrder_ = true;
  bool isMesh_ = false, isOurs_ = false, hasEnd_ = false;
};

}  // namespace

Result<MeshFile> read2dm(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> file = FileBytes::read(path);
  if (!file) return tl::unexpected(file.error());
  return Reader2dm(*file, path.string(), context).read();
}

Status write2dm(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                const RunContext& context) {
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(fmt::format("MESH2D\n# {}\n", kGenerator));
  file->write(meshComments(options));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  char line[160];  // three doubles of at most 24 characters each and a number
  const auto writeUpTo = [&](const char* end) { file->write({line, static_cast<std::size_t>(end - line)}); };
  std::uint64_t number = 0;
  for (const auto& t : mesh.triangles) {
    if (progress.shouldStop()) return progress.interrupted();
    // The last column is the material.
    writeUpTo(fmt::format_to(line, FMT_COMPILE("E3T {} {} {} {} 1\n"), ++number, std::uint64_t{t[0]} + 1,
                             std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1));
  }
  number = 0;
  for (const Vec3& p : mesh.positions) {
    if (progress.shouldStop()) return progress.interrupted();
    writeUpTo(fmt::format_to(line, FMT_COMPILE("ND {} {} {} {}\n"), ++number, p.x, p.y, p.z));
  }
  file->write(fmt::format("# {}\n", kEnd));
  return file->finish();
}

}  // namespace arete
