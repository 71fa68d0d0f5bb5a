// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/harness.h"

#include <sys/mman.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <limits>

#include "measure/mesh_distance.h"
#include "terrain/measure/measure.h"

namespace arete::fuzz {
namespace {

constexpr std::size_t kLongestMessage = 1000;
constexpr std::size_t kMostTrianglesCompared = 300;

bool isPrintable(const std::string& text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  return true;
}

/// What meshes are measured against. Its corner is that of the seeds' rasters.
RasterHeightfield smallDem() {
  RasterHeightfield dem;
  dem.columns = dem.rows = 8;
  for (int i = 0; i < 64; ++i) dem.heights.push_back(i % 13);
  dem.heights[20] = std::numeric_limits<double>::quiet_NaN();
  dem.georeference.geoTransform = {0, 1, 0, 8, 0, -1};
  dem.georeference.hasGeoTransform = true;
  return dem;
}

PointHeightfield fewPoints() {
  PointHeightfield points;
  for (int i = 0; i < 16; ++i) {
    points.positions.push_back({double(i * 5 % 8), double(i * 3 % 16) / 2});
    points.heights.push_back(i % 5);
  }
  return points;
}

}  // namespace

void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "\nbroken: %s\n", promise);
  std::abort();
}

void requireClear(const Error& error) {
  if (!error.message.empty() && error.message.size() <= kLongestMessage && isPrintable(error.message) &&
      isPrintable(error.culprit))
    return;
  std::fprintf(stderr, "\nthe error was: %s\n", error.describe().c_str());
  require(false, "an error is one printable sentence");
}

void requireClear(const Warnings& warnings) {
  for (const std::string& warning : warnings) requireClear(Error{ErrorCode::invalidData, warning, {}});
}

void useMesh(const Result<MeshFile>& file) {
  if (!file) return requireClear(file.error());
  requireClear(file->warnings);
  const TriangleMesh& mesh = file->mesh;
  require(mesh.validate().has_value(), "a mesh that was read has valid indices and finite coordinates");
  require(file->triangleErrors.empty() || file->triangleErrors.size() == mesh.triangles.size(),
          "a mesh has an error for each triangle or for none");
  for (const double rounding : {file->frame.rounding.x, file->frame.rounding.y, file->frame.rounding.z})
    require(rounding >= 0, "a rounding is a distance");
  static const RasterHeightfield dem = smallDem();
  static const PointHeightfield points = fewPoints();
  const auto requireSound = [](const Result<MeasureReport>& report) {
    if (!report) return requireClear(report.error());
    require(report->covered + report->uncovered + report->isolated == report->valid,
            "a measurement counts every sample once");
  };
  requireSound(measure(mesh, dem, {}, oneThread()));
  requireSound(measure(mesh, points, {}, oneThread()));
  if (mesh.triangles.size() > kMostTrianglesCompared) return;
  static const TriangleMesh other{{{0, 0, 1}, {8, 0, 2}, {8, 8, 3}, {0, 8, 4}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto distance = measureDistance(mesh, other, {.samples = 32, .seed = 1}, oneThread());
  if (distance)
    require(distance->hausdorff() >= 0, "a distance is none that is less than nothing");
  else
    requireClear(distance.error());
}

RunContext oneThread() {
  // For the whole program: a context of one thread makes an arena each time it is used.
  static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  return {};
}

MemoryFile::MemoryFile() : descriptor_(memfd_create("arete-fuzz", MFD_CLOEXEC)) {
  require(descriptor_ >= 0, "the system has files in memory");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

void MemoryFile::set(std::span<const std::uint8_t> bytes) const {
  const bool isSet = ftruncate(descriptor_, static_cast<off_t>(bytes.size())) == 0 &&
                     pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  require(isSet, "a file in memory can be written");
}

}  // namespace arete::fuzz
