// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every read is checked against the end of the file, and the counts before anything is reserved for them.
#include "io/formats/off/read_binary.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/counted.h"
#include "io/files/text_scan.h"
#include "io/formats/common/faces.h"
#include "io/formats/off/values.h"
#include "io/geo/crs/local_origin.h"

namespace arete {
namespace {

constexpr std::size_t kRecordsPerCancelCheck = 1 << 16, kWord = 4;

class BinaryOffReader {
 public:
  BinaryOffReader(std::string_view file, const OffBinaryBegin& begin, const std::string& path,
                  const RunContext& context)
      : file_(file), at_(begin.size), keyword_(begin.keyword), path_(path), context_(context) {}

  Result<MeshFile> read() {
    if (!has(3)) return corrupt("is truncated: it ends in its counts of vertices, faces and edges");
    const std::int32_t vertices = whole(), faces = whole();
    whole();  // edges: programs write 0
    if (vertices < 0 || faces < 0)
      return corrupt(fmt::format("has counts below 0: {} vertices, {} faces", vertices, faces));
    const std::uint64_t perVertex = 3 + keyword_.values();
    const std::uint64_t left = (file_.size() - at_) / kWord;
    if (std::uint64_t(vertices) * perVertex + 2 * std::uint64_t(faces) > left)
      return corrupt(fmt::format("is truncated: {} and {} do not fit into the {} left",
                                 counted(std::size_t(vertices), "vertex", "vertices"),
                                 counted(std::size_t(faces), "face", "faces"),
                                 counted(file_.size() - at_, "byte that is", "bytes that are")));
    ARETE_CHECK(readVertices(static_cast<std::uint32_t>(vertices)));
    ARETE_CHECK(readFaces(static_cast<std::uint32_t>(faces)));
    // Text that ends in a line feed is what some programs put behind it.
    const std::string_view rest = file_.substr(at_);
    if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos)
      return corrupt(fmt::format("has {} bytes behind the {} faces that it states", rest.size(), faces));
    return finish(static_cast<std::uint32_t>(faces));
  }

 private:
  tl::unexpected<Error> corrupt(std::string message) const {
    return failure(ErrorCode::corrupt, std::move(message), path_);
  }
  // The file is a sequence of words of four bytes, the most significant first.
  bool has(std::uint64_t words) const { return (file_.size() - at_) / kWord >= words; }

  std::uint32_t word() {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kWord; ++i) bits = bits << 8 | static_cast<unsigned char>(file_[at_ + i]);
    at_ += kWord;
    return bits;
  }
  std::int32_t whole() { return std::bit_cast<std::int32_t>(word()); }
  double number() { return double{std::bit_cast<float>(word())}; }

  Status reportAndCheck(std::size_t i) const {
    if (i % kRecordsPerCancelCheck > 0) return {};
    context_.report("reading the mesh", double(at_) / double(file_.size()));
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
    return {};
  }

  // A vertex has three coordinates and, after them, as many values as the keyword announces.
  Status readVertices(std::uint32_t count) {
    vertices_ = count;
    result_.mesh.positions.reserve(count);
    behind_.emplace(keyword_);
    std::vector<OffNumber> values(keyword_.values());
    for (std::uint32_t v = 0; v < count; ++v) {
      ARETE_CHECK(reportAndCheck(v));
      Vec3 p;
      for (double* const value : {&p.x, &p.y, &p.z}) *value = number();
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        return corrupt(fmt::format("vertex {} has a coordinate that is not finite", v));
      largest_ = {std::max(largest_.x, std::abs(p.x)), std::max(largest_.y, std::abs(p.y)),
                  std::max(largest_.z, std::abs(p.z))};
      result_.mesh.positions.push_back(p);
      for (OffNumber& value : values) value = {number(), true};
      behind_->add(values);
    }
    return {};
  }

