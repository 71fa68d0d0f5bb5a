// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file is binary if its size is the one that its triangle count implies. Otherwise it is ASCII if it begins
// with "solid" (any case, after blanks) and its start is text; binary headers may begin with that word, but
// bytes that no text has follow. Otherwise it is binary: with bytes to spare, which are left out with a
// warning, or truncated.
//
// ASCII is read word by word: facets of exactly three vertices between "solid" and "endsolid". The rest of
// the lines of these two is a name. Several solids become one mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include "io/crs/local_origin.h"
#include "io/file/file_bytes.h"
#include "io/file/text_decoder.h"
#include "io/file/text_scan.h"
#include "io/mesh/stl/stl.h"
#include "io/mesh/vertex_welder.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

constexpr std::size_t kHeaderSize = 80, kPreambleSize = 84, kRecordSize = 50, kNormalSize = 12;
constexpr std::size_t kTrianglesPerCancelCheck = 1 << 16;
/// A vertex of a TIN is in six triangles on average.
constexpr std::size_t kTrianglesPerVertex = 2;
constexpr std::uint64_t kMostTriangles = std::numeric_limits<std::uint32_t>::max() / 3;
/// Bytes at the start of a file that show whether it is a text.
constexpr std::size_t kProbe = 4096;
constexpr std::string_view kOriginKey = "arete origin ";

bool equalsWord(std::string_view a, std::string_view lower) {
  return std::ranges::equal(a, lower,
                            [](char c, char d) { return (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) == d; });
}

std::uint32_t binaryCount(std::string_view file) {
  std::uint32_t count = 0;
  std::memcpy(&count, file.data() + kHeaderSize, sizeof count);
  return count;
}

std::uint64_t binarySize(std::uint32_t count) {
  return kPreambleSize + std::uint64_t{count} * kRecordSize;
}

bool isAscii(std::string_view file) {
  const std::string_view start = file.substr(0, kProbe);
  while (!file.empty() && text::isSpace(file.front())) file.remove_prefix(1);
  const bool beginsWithSolid =
      file.size() > 5 && equalsWord(file.substr(0, 5), "solid") && text::isSpace(file[5]);
  return beginsWithSolid && std::ranges::none_of(start, [](char c) {
           return static_cast<unsigned char>(c) < 32 && !text::isSpace(c);
         });
}

/// The largest |coordinate| of each axis so far, before the origin is added.
struct LargestAbsolute {
  Vec3 of;
  void take(const Vec3& p) {
    of = {std::max(of.x, std::abs(p.x)), std::max(of.y, std::abs(p.y)), std::max(of.z, std::abs(p.z))};
  }
  Vec3 rounding(const Vec3& origin) const {
    return {float32Rounding(of.x, origin.x), float32Rounding(of.y, origin.y),
            float32Rounding(of.z, origin.z)};
  }
};

class BinaryStlReader {
 public:
  BinaryStlReader(std::string_view file, std::uint32_t count, std::string path, const RunContext& context)
      : file_(file), count_(count), path_(std::move(path)), context_(context) {}

