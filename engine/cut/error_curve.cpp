// SPDX-License-Identifier: GPL-3.0-or-later
//
// Including a node adds one triangle to a front on a border and two elsewhere, so the nodes of a cut are
// counted without building its front.
#include "engine/cut/error_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/caught_failure.h"
#include "engine/cut/cut.h"

namespace arete {
namespace {

constexpr std::array kMantissas = {1, 2, 5};

/// 1, 2, 5, 10 ... for rung 0, 1, 2, 3 ...; 0.5, 0.2, ... for -1, -2, ...: the doubles nearest to them.
double rungValue(int rung) {
  const int decade = rung >= 0 ? rung / 3 : (rung - 2) / 3;
  const double mantissa = kMantissas[static_cast<std::size_t>(rung - 3 * decade)];
  return decade >= 0 ? mantissa * std::pow(10.0, decade) : mantissa / std::pow(10.0, -decade);
}

}  // namespace

std::vector<double> toleranceLadder(const MultiTriangulation& mt, std::size_t most) {
  const auto saturated = [&](std::uint32_t n) { return mt.saturatedCode(NodeId(n)); };
  OutwardScale::Code least = 0;  // the least positive error; 0: none found yet
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    if (least != 0 && MultiTriangulation::bandOf(saturated(n)) > MultiTriangulation::bandOf(least)) break;
    if (saturated(n) != 0 && (least == 0 || saturated(n) < least)) least = saturated(n);
  }
  if (least == 0) return {};
  const double coarsest = mt.largestError();
  const double finest = mt.scale().decode(least);
  std::vector<double> ladder;
  int rung = 3 * (static_cast<int>(std::ceil(std::log10(coarsest))) + 1);
  for (; ladder.size() < most && rungValue(rung) >= finest; --rung)
    if (rungValue(rung) < coarsest) ladder.push_back(rungValue(rung));
  std::reverse(ladder.begin(), ladder.end());
  return ladder;
}

Result<std::vector<CurvePoint>> errorCurve(const MultiTriangulation& mt, std::span<const double> tolerances,
                                           const RunContext& context) try {
  std::vector<CurvePoint> curve;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    context.report("curve", static_cast<double>(i) / static_cast<double>(tolerances.size()));
    CurvePoint point{.maxError = tolerances[i]};
    point.saturatedTriangles = uniformTriangleCount(mt, tolerances[i]);
    ARETE_TRY(const NodeCut cut, takeNodes(mt, UniformError(tolerances[i]), {}, context));
    point.minimalTriangles = mt.rootTriangleCount();
    for (std::uint32_t n = 0; n < cut.nodes.size(); ++n)
      if (cut.nodes[n]) point.minimalTriangles += mt.isOpen(NodeId(n)) ? 1 : 2;
    curve.push_back(point);
  }
  context.report("curve", 1);
  return curve;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
