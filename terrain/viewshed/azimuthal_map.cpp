// SPDX-License-Identifier: GPL-3.0-or-later
//
// Three passes over a lattice of nodes: geodesics to the nodes, patches through the nodes, geodesics to
// places between the nodes that check the patches. Each pass returns the worst deviations that it found
// (MapErrors); they are reduced by maxima, which do not depend on the order, and become the error bounds of
// the map.
//
// Why tracks are nearly straight. A track is a geodesic cut into the fewest legs (2^k) at whose quarters the
// chords are within the Earth's error e of the geodesic. Where the curvature of geodesics in the plan is at
// most c, a leg of length L is c L^2 / 8 from its chord; since legs of twice the length are not within e,
// c (2 L)^2 / 8 > e, and therefore
//
//     (1)  L > sqrt(2 e / c).
//
// At the distance s from the observer, which is an end of the first leg, an arc is from its chord by
//
//     (2)  at most e * 4 s / L (a parabola of height e, below its tangent at the end), and at most e.
//
// Why heights are nearly right. The curvature of the Earth below a line is that in the line's middle, so a
// line to a nearer place in the same direction has another one. Let k differ by d between the lines to the
// border, S metres away, and half as far, and assume that it changes linearly. Then the drop at s differs by
//
//     (3)  d / (S / 2) * (S - s) * s^2 / 2  <  d s^2,    at most (4 / 27) d S^2.
//
// What makes the bounds tested rather than proved: c, d and the deviations of the patches are known at the
// nodes and checks alone. The factors kCheck..., named below, stand for what is between them.
#include "terrain/viewshed/azimuthal_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

/// Samples from one node to the next. A patch is two of them wide; the first begins a sample before the
/// raster.
constexpr int kSpacing = 32, kPatch = 2 * kSpacing;

// Limits. The sweep's approximations (small angles, truncated series) are tested for maps within these.
constexpr double kMostTurn = 0.05;       ///< radians: turn
constexpr double kMostAngle = 0.3;       ///< radians: curvature times distance, of the series in ImagePlane
constexpr double kMostPlanError = 0.02;  ///< steps
/// Sine of the least angle between the two steps: below it map coordinates are ill-conditioned.
constexpr double kLeastSine = 0.1;

// Factors for what is between the nodes and the checks (tested, not proved).
/// |deviation of a patch anywhere| <= kCheckPatch * (the largest at the checks).
constexpr double kCheckPatch = 4;
/// |turn anywhere| <= kCheckTurn * (the largest at nodes) + kTurnNearby. Nodes nearer than kFarFromObserver
/// steps are not evaluated, since their directions are differences of rounding: kTurnNearby is theirs.
constexpr double kCheckTurn = 1.2, kTurnNearby = 1e-3, kFarFromObserver = 4;
/// |curvature of the Earth anywhere| <= kCheckCurvature * (the largest at nodes).
constexpr double kCheckCurvature = 1.2;
/// |difference of curvatures in one direction| <= kCheckDifference * (the largest on the way to the border).
constexpr double kCheckDifference = 2;
/// Length of a leg >= (1) / kLegLength: c is the curvature in the plan of the whole map, not that of the
/// geodesic, and (1) takes arcs for parabolas.
constexpr double kLegLength = 1.5;
/// Deviation of an arc from its chord <= kArc * that of the parabola in (2); the same for edges.
constexpr double kArc = 1.1;

// Constants of geometry.
/// Errors of tracks hold along x and along y, so in the plan they are sqrt(2) larger.
constexpr double kBothAxes = std::numbers::sqrt2;
/// (2): slope at its end of a parabola of height 1 over a chord of length 1.
constexpr double kParabolaSlope = 4;
/// An edge, a diagonal of squared length 2 at most, is from its chord by at most c * 2 / 8.
constexpr double kEdgeSag = 1.0 / 4;
/// (3) with t = s / S: the largest value of (1 - t) t^2, at t = 2 / 3.
constexpr double kLargestDifference = 4.0 / 27;
/// Least bounds: what double precision may do, far above it. Steps; metres.
constexpr double kLeastPlanError = 1e-6, kLeastHeightError = 1e-6;

