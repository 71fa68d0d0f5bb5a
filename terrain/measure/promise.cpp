// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise of a TIN, checked on a report: every sample covered, none twice, no NODATA covered, no error
// above the stated one. What is forgiven as rounding is left out of MeasureReport::errorBeyondRounding.
#include <fmt/format.h>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "terrain/measure/measure.h"

namespace arete {

Status checkPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options) try {
  const auto broken = [](std::string message) {
    return failure(ErrorCode::brokenPromise, std::move(message));
  };
  if (report.uncovered > 0)
    return broken(
        counted(report.uncovered, "valid sample is in no triangle", "valid samples are in no triangle"));
  if (report.doublyCovered > 0)
    return broken(counted(report.doublyCovered, "sample is inside more than one triangle",
                          "samples are inside more than one triangle"));
  if (report.overlapped > 0)
    return broken(
        fmt::format("triangles overlap around {}", counted(report.overlapped, "sample", "samples")));
  if (report.nodataCovered > 0 && !options.allowCoveredNodata)
    return broken(counted(report.nodataCovered, "NODATA sample is covered", "NODATA samples are covered"));
  // Written so that a NaN on either side fails.
  if (!(report.errorBeyondRounding <= expectedError)) {
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
