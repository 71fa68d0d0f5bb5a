// SPDX-License-Identifier: GPL-3.0-or-later
//
// A separable tent filter whose radius is one pixel or one sample, whichever is larger. First along the rows,
// into sums and weights, then down the columns; the division by the summed weights comes last, so that holes
// do not bleed.
#include "viewer/picture/resample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {
namespace {

/// The samples one pixel reads along one axis.
struct Taps {
  std::uint32_t first = 0;
  std::vector<float> weights;  ///< sum 1
};

std::vector<Taps> tapsAlong(int pixels, double origin, double samplesPerPixel, std::uint32_t samples) {
  const double radius = std::max(1.0, std::abs(samplesPerPixel));
  std::vector<Taps> result;
  for (int i = 0; i < pixels; ++i) {
    const double center = std::clamp(origin + (i + 0.5) * samplesPerPixel, 0.0, samples - 1.0);
    const double first = std::max(0.0, std::ceil(center - radius));
    const double last = std::min(samples - 1.0, std::floor(center + radius));
    Taps taps;
    taps.first = std::uint32_t(first);
    double sum = 0;
    for (double s = first; s <= last; ++s) {
      const double weight = std::max(0.0, 1 - std::abs(s - center) / radius);
      taps.weights.push_back(float(weight));
      sum += weight;
    }
    for (float& weight : taps.weights) weight = float(weight / sum);
    result.push_back(std::move(taps));
  }
  return result;
}

}  // namespace

ViewField resample(std::uint32_t columns, std::uint32_t rows, const SampleAt& sampleAt, const MapView& view) {
  const auto across = tapsAlong(view.width, view.column0, view.columnsPerPixel, columns);
  const auto down = tapsAlong(view.height, view.row0, view.rowsPerPixel, rows);
  std::uint32_t firstRow = rows, endRow = 0;
  for (const Taps& taps : down) {
    firstRow = std::min(firstRow, taps.first);
    endRow = std::max(endRow, taps.first + std::uint32_t(taps.weights.size()));
  }

  const std::size_t width = std::size_t(view.width);
  std::vector<float> sums(std::size_t(endRow - firstRow) * width), weights(sums.size());
  std::vector<double> samples(columns);
  for (std::uint32_t row = firstRow; row < endRow; ++row) {
    const std::size_t at = std::size_t(row - firstRow) * width;
    for (std::uint32_t c = 0; c < columns; ++c) samples[c] = sampleAt(c, row);
    for (std::size_t x = 0; x < width; ++x) {
      double sum = 0, weight = 0;
      for (std::size_t i = 0; i < across[x].weights.size(); ++i) {
        const double value = samples[across[x].first + i];
        if (std::isnan(value)) continue;
        sum += value * across[x].weights[i];
        weight += across[x].weights[i];
      }
      sums[at + x] = float(sum);
      weights[at + x] = float(weight);
    }
  }

  ViewField field;
  field.values.assign(width * std::size_t(view.height), std::numeric_limits<float>::quiet_NaN());
  field.coverage.assign(field.values.size(), 0);
  for (int y = 0; y < view.height; ++y) {
    const Taps& taps = down[std::size_t(y)];
    for (std::size_t x = 0; x < width; ++x) {
      double sum = 0, weight = 0;
      for (std::size_t i = 0; i < taps.weights.size(); ++i) {
        const std::size_t from = (taps.first - firstRow + i) * width + x;
        sum += double(sums[from]) * taps.weights[i];
        weight += double(weights[from]) * taps.weights[i];
      }
      const std::size_t to = std::size_t(y) * width + x;
      field.coverage[to] = float(weight);
      if (weight > 0) field.values[to] = float(sum / weight);
    }
  }
  return field;
}

}  // namespace arete