/// The larger of two; NaN where one is NaN, so that no bound is taken from what could not be computed.
double worse(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

/// The worst deviations found. A value: combine() does not depend on the order.
struct MapErrors {
  bool isReached = true;  ///< all geodesics could be computed
  double turn = 0;        ///< radians, at nodes
  double curvature = 0;   ///< 1/m: the largest absolute curvature of the Earth, at nodes
  double angle = 0;       ///< radians: the largest curvature times distance, at nodes
  double leastCurvature = std::numeric_limits<double>::infinity(), mostCurvature = -leastCurvature;  ///< 1/m
  double curvatureDifference = 0;  ///< 1/m: d in (3)
  double dropDifference = 0;       ///< metres: (3)
  double planCurvature = 0;        ///< 1/steps: c in (1)
  double patch = 0;                ///< steps: deviation of patches from geodesics, at checks
  double patchDrop = 0;            ///< metres: the same, of twiceDrop

  void combine(const MapErrors& other) {
    isReached = isReached && other.isReached;
    turn = worse(turn, other.turn);
    curvature = worse(curvature, other.curvature);
    angle = worse(angle, other.angle);
    leastCurvature = -worse(-leastCurvature, -other.leastCurvature);
    mostCurvature = worse(mostCurvature, other.mostCurvature);
    curvatureDifference = worse(curvatureDifference, other.curvatureDifference);
    dropDifference = worse(dropDifference, other.dropDifference);
    planCurvature = worse(planCurvature, other.planCurvature);
    patch = worse(patch, other.patch);
    patchDrop = worse(patchDrop, other.patchDrop);
  }
};

struct Geodesic {
  double distance = 0, curvature = 0;
  Vec2 ground;  ///< metres east and north: distance times (sin azimuth, cos azimuth)
};

std::optional<Geodesic> geodesicTo(const SightEarth& earth, Vec2 observer, Vec2 plan) {
  const auto track = earth.track(observer, plan);
  if (!track) return std::nullopt;
  const double s = track->points.back().distance, a = track->azimuthDegrees * std::numbers::pi / 180;
  return Geodesic{s, track->curvature, {s * std::sin(a), s * std::cos(a)}};
}

/// The inverse of x * steps.x + y * steps.y.
Vec2 inSteps(const SightEarth::PlaneSteps& steps, Vec2 ground) {
  const double area = steps.x.x * steps.y.y - steps.x.y * steps.y.x;
  return {(ground.x * steps.y.y - ground.y * steps.y.x) / area,
          (steps.x.x * ground.y - steps.x.y * ground.x) / area};
}

/// The metres of a step along the columns and along the rows, by geodesics from the observer to a sample's
/// distance towards the middle of the raster. Nothing if they cannot be computed or are nearly parallel.
std::optional<SightEarth::PlaneSteps> stepsAround(const SightEarth& earth, Vec2 observer,
                                                  std::uint32_t columns, std::uint32_t rows) {
  const double c = observer.x < columns / 2.0 ? 1 : -1, r = observer.y < rows / 2.0 ? 1 : -1;
  const auto x = geodesicTo(earth, observer, {observer.x + c, observer.y}),
             y = geodesicTo(earth, observer, {observer.x, observer.y + r});
  if (!x || !y) return std::nullopt;
  const SightEarth::PlaneSteps steps{{x->ground.x * c, x->ground.y * c}, {y->ground.x * r, y->ground.y * r}};
  const double area = steps.x.x * steps.y.y - steps.x.y * steps.y.x;
  if (!(std::fabs(area) > kLeastSine * std::hypot(steps.x.x, steps.x.y) * std::hypot(steps.y.x, steps.y.y)))
    return std::nullopt;
  return steps;
}

/// Coefficients of the powers of v, of the parabola through values at v = -1, 0, 1.
std::array<double, 3> parabola(double before, double middle, double after) {
  return {middle, (after - before) / 2, (after + before) / 2 - middle};
}

/// Calls addRow(row, errors) for rows 0 to `rows` - 1, in parallel, and combines the errors.
template <class AddRow>
MapErrors reduceRows(int rows, const AddRow& addRow) {
  return parallelReduce(
      IndexRange<int>(0, rows), MapErrors{},
      [&](const IndexRange<int>& range, MapErrors errors) {
        for (int row = range.begin(); row < range.end() && errors.isReached; ++row) addRow(row, errors);
        return errors;
      },
      [](MapErrors a, const MapErrors& b) {
        a.combine(b);
        return a;
      });
}

}  // namespace

