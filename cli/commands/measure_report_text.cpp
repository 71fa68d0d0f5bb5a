// SPDX-License-Identifier: GPL-3.0-or-later
//
// Of a TIN that covers no sample there are no figures. A guess is made of the boxes alone: z in the place of
// y is a mesh whose y is up, numbers of degrees beside numbers of metres are longitude and latitude, and
// small numbers beside large ones are local coordinates.
#include "cli/commands/measure_report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/arguments/arguments.h"

namespace arete {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct Boxing {
  Box2 box{kNowhere, kNowhere, -kNowhere, -kNowhere};

  void take(double x, double y) {
    box.xMin = std::min(box.xMin, x);
    box.xMax = std::max(box.xMax, x);
    box.yMin = std::min(box.yMin, y);
    box.yMax = std::max(box.yMax, y);
  }
};

bool meet(const Box2& a, const Box2& b) {
  return a.xMin <= b.xMax && b.xMin <= a.xMax && a.yMin <= b.yMax && b.yMin <= a.yMax;
}

/// The same with the second axis turned round: the z of a mesh with y up points south.
Box2 turned(const Box2& box) {
  return {box.xMin, -box.yMax, box.xMax, -box.yMin};
}

bool isInDegrees(const Box2& box) {
  return box.xMin >= -180 && box.xMax <= 360 && box.yMin >= -90 && box.yMax <= 90;
}

double largestOf(const Box2& box) {
  return std::max({std::abs(box.xMin), std::abs(box.xMax), std::abs(box.yMin), std::abs(box.yMax)});
}

}  // namespace

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

Box2 planBoxOf(const TriangleMesh& mesh, int axis) {
  Boxing all;
  for (const Vec3& p : mesh.positions) all.take(p.x, axis == 2 ? p.z : p.y);
  return all.box;
}

Box2 planBoxOf(const RasterHeightfield& field) {
  Boxing all;
  for (const double column : {0.0, double(field.columns) - 1})
    for (const double row : {0.0, double(field.rows) - 1}) {
      const Vec2 corner = field.georeference.toSource(column, row);
      all.take(corner.x, corner.y);
    }
  return all.box;
}

Box2 planBoxOf(const PointHeightfield& field) {
  Boxing all;
  for (const Vec2& p : field.positions) all.take(p.x, p.y);
  return all.box;
}

std::string rangesText(const Box2& box) {
  return fmt::format("x {:.10g} to {:.10g}, y {:.10g} to {:.10g}", box.xMin, box.xMax, box.yMin, box.yMax);
}

std::string apartText(const MeasureReport& report, const Box2& tin, const Box2& dem) {
  return fmt::format(
      "  triangles          {}\n  vertices           {}\n  samples compared   0 of {} valid\n"
      "  the TIN            {}\n  the DEM            {}\n",
      grouped(report.triangles), grouped(report.vertices), grouped(report.valid), rangesText(tin),
      rangesText(dem));
}

std::string reasonOfApart(const Box2& tin, const Box2& tinOverZ, const Box2& dem) {
  if (meet(tin, dem)) return {};
  if (meet(tinOverZ, dem) || meet(turned(tinOverZ), dem)) return ": is its y up?";
  if (isInDegrees(tin) != isInDegrees(dem) && std::max(largestOf(tin), largestOf(dem)) > 1000 &&
      (isInDegrees(dem) || largestOf(tin) > 1))
    return ": longitude and latitude in one of them, or local coordinates?";
  return ": local coordinates, or another CRS?";
}

}  // namespace arete
