// SPDX-License-Identifier: GPL-3.0-or-later
//
// Binary STL: a header of 80 bytes, the triangle count, then 50 bytes per triangle: normal and three corners
// as float32, two unused bytes. The header is text padded with blanks. It must not begin with "solid", as an
// ASCII file does.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/crs/local_origin.h"
#include "io/file/file_writer.h"
#include "io/mesh/losses.h"
#include "io/mesh/stl/stl.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

constexpr std::size_t kHeaderSize = 80, kRecordSize = 50;
constexpr std::size_t kTrianglesPerCancelCheck = 1 << 16;

std::string headerOf(const Vec3& origin) {
  return fmt::format("arete origin {} {} {}", origin.x, origin.y, origin.z);
}

/// The unit normal of the triangle as written; 0, 0, 0 if the triangle has no area, as the format requires.
std::array<float, 3> normalOf(const std::array<Vec3, 3>& c) {
  const Vec3 a{c[1].x - c[0].x, c[1].y - c[0].y, c[1].z - c[0].z};
  const Vec3 b{c[2].x - c[0].x, c[2].y - c[0].y, c[2].z - c[0].z};
  const Vec3 n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  const double length = std::hypot(n.x, n.y, n.z);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  return {static_cast<float>(n.x / length), static_cast<float>(n.y / length),
          static_cast<float>(n.z / length)};
}

}  // namespace

Result<MeshWriteReport> writeStl(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  const auto refuse = [&](std::string message) {
    return failure(ErrorCode::invalidData, std::move(message), path.string());
  };
  if (const Status ok = written.validate(); !ok) return refuse(ok.error().message);
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    return refuse(
        fmt::format("{} triangles are more than the 32-bit count of an STL", mesh.triangles.size()));
  Vec3 origin = options.origin.value_or(localOrigin(mesh.positions));
  std::string header = headerOf(origin);
  if (header.size() > kHeaderSize) {
    origin = {std::round(origin.x), std::round(origin.y), std::round(origin.z)};
    header = headerOf(origin);
  }
  header.resize(kHeaderSize, ' ');
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (const Vec3& p : mesh.positions)
    if (!(std::abs(p.x - origin.x) <= kLargest && std::abs(p.y - origin.y) <= kLargest &&
          std::abs(p.z - origin.z) <= kLargest))
      return refuse(fmt::format("the position {}, {}, {} does not fit 32-bit floats", p.x, p.y, p.z));
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());

  file->write(header);
  putBytes(file->reserve(sizeof(std::uint32_t)), static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % kTrianglesPerCancelCheck == 0) {
      context.report("writing the mesh", static_cast<double>(t) / static_cast<double>(mesh.triangles.size()));
      if (context.cancelled())
        return failure(ErrorCode::interrupted, "writing was interrupted", path.string());
    }
    std::array<std::array<float, 3>, 3> rounded;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[mesh.triangles[t][k]];
      rounded[k] = {static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y),
                    static_cast<float>(p.z - origin.z)};
      corners[k] = {rounded[k][0], rounded[k][1], rounded[k][2]};
    }
    char* to = putBytes(file->reserve(kRecordSize), normalOf(corners));
    putBytes(putBytes(to, rounded), std::uint16_t{0});
  }
  if (const Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