/// The passes of make(), over one map.
class AzimuthalMap::Construction {
 public:
  Construction(AzimuthalMap& map, const SightEarth& earth, Vec2 observer, std::uint32_t columns,
               std::uint32_t rows)
      : map_(map),
        earth_(earth),
        observer_(observer),
        across_(static_cast<int>(columns + 1) / kPatch + 1),
        down_(static_cast<int>(rows + 1) / kPatch + 1),
        nodesAcross_(2 * across_ + 1),
        nodesDown_(2 * down_ + 1) {
    map_.patchesAcross_ = across_;
    map_.patches_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_));
    nodes_.resize(static_cast<std::size_t>(nodesAcross_) * static_cast<std::size_t>(nodesDown_));
  }

  /// First pass: geodesics to all nodes.
  MapErrors evaluateNodes() {
    return reduceRows(nodesDown_, [&](int j, MapErrors& errors) {
      for (int i = 0; i < nodesAcross_ && errors.isReached; ++i) evaluateNode(i, j, errors);
    });
  }
  /// Second pass, after the first: patches through the nodes.
  MapErrors fitPatches() {
    return reduceRows(down_, [&](int b, MapErrors& errors) {
      for (int a = 0; a < across_; ++a) fitPatch(a, b, errors);
    });
  }
  /// Third pass, after the second: geodesics to two places of each patch that are no nodes.
  MapErrors checkPatches() const {
    return reduceRows(down_, [&](int b, MapErrors& errors) {
      for (int a = 0; a < across_ && errors.isReached; ++a)
        for (const double at : {0.5, 1.5}) checkPatch((2 * a + at), (2 * b + at), errors);
    });
  }
  /// Turns the worst deviations into the map's bounds.
  /// @return whether they are within the limits.
  bool setErrors(const MapErrors& worst, double geodesicError) const;

 private:
  std::size_t nodeIndex(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodesAcross_) + static_cast<std::size_t>(i);
  }
  static Vec2 planOf(double i, double j) { return {i * kSpacing - 1, j * kSpacing - 1}; }
  Quantities quantities(const Geodesic& geodesic) const {
    const Vec2 p = inSteps(map_.steps, geodesic.ground);
    return {p.x, p.y, geodesic.curvature * geodesic.distance * geodesic.distance};
  }

  void evaluateNode(int i, int j, MapErrors& errors) {
    const Vec2 plan = planOf(i, j);
    const auto geodesic = geodesicTo(earth_, observer_, plan);
    if (!geodesic) {
      errors.isReached = false;
      return;
    }
    const Quantities& q = nodes_[nodeIndex(i, j)] = quantities(*geodesic);
    const double dx = plan.x - observer_.x, dy = plan.y - observer_.y;
    if (std::hypot(dx, dy) > kFarFromObserver)
      errors.turn = worse(errors.turn, std::fabs(std::atan2(q.y * dx - q.x * dy, q.x * dx + q.y * dy)));
    errors.curvature = worse(errors.curvature, std::fabs(geodesic->curvature));
    errors.angle = worse(errors.angle, std::fabs(geodesic->curvature) * geodesic->distance);
    if (geodesic->distance > 0) {
      errors.mostCurvature = worse(errors.mostCurvature, geodesic->curvature);
      errors.leastCurvature = -worse(-errors.leastCurvature, -geodesic->curvature);
    }
    if (isBeforeBorder(i, j)) compareHalfway(*geodesic, {dx, dy}, errors);
  }

  /// Nodes whose lines reach the border of the raster.
  bool isBeforeBorder(int i, int j) const {
    return i == 0 || j == 0 || i + 1 >= nodesAcross_ - 1 || j + 1 >= nodesDown_ - 1;
  }

  /// How much the curvature differs from that of the line half as far: (3).
  void compareHalfway(const Geodesic& geodesic, Vec2 way, MapErrors& errors) const {
    const auto half = geodesicTo(earth_, observer_, {observer_.x + way.x / 2, observer_.y + way.y / 2});
    if (!half) {
      errors.isReached = false;
      return;
    }
    const double s = geodesic.distance, difference = std::fabs(half->curvature - geodesic.curvature);
    errors.curvatureDifference = worse(errors.curvatureDifference, difference);
    errors.dropDifference = worse(errors.dropDifference, difference * s * s * kLargestDifference);
  }

  void fitPatch(int a, int b, MapErrors& errors) {
    Patch& patch = map_.patches_[static_cast<std::size_t>(b) * static_cast<std::size_t>(across_) +
                                 static_cast<std::size_t>(a)];
    constexpr double Quantities::*kMembers[] = {&Quantities::x, &Quantities::y, &Quantities::twiceDrop};
    for (std::size_t q = 0; q < 3; ++q) {
      const auto value = [&](int i, int j) { return nodes_[nodeIndex(2 * a + i, 2 * b + j)].*kMembers[q]; };
      std::array<std::array<double, 3>, 3> inU;
      for (int j = 0; j < 3; ++j)
        inU[static_cast<std::size_t>(j)] = parabola(value(0, j), value(1, j), value(2, j));
      Biquadratic& c = patch.of[q];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto inV = parabola(inU[0][k], inU[1][k], inU[2][k]);
        for (std::size_t power = 0; power < 3; ++power) c[3 * power + k] = inV[power];
      }
      // The second derivative of the map along a direction of the plan, per step squared, is that of
      // geodesics in the plan: |2 c2 cos^2 + 2 c4 cos sin + 2 c6 sin^2| <= 2 (|c2| + |c4| + |c6|), of x and
      // of y.
      if (q < 2)
        errors.planCurvature =
            worse(errors.planCurvature, kBothAxes * 2 / (kSpacing * kSpacing) *
                                            (std::fabs(c[2]) + std::fabs(c[4]) + std::fabs(c[6])));
    }
  }

  void checkPatch(double i, double j, MapErrors& errors) const {
    const Vec2 plan = planOf(i, j);
    const auto geodesic = geodesicTo(earth_, observer_, plan);
    if (!geodesic) {
      errors.isReached = false;
      return;
    }
    const Quantities exact = quantities(*geodesic), here = map_.at(plan.x, plan.y);
    errors.patch = worse(errors.patch, std::hypot(exact.x - here.x, exact.y - here.y));
    errors.patchDrop = worse(errors.patchDrop, std::fabs(exact.twiceDrop - here.twiceDrop));
  }

  AzimuthalMap& map_;
  const SightEarth& earth_;
  Vec2 observer_;
  int across_, down_;  ///< patches
  int nodesAcross_, nodesDown_;
  std::vector<Quantities> nodes_;
};

