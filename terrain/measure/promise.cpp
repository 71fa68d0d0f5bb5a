// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise of a TIN, checked on a report: every sample covered, none twice, no NODATA covered, no error
// above the stated one. The tolerance for rounding is 4 ulp of the largest height compared, or a millionth of
// the vertical unit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/caught_failure.h"
#include "terrain/measure/measure.h"

namespace arete {

double acceptedError(const MeasureReport& report, double expectedError) {
  const double h = report.largestHeight;
  const double ulp = std::nextafter(h, std::numeric_limits<double>::infinity()) - h;
  return expectedError + std::max(1e-6, 4 * ulp);
}

Status checkPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options) try {
  const auto broken = [](std::string message) {
    return failure(ErrorCode::brokenPromise, std::move(message));
  };
  if (report.uncovered > 0)
    return broken(fmt::format("{} valid samples are in no triangle", report.uncovered));
  if (report.doublyCovered > 0)
    return broken(fmt::format("{} samples are inside more than one triangle", report.doublyCovered));
  if (report.overlapped > 0)
    return broken(fmt::format("triangles overlap around {} samples", report.overlapped));
  if (report.nodataCovered > 0 && !options.allowCoveredNodata)
    return broken(fmt::format("{} NODATA samples are covered", report.nodataCovered));
  // Written so that a NaN on either side fails.
  if (!(report.maxAbsError <= acceptedError(report, expectedError))) {
    if (!report.worst) return broken(fmt::format("the expected error {} is not a number", expectedError));
    const MeasuredSample& w = *report.worst;
    return broken(
        fmt::format("the largest error is {}, more than {}: at x {}, y {} the TIN is at {}, the DEM at {}",
                    report.maxAbsError, expectedError, w.x, w.y, w.tinHeight, w.demHeight));
  }
  return {};
} catch (...) {
  return caughtFailure();
}

bool keepsPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options) {
  return checkPromise(report, expectedError, options).has_value();
}

}  // namespace arete
