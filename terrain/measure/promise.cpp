// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise of a TIN, checked on a report: no error above the stated one, every sample covered, none twice,
// no NODATA covered. All that is broken is named, the error first: readers look at it first. What is
// forgiven as rounding is left out of MeasureReport::errorBeyondRounding.
#include <fmt/format.h>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "terrain/measure/measure.h"

namespace arete {

Status checkPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options) try {
  std::string broken;
  const auto add = [&](const std::string& part) { broken += (broken.empty() ? "" : "; ") + part; };
  // Written so that a NaN on either side fails.
  if (!(report.errorBeyondRounding <= expectedError)) {
    if (const auto& w = report.worst)
      add(fmt::format("the largest error is {}, more than {}: at x {}, y {} the TIN is at {}, the DEM at {}",
                      report.maxAbsError, expectedError, w->x, w->y, w->tinHeight, w->demHeight));
    else
      add(fmt::format("the expected error {} is not a number", expectedError));
  }
  if (report.uncovered > 0)
    add(counted(report.uncovered, "valid sample is in no triangle", "valid samples are in no triangle"));
  if (report.doublyCovered > 0)
    add(counted(report.doublyCovered, "sample is inside more than one triangle",
                "samples are inside more than one triangle"));
  else if (report.overlapped > 0)
    add(fmt::format("triangles overlap around {}", counted(report.overlapped, "sample", "samples")));
  if (report.nodataCovered > 0 && !options.allowCoveredNodata)
    add(counted(report.nodataCovered, "NODATA sample is covered", "NODATA samples are covered"));
  if (broken.empty()) return {};
  return failure(ErrorCode::brokenPromise, std::move(broken));
} catch (...) {
  return caughtFailure();
}

bool keepsPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options) {
  return checkPromise(report, expectedError, options).has_value();
}

}  // namespace arete