bool AzimuthalMap::Construction::setErrors(const MapErrors& worst, double geodesicError) const {
  const SightEarth::PlaneSteps& cell = map_.steps;
  const double stepX = std::hypot(cell.x.x, cell.x.y), stepY = std::hypot(cell.y.x, cell.y.y);
  // Metres: the longer diagonal of a cell.
  const double diagonal =
      std::sqrt(stepX * stepX + stepY * stepY + 2 * std::fabs(cell.x.x * cell.y.x + cell.x.y * cell.y.y));
  map_.turn = kCheckTurn * worst.turn + kTurnNearby;
  map_.leastCurvature = worst.leastCurvature;
  map_.mostCurvature = worst.mostCurvature;
  // The patches' own error, and that an edge, straight in the plan, is curved in the map.
  map_.leastPlanError_ =
      kArc * (kCheckPatch * worst.patch + worst.planCurvature * kEdgeSag) + kLeastPlanError;
  // (2) with the shortest piece of (1).
  map_.planErrorPerStep_ = kLegLength * kBothAxes * kParabolaSlope * geodesicError *
                           std::sqrt(worst.planCurvature / (2 * geodesicError));
  map_.mostPlanError_ = map_.leastPlanError_ + kArc * kBothAxes * geodesicError;
  // A line that reaches its target nearly level dips by k d^2 / 8 over the last cell, of diagonal d, and is
  // sure not to dip below the terrain there only if it is k d^2 / 2 above it where it enters the cell. The
  // patches' error of twiceDrop is counted twice what it makes of heights.
  map_.heightError_ = kCheckPatch * worst.patchDrop +
                      kCheckCurvature * worst.curvature * diagonal * diagonal / 2 + kLeastHeightError;
  map_.dropErrorPerSquare_ = kCheckDifference * worst.curvatureDifference;
  map_.mostDropError_ = kCheckDifference * worst.dropDifference;
  return map_.turn < kMostTurn && worst.angle < kMostAngle && map_.mostPlanError_ < kMostPlanError &&
         std::isfinite(map_.heightError_ + map_.mostDropError_);
}

