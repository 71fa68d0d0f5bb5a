// SPDX-License-Identifier: GPL-3.0-or-later
//
// A multitriangulation has about 5.7 triangles for each sample whatever the terrain is, so the plain form
// follows from the number of triangles at the finest, which NODATA reduces, and from the bytes of a height.
//
// The packed form depends on how well a height is foretold by its neighbours. What is left over, in steps of
// the number that the file holds, has a logarithm; the bytes grow with it, faster where steps are large,
// since errors and bounds take more bits then too.
#include "io/store/amt/expected_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace arete {
namespace {

constexpr double kHeaderBytes = 4000;
constexpr double kBytesPerTriangle = 60.4;  ///< of the finest triangulation, with all nodes above it
constexpr double kBytesPerPlace = 16;       ///< of a scattered point
constexpr double kIsolatedBytes = 12;       ///< of a sample in no triangle, besides its height

/// The number type that holds heights exactly: as encodeHeights() chooses it.
struct HeightSteps {
  double bytes = 2, step = 1;  ///< step: 0 = the least of the floating-point number

  double stepAt(double height) const {
    if (step > 0) return step;
    const int exponent = height == 0 ? 0 : std::ilogb(height);
    return std::ldexp(1.0, exponent - (bytes == 4 ? 23 : 52));
  }
};

HeightSteps stepsOf(std::span<const double> heights, double scale, double offset) {
  bool areWhole = scale != 0, areFloats = true;
  for (const double height : heights) {
    if (std::isnan(height)) continue;
    const double raw = std::nearbyint((height - offset) / scale);
    areWhole = areWhole && raw >= std::numeric_limits<std::int16_t>::min() &&
               raw <= std::numeric_limits<std::int16_t>::max() && raw * scale + offset == height;
    areFloats = areFloats && double(float(height)) == height;
    if (!areWhole && !areFloats) break;
  }
  return areWhole ? HeightSteps{2, std::abs(scale)} : areFloats ? HeightSteps{4, 0} : HeightSteps{8, 0};
}

double packedBytes(double samples, double triangles, double bits) {
  // A triangle stands for half a sample.
  constexpr double kBase = 7.3, kPerBit = 0.67, kBitsWithErrors = 9.5, kPerFurtherBit = 0.125;
  const double perSample = kBase + kPerBit * std::min(bits, kBitsWithErrors) +
                           kPerFurtherBit * std::max(0.0, bits - kBitsWithErrors);
  return kHeaderBytes + perSample * std::min(samples, triangles / 2 + 1) +
         2 * std::max(0.0, samples - triangles);
}

}  // namespace

ExpectedAmtSize expectedAmtSize(const RasterHeightfield& field) {
  const HeightSteps steps = stepsOf(field.heights, field.rawScale, field.rawOffset);
  double samples = 0, triangles = 0, bits = 0, foretold = 0;
  // Some millions of samples say as much of the heights as all.
  constexpr std::size_t kEnough = std::size_t{1} << 22;
  const std::uint32_t everyRow = std::uint32_t(1 + field.heights.size() / kEnough);
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const double height = field.at(column, row);
      if (std::isnan(height)) continue;
      ++samples;
      if (column == 0 || row == 0) continue;
      const double left = field.at(column - 1, row), upper = field.at(column, row - 1),
                   across = field.at(column - 1, row - 1);
      const int corners = 1 + !std::isnan(left) + !std::isnan(upper) + !std::isnan(across);
      triangles += std::max(0, corners - 2);
      if (column + 1 == field.columns || row + 1 == field.rows || row % everyRow != 0) continue;
      const double around = (left + upper + field.at(column + 1, row) + field.at(column, row + 1)) / 4;
      if (!std::isfinite(around)) continue;
      ++foretold;
      bits += std::log2(1 + std::abs(height - around) / steps.stepAt(height));
    }
  const double isolated = std::max(0.0, samples - triangles);
  return {kHeaderBytes + kBytesPerTriangle * triangles + steps.bytes * samples + kIsolatedBytes * isolated,
          packedBytes(samples, triangles, foretold > 0 ? bits / foretold : 0)};
}

ExpectedAmtSize expectedAmtSize(const SurfaceMesh& mesh) {
  constexpr double kPlain = 61.3, kPacked = 11.5, kPlainOfDoubles = 6, kPackedOfDoubles = 4.5,
                   kPlainWithCorners = 1.8, kPackedWithCorners = 2.5;
  const double triangles = double(mesh.triangles.size());
  const auto isFloat = [](double x) { return double(float(x)) == x; };
  const bool areFloats = std::ranges::all_of(
      mesh.positions, [&](const Vec3& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); });
  const bool hasCorners = !mesh.wedgeAttributes.empty();
  const double plain = triangles * (kPlain + (areFloats ? 0 : kPlainOfDoubles)),
               packed = triangles * (kPacked + (areFloats ? 0 : kPackedOfDoubles));
  return {kHeaderBytes + plain * (hasCorners ? kPlainWithCorners : 1),
          kHeaderBytes + packed * (hasCorners ? kPackedWithCorners : 1)};
}

ExpectedAmtSize expectedAmtSize(const PointHeightfield& field) {
  const HeightSteps steps = stepsOf(field.heights, 1, 0);
  const double points = double(field.heights.size()), triangles = 2 * points;
  // Places have a dozen bytes; heights of points have no neighbours to be foretold from before they are
  // triangulated.
  constexpr double kPackedPlace = 12;
  const double bits = steps.bytes == 2 ? 3 : steps.bytes == 4 ? 10 : 38;
  return {kHeaderBytes + kBytesPerTriangle * triangles + (steps.bytes + kBytesPerPlace) * points,
          packedBytes(points, triangles, bits) + kPackedPlace * points};
}

}  // namespace arete