  Result<MeshFile> read() {
    if (const Status ok = takeOrigin(); !ok) return tl::unexpected(ok.error());
    if (count_ == 0 && !result_.frame.origin)
      return failure(ErrorCode::unsupported, "holds no triangle", path_);
    if (count_ > kMostTriangles)
      return failure(ErrorCode::unsupported, "holds more triangles than an index can name", path_);
    const Vec3 origin = result_.frame.origin.value_or(Vec3{});
    VertexWelder welder(count_ / kTrianglesPerVertex);
    LargestAbsolute largest;
    result_.mesh.triangles.resize(count_);
    const char* at = file_.data() + kPreambleSize + kNormalSize;
    for (std::uint32_t t = 0; t < count_; ++t, at += kRecordSize) {
      if (t % kTrianglesPerCancelCheck == 0) {
        context_.report("reading the mesh", double(t) / double(count_));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
      }
      std::array<std::array<float, 3>, 3> corners;
      std::memcpy(&corners, at, sizeof corners);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 local{corners[k][0], corners[k][1], corners[k][2]};
        const Vec3 p{origin.x + local.x, origin.y + local.y, origin.z + local.z};
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
          return failure(ErrorCode::corrupt,
                         fmt::format("triangle {} of {} has a coordinate that is not finite", t, count_),
                         path_);
        largest.take(local);
        result_.mesh.triangles[t][k] = welder.add(p);
      }
    }
    result_.mesh.positions = welder.take();
    result_.frame.rounding = largest.rounding(origin);
    return std::move(result_);
  }

 private:
  Status takeOrigin() {
    result_.frame.coordinates = "float32";
    std::string_view header = file_.substr(0, kHeaderSize);
    if (!header.starts_with(kOriginKey)) return {};
    const char* at = header.data() + kOriginKey.size();
    const char* const end = header.data() + header.size();
    std::array<double, 3> xyz;
    for (double& value : xyz) {
      while (at < end && text::isBlank(*at)) ++at;
      if (at == end || !text::scanNumber(at, end, value) || !std::isfinite(value))
        return failure(ErrorCode::corrupt, "the header has \"arete origin\" without three numbers", path_);
    }
    result_.frame = {.coordinates = "float32 relative to the origin", .origin = Vec3{xyz[0], xyz[1], xyz[2]}};
    return {};
  }

  std::string_view file_;
  std::uint32_t count_;
  std::string path_;
  const RunContext& context_;
  MeshFile result_;
};

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view file, std::string path, const RunContext& context)
      : begin_(file.data()),
        at_(file.data()),
        end_(file.data() + file.size()),
        path_(std::move(path)),
        context_(context) {}

  Result<MeshFile> read() {
    for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
      if (!equalsWord(word, "solid")) return corrupt(word, "where \"solid\" should be");
      toLineEnd();
      if (const Status ok = readFacets(); !ok) return tl::unexpected(ok.error());
      toLineEnd();
    }
    if (result_.mesh.triangles.empty()) return failure(ErrorCode::unsupported, "holds no facet", path_);
    result_.mesh.positions = welder_.take();
    result_.frame.coordinates = "text";
    result_.frame.rounding = largest_.rounding({});
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
  void toLineEnd() {
    while (at_ < end_ && *at_ != '\n') ++at_;
  }

  tl::unexpected<Error> corrupt(std::string_view word, std::string_view what) const {
    if (word.empty())
      return failure(ErrorCode::corrupt, "is truncated: it ends before its last line, \"endsolid\"", path_);
    return failure(
        ErrorCode::corrupt,
        fmt::format("line {} has {} {}", text::lineOf(begin_, word.data()), text::quotedToken(word), what),
        path_);
  }

  Status expect(std::initializer_list<std::string_view> words) {
    for (const std::string_view expected : words)
      if (const std::string_view word = nextWord(); !equalsWord(word, expected))
        return corrupt(word, fmt::format("where \"{}\" should be", expected));
    return {};
  }

  Status readFacets() {
    for (;;) {
      const std::string_view word = nextWord();
      if (equalsWord(word, "endsolid")) return {};
      if (!equalsWord(word, "facet")) return corrupt(word, "where \"facet\" or \"endsolid\" should be");
      if (Status ok = readFacet(); !ok) return ok;
    }
  }

  Status readFacet() {
    auto& triangles = result_.mesh.triangles;
    if (triangles.size() % kTrianglesPerCancelCheck == 0) {
      context_.report("reading the mesh", double(at_ - begin_) / double(end_ - begin_));
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
    }
    if (triangles.size() == kMostTriangles)
      return failure(ErrorCode::unsupported, "holds more triangles than an index can name", path_);
    toLineEnd();  // the normal, which some programs write as "nan"
    if (Status ok = expect({"outer", "loop"}); !ok) return ok;
    std::array<std::uint32_t, 3> triangle;
    for (std::uint32_t& corner : triangle) {
      if (Status ok = expect({"vertex"}); !ok) return ok;
      std::array<double, 3> xyz;
      for (double& value : xyz) {
        const std::string_view word = nextWord();
        const char* from = word.data();
        if (word.empty() || !text::scanNumber(from, word.data() + word.size(), value))
          return corrupt(word, "where a number should be");
        if (!std::isfinite(value)) return corrupt(word, "where a finite number should be");
      }
      const Vec3 p{xyz[0], xyz[1], xyz[2]};
      largest_.take(p);
      corner = welder_.add(p);
    }
    if (Status ok = expect({"endloop", "endfacet"}); !ok) return ok;
    triangles.push_back(triangle);
    return {};
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  std::string path_;
  const RunContext& context_;
  VertexWelder welder_;
  LargestAbsolute largest_;
  MeshFile result_;
};

}  // namespace

Result<MeshFile> readStl(const std::filesystem::path& path, const RunContext& context) {
  Result<FileBytes> bytes = FileBytes::read(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const bool hasPreamble = bytes->size() >= kPreambleSize;
  const std::uint32_t count = hasPreamble ? binaryCount(bytes->view()) : 0;
  if (hasPreamble && bytes->size() == binarySize(count))
    return BinaryStlReader(bytes->view(), count, path.string(), context).read();
  if (TextDecoder::isNeededFor(bytes->view().substr(0, kProbe))) {
    Result<FileBytes> text = FileBytes::readText(path);
    if (!text) return tl::unexpected(text.error());
    if (isAscii(text->view())) return AsciiStlReader(text->view(), path.string(), context).read();
  }
  const std::string_view file = bytes->view();
  if (isAscii(file)) return AsciiStlReader(file, path.string(), context).read();
  const std::uint64_t spare =
      hasPreamble && file.size() > binarySize(count) ? file.size() - binarySize(count) : 0;
  if (count > 0 && spare % kRecordSize != 0) {
    Result<MeshFile> mesh =
        BinaryStlReader(file.substr(0, binarySize(count)), count, path.string(), context).read();
    if (mesh)
      mesh->warnings.push_back(
          fmt::format("{} bytes follow its {} triangles and are left out", spare, count));
    return mesh;
  }
  if (file.size() < kPreambleSize)
    return failure(
        ErrorCode::corrupt,
        fmt::format("is not an STL: it has {} bytes, does not begin with \"solid\", and a binary one begins "
                    "with {} bytes of header",
                    file.size(), kPreambleSize),
        path.string());
  return failure(
      ErrorCode::corrupt,
      spare > 0 ? fmt::format("is not an STL, or its header is wrong: it states {} triangles, and {} bytes "
                              "follow them, as many as {} more",
                              count, spare, spare / kRecordSize)
                : fmt::format("is truncated or not an STL: {} triangles need {} bytes, the file has {}",
                              count, binarySize(count), file.size()),
      path.string());
}

}  // namespace arete
