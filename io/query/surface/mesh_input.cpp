// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/mesh_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/local_origin.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/edit/joined_surface.h"

namespace arete {
namespace {

/// Whether a number is one of so many decimal digits.
bool hasDigits(double x, int digits) {
  std::array<char, 40> text{};
  const auto written = fmt::format_to_n(text.data(), text.size(), "{:.{}g}", x, digits);
  double back = 0;
  std::from_chars(text.data(), text.data() + written.size, back);
  return back == x;
}

/// The rounding of an axis whose coordinates were rounded to 32-bit floats: all are such numbers, or have as
/// few digits as text that is written of them, and many use the last bit or digit, as numbers that are
/// rounded do. 0 of any other.
double float32RoundingOf(const TriangleMesh& mesh, double Vec3::*axis) {
  constexpr int kMostDigits = std::numeric_limits<float>::max_digits10, kCertainDigits = 6;
  double largest = 0;
  std::uint64_t count = 0, fine = 0;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      const double x = mesh.positions[v].*axis;
      if (!(std::abs(x) <= double{std::numeric_limits<float>::max()})) return 0;
      const auto number = static_cast<float>(x);
      if (static_cast<double>(number) == x)
        fine += std::bit_cast<std::uint32_t>(number) & 1;
      else if (hasDigits(x, kMostDigits))
        fine += hasDigits(x, kCertainDigits) ? 0 : 1;
      else
        return 0;
      largest = std::max(largest, std::abs(x));
      ++count;
    }
  constexpr std::uint64_t kLeastShare = 10;
  return kLeastShare * fine >= count && fine > 0 ? float32Rounding(largest, 0) : 0;
}

}  // namespace

Result<MeshInput> readMeshInput(const std::string& path, const RunContext& context) {
  ARETE_TRY(const MeshFormat format, meshFormatOf(path));
  ARETE_TRY(MeshFile file, readMesh(path, context));
  MeshInput input{.file = std::move(file), .format = format.name, .numbers = {}};
  SurfaceMesh& mesh = input.file.mesh;
  input.rounding = roundingOf(input.file);
  input.fileVertices = mesh.positions.size() + input.file.joinedVertices;
  // Also those that were left out.
  if (!input.file.vertexOf.empty())
    input.fileVertices =
        std::max(input.fileVertices, std::uint64_t{*std::ranges::max_element(input.file.vertexOf)} + 1);
  input.fileFaces =
      mesh.faceOf.empty() ? mesh.triangles.size() : std::uint64_t{*std::ranges::max_element(mesh.faceOf)} + 1;
  input.numbers.first = format.holds.firstIndex;
  input.numbers.faceOf = mesh.faceOf;
  input.numbers.vertexOf = input.file.vertexOf;
  if (!format.holds.isYUp && mesh.vertexAttributes.empty()) return input;
  ARETE_TRY(const JoinedSurface joined, joinSurface(mesh, {.partOf = mesh.objectOf}, context));
  input.joinedAtSeams = joined.joinedVertices;
  if (joined.joinedVertices == 0) return input;
  std::vector<std::uint32_t> numbers = joined.vertexOf;
  if (!input.numbers.vertexOf.empty())
    for (std::uint32_t& v : numbers) v = input.numbers.vertexOf[v];
  input.numbers.vertexOf = std::move(numbers);
  return input;
}

double roundingOf(const MeshFile& file) {
  const Vec3& stated = file.frame.rounding;
  const auto along = [&](double Vec3::*axis) {
    return std::max(stated.*axis, float32RoundingOf(file.mesh, axis));
  };
  return norm(Vec3{along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)});
}

Status warnOfGaps(MeshInput& input, const RunContext& context) {
  ARETE_TRY(const MeshDiagnosis d,
            diagnose(input.file.mesh,
                     {.mostPlaces = 1, .selfIntersections = false, .rounding = input.rounding}, context));
  std::vector<std::string> found;
  if (d.tJunctions.count > 0) found.push_back(counted(d.tJunctions.count, "T-junction", "T-junctions"));
  if (d.nearBorders.count > 0)
    found.push_back(counted(d.nearBorders.count, "border edge that is another one but for rounding",
                            "border edges that are others but for rounding"));
  if (!found.empty())
    input.file.warnings.push_back(
        {WarningCode::geometry, fmt::format("{}: the surface is open there, and gapes when it is simplified; "
                                            "mending it (mesh repair) closes it",
                                            fmt::join(found, " and "))});
  return {};
}

}  // namespace arete
