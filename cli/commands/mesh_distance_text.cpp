// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/mesh_distance_text.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/arguments/arguments.h"

namespace arete {
namespace {

std::string sixDigits(double value) {
  return fmt::format("{:.6g}", value);
}

}  // namespace

std::string meshDistanceText(const MeshDistanceReport& report, const std::string& unit) {
  const DistanceOneWay &there = report.forward, &back = report.backward;
  const MeshSummary &first = report.first, &second = report.second;
  std::string text;
  const auto row = [&](const std::string& what, const std::string& a, const std::string& b,
                       const std::string& both = "") {
    text += fmt::format("  {:<20} {:>16} {:>16} {:>16}", what, a, b, both);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  const auto lengths = [&](const std::string& what, double a, double b, double both) {
    row(what, sixDigits(a), sixDigits(b), sixDigits(both));
  };
  const auto counts = [&](const char* what, std::uint64_t a, std::uint64_t b) {
    row(what, grouped(a), grouped(b));
  };
  const auto distances = [&](const std::string& behind, double scale) {
    lengths("maximum" + behind, there.maximum / scale, back.maximum / scale, report.hausdorff() / scale);
    lengths("mean" + behind, there.mean / scale, back.mean / scale, report.mean() / scale);
    lengths("RMS" + behind, there.rms / scale, back.rms / scale, report.rms() / scale);
  };
  row(unit.empty() ? "distance" : fmt::format("distance in {}", unit), "from the first", "from the second",
      "both ways");
  distances("", 1);
  if (std::isfinite(report.hausdorffAtMost()))
    lengths("certainly at most", there.atMost, back.atMost, report.hausdorffAtMost());
  distances(" / diagonal", second.diagonal);
  row("maximum at vertices", sixDigits(there.maximumAtVertices), sixDigits(back.maximumAtVertices));
  counts("samples", there.samples, back.samples);
  text += '\n';
  row("mesh", "the first", "the second");
  counts("triangles", first.triangles, second.triangles);
  if (first.degenerateTriangles + second.degenerateTriangles > 0)
    counts("  without area", first.degenerateTriangles, second.degenerateTriangles);
  counts("vertices", first.vertices, second.vertices);
  if (first.unusedVertices + second.unusedVertices > 0)
    counts("  in no triangle", first.unusedVertices, second.unusedVertices);
  row("area", sixDigits(first.area), sixDigits(second.area));
  row("diagonal of the box", sixDigits(first.diagonal), sixDigits(second.diagonal));

  const bool isThere = there.maximum >= back.maximum;
  const DistanceOneWay& worst = isThere ? there : back;
  text += fmt::format(
      "\n  farthest: {:.10g} {:.10g} {:.10g} of the {}, nearest to it {:.10g} {:.10g} {:.10g}\n"
      "  seed {}; fractions are of the second's diagonal\n",
      worst.worst.x, worst.worst.y, worst.worst.z, isThere ? "first" : "second", worst.worstNearest.x,
      worst.worstNearest.y, worst.worstNearest.z, report.seed);
  return text;
}

}  // namespace arete
