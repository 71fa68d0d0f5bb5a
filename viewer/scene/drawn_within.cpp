// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cut allows a triangle an error of the tolerance times the reach of the ball around its prism
// (engine/criteria/view_error.h). The reach of a ball is no larger than that of any place in it that the
// camera sees, depth^2 / distance, and the place of the model that a triangle stands for lies in its prism.
#include "viewer/scene/drawn_within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/morph/geomorph.h"

namespace arete {

double drawnWithin(const Subject& subject, const Camera& cutFor, const ViewSettings& settings, double pixels,
                   const Pick& pick) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const Result<View> view = subject.viewOf(cutFor, settings);
  if (!view) return subject.boundAt(pick, kAny);
  const Frustum frustum(*view);
  const Vec3 place = frustum.toView(subject.drawn(pick.metric, settings));
  const Frustum::Planes planes = frustum.planes();
  constexpr double kEdge = 1 + 1e-9;
  const bool isSeen = (place.z > 0 || frustum.isParallel()) &&
                      std::abs(place.x) <= planes.halfWidth(place.z) * kEdge &&
                      std::abs(place.y) <= planes.halfHeight(place.z) * kEdge;
  if (!isSeen || !std::isfinite(pixels)) return subject.boundAt(pick, kAny);
  const double reach = frustum.isParallel() ? 1 : place.z * place.z / norm(place);
  const double drawn = pixels * reach / frustum.pixelsPerUnit();
  const double allowed = drawn / (settings.stretch * subject.space().metresPerHeight()) * kEdge;
  // Moving vertices have a part of the tolerance, and triangles the rest.
  const bool moves = settings.isGeomorphed && !settings.level;
  const double cut = moves ? allowed * MorphCamera::Options{}.cutShare : allowed;
  const double bound = subject.boundAt(pick, cut);
  // On a curved Earth a triangle is also as far below the ground between its corners as the error of the
  // curved model allows beyond that of the flat one.
  return (settings.isCurved ? 2 * bound + cut : bound) + (allowed - cut);
}

std::string boundText(double bound) {
  if (!(bound > 0)) return "0";
  const int digits = int(std::floor(std::log10(bound))) - 1;  // of the last digit that is shown
  const double unit = std::pow(10, digits);
  // What rounding left of a bound of two digits does not make it larger.
  const double up = std::ceil(bound / unit * (1 - 1e-12)) * unit;
  return fmt::format("{:.{}f}", up, std::max(0, -digits));
}

}  // namespace arete
