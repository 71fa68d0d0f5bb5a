// SPDX-License-Identifier: GPL-3.0-or-later
// Fields brought to pixels, against a plain bilinear interpolation and a plain mean.
#include "viewer/picture/resample.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdint>
#include <limits>

namespace arete {
namespace {

constexpr double kNoSample = std::numeric_limits<double>::quiet_NaN();

/// A view whose pixel (0, 0) has its centre on the sample (0, 0).
MapView viewOf(int width, int height, double samplesPerPixel) {
  MapView view;
  view.width = width;
  view.height = height;
  view.columnsPerPixel = view.rowsPerPixel = samplesPerPixel;
  view.column0 = view.row0 = -0.5 * samplesPerPixel;
  return view;
}

TEST(Resample, GivesTheSamplesWhereAPixelIsASample) {
  const auto value = [](std::uint32_t c, std::uint32_t r) { return 3.0 * c - 7.0 * r; };
  const ViewField field = resample(9, 6, value, viewOf(9, 6, 1));
  ASSERT_EQ(field.values.size(), 54u);
  ASSERT_EQ(field.coverage.size(), 54u);
  for (std::uint32_t r = 0; r < 6; ++r)
    for (std::uint32_t c = 0; c < 9; ++c) {
      EXPECT_NEAR(field.values[r * 9 + c], value(c, r), 1e-4);
      EXPECT_NEAR(field.coverage[r * 9 + c], 1, 1e-6);
    }
}

TEST(Resample, IsBilinearWherePixelsAreDenserThanSamples) {
  const auto value = [](std::uint32_t c, std::uint32_t r) { return double((c * 7 + r * 13) % 11); };
  const MapView view = viewOf(31, 21, 0.25);
  const ViewField field = resample(9, 6, value, view);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const double c = 0.25 * x, r = 0.25 * y;
      const auto c0 = std::uint32_t(std::min(std::floor(c), 7.0)),
                 r0 = std::uint32_t(std::min(std::floor(r), 4.0));
      const double u = c - c0, v = r - r0;
      const double expected = (value(c0, r0) * (1 - u) + value(c0 + 1, r0) * u) * (1 - v) +
                              (value(c0, r0 + 1) * (1 - u) + value(c0 + 1, r0 + 1) * u) * v;
      EXPECT_NEAR(field.values[std::size_t(y) * 31 + std::size_t(x)], expected, 1e-4) << x << ", " << y;
    }
}

TEST(Resample, CountsEverySampleWhereSamplesAreDenser) {
  // One high sample among zeros: its weight is spread over the pixels and none of it is lost.
  double sum = 0;
  const MapView view = viewOf(10, 10, 4);
  const ViewField field = resample(
      40, 40, [](std::uint32_t c, std::uint32_t r) { return c == 17 && r == 22 ? 160.0 : 0.0; }, view);
  for (const float v : field.values) sum += v;
  EXPECT_NEAR(sum, 10, 0.5) << "a sixteenth of its value, since a pixel has 16 samples";
}

TEST(Resample, LeavesSamplesWithoutDataOut) {
  const auto left = [](std::uint32_t c, std::uint32_t) { return c < 20 ? 5.0 : kNoSample; };
  for (const double samplesPerPixel : {0.5, 1.0, 4.0}) {
    const int width = int(40 / samplesPerPixel);
    const ViewField field = resample(40, 40, left, viewOf(width, 3, samplesPerPixel));
    SCOPED_TRACE(samplesPerPixel);
    for (int x = 0; x < width; ++x) {
      const float value = field.values[std::size_t(x)], coverage = field.coverage[std::size_t(x)];
      EXPECT_EQ(std::isnan(value), coverage == 0) << x;
      if (coverage > 0) {
        EXPECT_NEAR(value, 5, 1e-5) << "NODATA does not darken its neighbours, at " << x;
      }
      EXPECT_GE(coverage, 0);
      EXPECT_LE(coverage, 1 + 1e-6);
    }
    EXPECT_NEAR(field.coverage.front(), 1, 1e-6);
    EXPECT_EQ(field.coverage[std::size_t(width) - 1], 0);
  }
}

}  // namespace
}  // namespace arete
