// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bound adds, per triangle, the largest vertical change of a corner and the largest shift times the
// slope; a packed file has an order of its own, and its grid bounds the change. What goes to a pipe is
// written to a temporary file first, and that is read back.
#include "io/formats/exchange/written_mesh.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/file_writer.h"
#include "io/files/no_file.h"
#include "io/files/output_file.h"

namespace arete {

namespace {

/// The length of the gradient of the triangle's plane; 0 without an area.
double slopeOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double area = ux * vy - uy * vx;
  if (area == 0) return 0;
  return std::hypot((uz * vy - vz * uy) / area, (ux * vz - vx * uz) / area);
}

double largestHeightChange(const TriangleMesh& before, const TriangleMesh& after, bool onGrid) {
  double largest = 0;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    double up = 0, sideways = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = before.positions[before.triangles[t][k]];
      const Vec3& q = after.positions[after.triangles[t][k]];
      up = std::max(up, std::abs(p.z - q.z));
      sideways = std::max(sideways, std::hypot(p.x - q.x, p.y - q.y));
    }
    if (!onGrid && sideways > 0) {
      const auto& c = before.triangles[t];
      up += sideways * slopeOf(before.positions[c[0]], before.positions[c[1]], before.positions[c[2]]);
    }
    largest = std::max(largest, up);
  }
  return largest;
}

/// The same of a file whose order is its own: each height moves by at most its rounding, and by a shift
/// along the steepest slope.
double heightChangeOf(const TriangleMesh& before, const Vec3& rounding) {
  double steepest = 0;
  for (const auto& t : before.triangles)
    steepest =
        std::max(steepest, slopeOf(before.positions[t[0]], before.positions[t[1]], before.positions[t[2]]));
  return rounding.z + std::hypot(rounding.x, rounding.y) * steepest;
}

/// A file in the folder for such, removed at the end.
class TemporaryMesh {
 public:
  TemporaryMesh() = default;
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;
  ~TemporaryMesh() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }

  Status create(std::string_view extension) {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (error) folder = "/tmp";
    std::string name = (folder / fmt::format("arete-XXXXXX{}", extension)).string();
    const int descriptor = ::mkstemps(name.data(), static_cast<int>(extension.size()));
    if (descriptor < 0)
      return failure(
          ErrorCode::unreadable,
          fmt::format("a temporary file cannot be made: {}", std::generic_category().message(errno)), name);
    ::close(descriptor);
    path_ = name;
    return {};
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Copies the bytes of a file to a pipe.
Status passOn(const std::filesystem::path& from, const std::filesystem::path& to) {
  ARETE_TRY(const FileBytes bytes, FileBytes::read(from));
  ARETE_TRY(FileWriter pipe, FileWriter::create(to));
  pipe.write(bytes.view());
  return pipe.finish();
}

}  // namespace

Result<WrittenMesh> writeAndReadBack(MeshRef mesh, const std::filesystem::path& path,
                                     const MeshWriteOptions& options, bool onGrid,
                                     const RunContext& context) {
  ARETE_TRY(const MeshFormat format, meshFormatOf(path, options.format));
  const bool mustPassOn = !format.holds.isExact && isNoFile(path);
  TemporaryMesh temporary;
  if (mustPassOn) ARETE_CHECK(temporary.create(format.extension));
  const std::filesystem::path& written = mustPassOn ? temporary.path() : path;
  OutputGroup together;
  ARETE_TRY(MeshWriteReport report, writeMesh(mesh, written, options, context));
  if (format.holds.isExact) {
    ARETE_CHECK(together.commit());
    return WrittenMesh{.mesh = {}, .frame = {}, .report = std::move(report)};
  }
  // An older file of that name stays until this one has been read.
  Result<MeshFile> file = readMesh(OutputGroup::placeOf(written), context, format.extension.substr(1));
  if (!file) return failure(file.error().code, file.error().message, path.string());
  if (file->mesh.triangles.size() != mesh.shape.triangles.size())
    return failure(ErrorCode::corrupt, "does not hold the triangles that were written to it", path.string());
  // What goes to a pipe gets no name: the group removes it.
  ARETE_CHECK(mustPassOn ? passOn(OutputGroup::placeOf(written), path) : together.commit());
  const double change = options.packing ? heightChangeOf(mesh.shape, file->frame.rounding)
                                        : largestHeightChange(mesh.shape, file->mesh, onGrid);
  return WrittenMesh{.mesh = std::move(file->mesh),
                     .frame = std::move(file->frame),
                     .heightRounding = change,
                     .report = std::move(report)};
}

}  // namespace arete