tl::expected<AzimuthalMap, std::string> AzimuthalMap::make(const SightEarth& earth, Vec2 observer,
                                                           std::uint32_t columns, std::uint32_t rows,
                                                           const RunContext& context) {
  const auto geodesicError = earth.geodesicError();
  if (!geodesicError) return tl::unexpected(std::string("tracks over this Earth are not geodesics"));
  const tl::unexpected unreached(
      std::string("some of the DEM cannot be reached by geodesics from the observer"));
  const auto steps = stepsAround(earth, observer, columns, rows);
  if (!steps) return unreached;
  AzimuthalMap map;
  map.steps = *steps;
  MapErrors worst;
  bool isWithinLimits = false;
  withThreads(context, [&] {
    Construction construction(map, earth, observer, columns, rows);
    worst = construction.evaluateNodes();
    if (!worst.isReached) return;
    worst.combine(construction.fitPatches());
    worst.combine(construction.checkPatches());
    isWithinLimits = construction.setErrors(worst, *geodesicError);
  });
  if (!worst.isReached) return unreached;
  if (!isWithinLimits) return tl::unexpected(std::string("the DEM is too large or too near a pole for it"));
  return map;
}

AzimuthalMap::Quantities AzimuthalMap::at(double column, double row) const {
  Quantities q;
  const int across = static_cast<int>((column + 1) / kPatch), down = static_cast<int>((row + 1) / kPatch);
  const double u = (column + 1 - across * kPatch - kSpacing) / kSpacing,
               v = (row + 1 - down * kPatch - kSpacing) / kSpacing;
  const Patch& patch = patches_[static_cast<std::size_t>(down) * static_cast<std::size_t>(patchesAcross_) +
                                static_cast<std::size_t>(across)];
  double* out[3] = {&q.x, &q.y, &q.twiceDrop};
  for (int i = 0; i < 3; ++i) {
    const Biquadratic& p = patch.of[static_cast<std::size_t>(i)];
    *out[i] = (p[0] + u * (p[1] + u * p[2])) +
              v * ((p[3] + u * (p[4] + u * p[5])) + v * (p[6] + u * (p[7] + u * p[8])));
  }
  return q;
}

void AzimuthalMap::along(bool isColumn, int line, int from, int count, double* x, double* y,
                         double* twiceDrop) const {
  const int fixed = (line + 1) / kPatch;
  const double w = (line + 1 - fixed * kPatch - kSpacing) / double(kSpacing);
  double* out[3] = {x, y, twiceDrop};
  for (int i = 0; i < count;) {
    // The samples of one patch: of each quantity a parabola in t, along the line.
    const int sample = from + i + 1, b = sample / kPatch, end = std::min(count, (b + 1) * kPatch - from - 1);
    const std::size_t patch =
        isColumn ? static_cast<std::size_t>(b) * static_cast<std::size_t>(patchesAcross_) +
                       static_cast<std::size_t>(fixed)
                 : static_cast<std::size_t>(fixed) * static_cast<std::size_t>(patchesAcross_) +
                       static_cast<std::size_t>(b);
    for (std::size_t q = 0; q < 3; ++q) {
      const Biquadratic& p = patches_[patch].of[q];
      double c[3];
      for (std::size_t k = 0; k < 3; ++k)
        c[k] = isColumn ? p[3 * k] + w * (p[3 * k + 1] + w * p[3 * k + 2])
                        : p[k] + w * (p[3 + k] + w * p[6 + k]);
      const double start = sample - b * kPatch - kSpacing;
      for (int j = i; j < end; ++j) {
        const double t = (start + (j - i)) * (1.0 / kSpacing);
        out[q][j] = c[0] + t * (c[1] + t * c[2]);
      }
    }
    i = end;
  }
}

}  // namespace arete
