// SPDX-License-Identifier: GPL-3.0-or-later
//
// After the header and the count, 50 bytes for each triangle: normal and three corners as float32, and two
// bytes that many programs give a meaning.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "io/files/text_scan.h"
#include "io/formats/common/comments.h"
#include "io/formats/stl/facet_colors.h"
#include "io/formats/stl/read_parts.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

class BinaryStlReader {
 public:
  BinaryStlReader(std::string_view file, std::uint32_t count, std::string path, const RunContext& context)
      : file_(file), count_(count), path_(std::move(path)), context_(context) {}

  Result<MeshFile> read() {
    ARETE_CHECK(takeHeader());
    if (count_ == 0 && !isOurs_) return failure(ErrorCode::unsupported, "holds no triangle", path_);
    if (count_ > kMostStlTriangles)
      return failure(ErrorCode::unsupported, "holds more triangles than an index can name", path_);
    // A file of ours may state an origin that its coordinates are relative to.
    const Vec3 origin = result_.frame.origin.value_or(Vec3{});
    StlTriangles triangles;
    triangles.reserve(count_);
    std::vector<std::uint16_t> words;
    const char* at = file_.data() + kStlPreambleSize;
    for (std::uint32_t t = 0; t < count_; ++t, at += kStlRecordSize) {
      if (t % kStlTrianglesPerCancelCheck == 0) {
        context_.report("reading the mesh", double(t) / double(count_));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
      }
      std::array<float, 12> numbers;
      std::uint16_t word = 0;
      std::memcpy(&numbers, at, sizeof numbers);
      std::memcpy(&word, at + sizeof numbers, sizeof word);
      const auto vectorAt = [&](std::size_t i) { return Vec3{numbers[i], numbers[i + 1], numbers[i + 2]}; };
      const std::array<Vec3, 3> corners = {vectorAt(3), vectorAt(6), vectorAt(9)};
      for (const Vec3& p : corners)
        if (!std::isfinite(origin.x + p.x) || !std::isfinite(origin.y + p.y) ||
            !std::isfinite(origin.z + p.z))
          return failure(ErrorCode::corrupt,
                         fmt::format("triangle {} of {} has a coordinate that is not finite", t, count_),
                         path_);
      triangles.add(corners, origin, vectorAt(0));
      // Most files have zeros there and get no list; the first other word starts one, behind zeros.
      if (word == 0 && words.empty()) continue;
      words.resize(t);
      words.push_back(word);
    }
    triangles.finish(result_, origin);
    if (auto attribute = facetAttribute(file_.substr(0, kStlHeaderSize), words))
      result_.mesh.triangleAttributes.push_back(std::move(*attribute));
    if (!result_.mesh.objects.empty()) result_.mesh.objectOf.assign(count_, 0);
    return std::move(result_);
  }

 private:
  Status takeHeader() {
    result_.frame.coordinates = "float32";
    std::string_view header = file_.substr(0, kStlHeaderSize);
    if (header.starts_with(kStlObjectKey)) {
      // The name of the object is padded with blanks or zeros.
      header.remove_prefix(kStlObjectKey.size());
      while (!header.empty() && (header.back() == ' ' || header.back() == '\0')) header.remove_suffix(1);
      isOurs_ = true;
      result_.mesh.objects.emplace_back(header);
      return {};
    }
    if (header.starts_with(kStlMetresKey)) {
      result_.metresAbout = readPlaceNumbers(header.substr(kStlMetresKey.size()));
      if (!result_.metresAbout)
        return failure(ErrorCode::corrupt, "the header has \"arete metres_about\" without three numbers",
                       path_);
      isOurs_ = true;
      result_.up = MeshUp::z;
      return {};
    }
    if (!header.starts_with(kStlOriginKey)) return {};
    const char* at = header.data() + kStlOriginKey.size();
    const char* const end = header.data() + header.size();
    std::array<double, 3> xyz;
    for (double& value : xyz) {
      while (at < end && text::isBlank(*at)) ++at;
      if (at == end || !text::scanNumber(at, end, value) || !std::isfinite(value))
        return failure(ErrorCode::corrupt, "the header has \"arete origin\" without three numbers", path_);
    }
    isOurs_ = true;
    result_.frame = {.coordinates = "float32 relative to the origin", .origin = Vec3{xyz[0], xyz[1], xyz[2]}};
    result_.up = MeshUp::z;
    return {};
  }

  std::string_view file_;
  std::uint32_t count_;
  std::string path_;
  const RunContext& context_;
  bool isOurs_ = false;
  MeshFile result_;
};

}  // namespace

Result<MeshFile> readBinaryStl(std::string_view file, std::uint32_t count, std::string path,
                               const RunContext& context) {
  return BinaryStlReader(file, count, std::move(path), context).read();
}

}  // namespace arete