  /// Corners and colours vary in number from face to face, so each is checked against the rest of the file.
  Status readFaces(std::uint32_t count) {
    result_.mesh.triangles.reserve(count);
    std::vector<std::uint32_t> corners;
    std::vector<OffNumber> color;
    for (std::uint32_t f = 0; f < count; ++f) {
      ARETE_CHECK(reportAndCheck(f));
      if (!has(1))
        return corrupt(fmt::format("is truncated: it has {} of {}", f, counted(count, "face", "faces")));
      const std::int32_t size = whole();
      if (size < 0 || !has(std::uint64_t(size) + 1))
        return corrupt(fmt::format("face {} has {} corners, more than the file can hold", f, size));
      corners.clear();
      for (std::int32_t k = 0; k < size; ++k) {
        const std::int32_t corner = whole();
        if (corner < 0 || std::uint32_t(corner) >= vertices_)
          return corrupt(fmt::format("face {} names vertex {} of {}", f, corner, vertices_));
        corners.push_back(static_cast<std::uint32_t>(corner));
      }
      const std::int32_t parts = whole();
      if (parts < 0 || parts > 4)
        return corrupt(fmt::format("face {} has a color of {} parts, where 0 to 4 can be", f, parts));
      if (!has(std::uint64_t(parts))) return corrupt(fmt::format("is truncated in the color of face {}", f));
      color.clear();
      for (std::int32_t k = 0; k < parts; ++k) {
        // The index into a map of colors is a whole number.
        const double value = parts == 1 ? double(whole()) : number();
        color.push_back({value, true});
      }
      if (parts >= 3) colors_.add(f, color);
      indexed_ += parts == 1 ? 1 : 0;
      odd_ += parts == 2 ? 1 : 0;
      small_ += corners.size() < 3 ? 1 : 0;
      faces_.add(result_.mesh, corners);
    }
    return {};
  }

  Result<MeshFile> finish(std::uint32_t faces) {
    const auto warn = [&](std::uint64_t count, const char* one, const char* many) {
      if (count > 0) result_.warnings.push_back({WarningCode::omitted, counted(count, one, many)});
    };
    warn(small_, "face of fewer than three corners is left out",
         "faces of fewer than three corners are left out");
    if (result_.mesh.triangles.empty())
      return failure(ErrorCode::unsupported, "holds no face of three or more corners", path_);
    behind_->finish(result_.mesh, true, false, result_.warnings);
    warn(indexed_, "face has the index of a colour in a map, which is left out",
         "faces have the index of a colour in a map, which is left out");
    warn(odd_, "face has values behind its corners that are no colour; these are left out",
         "faces have values behind their corners that are no colour; these are left out");
    if (!colors_.isEmpty()) {
      warn(colors_.missing(faces), "face has no colour, others have; it is white",
           "faces have no colour, others have; they are white");
      result_.mesh.triangleAttributes.push_back(colors_.attribute(faces, true));
    }
    result_.frame.coordinates = "float32";
    result_.frame.rounding = {float32Rounding(largest_.x, 0), float32Rounding(largest_.y, 0),
                              float32Rounding(largest_.z, 0)};
    if (const Status ok = faces_.finish(result_, context_); !ok)
      return failure(ok.error().code, ok.error().message, path_);
    return std::move(result_);
  }

  MeshFile result_;
  std::string_view file_;
  std::size_t at_;
  OffKeyword keyword_;
  const std::string& path_;
  const RunContext& context_;
  std::uint32_t vertices_ = 0;
  Vec3 largest_;
  std::optional<OffVertices> behind_;
  OffColors colors_;
  MeshFaces faces_;
  std::uint64_t small_ = 0, indexed_ = 0, odd_ = 0;
};

}  // namespace

std::optional<OffBinaryBegin> binaryOffBegin(std::string_view file) {
  constexpr std::size_t kLongest = 64;
  std::size_t end = file.substr(0, kLongest).find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  std::string_view line = file.substr(0, end);
  const auto takeWord = [&] {
    while (!line.empty() && text::isBlank(line.front())) line.remove_prefix(1);
    std::size_t size = 0;
    while (size < line.size() && !text::isBlank(line[size])) ++size;
    const std::string_view word = line.substr(0, size);
    line.remove_prefix(size);
    return word;
  };
  const std::string_view first = takeWord(), second = takeWord(), third = takeWord();
  if (text::lowered(second) != "binary" || !third.empty()) return std::nullopt;
  const Result<OffKeyword> keyword = offKeywordOf(first);
  if (!keyword || !keyword->behind.empty()) return std::nullopt;
  return OffBinaryBegin{*keyword, end + 1};
}

Result<MeshFile> readBinaryOff(std::string_view file, const OffBinaryBegin& begin, const std::string& path,
                               const RunContext& context) {
  return BinaryOffReader(file, begin, path, context).read();
}

}  // namespace arete
