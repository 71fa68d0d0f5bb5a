// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/measure_report_text.h"

#include <fmt/format.h>

#include "cli/arguments/arguments.h"

namespace arete {

std::string measureReportText(const MeasureReport& report, const std::string& unit, bool isRaster) {
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", what, value);
  };
  line("triangles",
       fmt::format("{}{}", grouped(report.triangles),
                   report.degenerateTriangles == 0
                       ? ""
                       : fmt::format(" ({} without area)", grouped(report.degenerateTriangles))));
  line("vertices", grouped(report.vertices));
  line("maximum error", withUnit(report.maxAbsError, unit));
  if (report.worst) {
    const MeasuredSample& w = *report.worst;
    const std::string where =
        isRaster ? fmt::format("column {}, row {}", w.column, w.row) : fmt::format("point {}", w.sample);
    line("  at", fmt::format("x {:.10g}, y {:.10g} ({}): TIN {}, DEM {}", w.x, w.y, where,
                             withUnit(w.tinHeight, unit), withUnit(w.demHeight, unit)));
  }
  line("RMS error", withUnit(report.rmsError, unit));
  line("mean |error|", withUnit(report.meanAbsError, unit));
  line("mean error", withUnit(report.meanError, unit) + " (TIN minus DEM)");
  line("samples compared", fmt::format("{} of {} valid", grouped(report.covered), grouped(report.valid)));
  line("uncovered", grouped(report.uncovered));
  line("doubly covered", grouped(report.doublyCovered));
  if (report.overlapped > report.doublyCovered) line("overlapped", grouped(report.overlapped));
  if (isRaster) {
    line("covered NODATA", grouped(report.nodataCovered));
    line("isolated", grouped(report.isolated));
  }
  return text;
}

}  // namespace arete
