// SPDX-License-Identifier: GPL-3.0-or-later
//
// A track is a geodesic cut into pieces that are within the Earth's error of it in their middles, the fewest
// for which that is so. Where the geodesics' curvature in the plan is at most c, pieces are therefore no
// shorter than sqrt(2 error / c), and an arc is at most 4 error * s / length from its chord at the distance s
// from an end of it: from the observer on, the track leaves the geodesic slowly.
//
// The curvature of the Earth below a line is that in its middle, so for a nearer place in the same direction
// it differs. By how much is asked for on the way to the border, for half of it: k differs by d over S / 2,
// hence heights at s by at most d / (S / 2) (S - s) s^2 / 2 < d s^2, and by 4/27 d S^2 in all.
#include "terrain/viewshed/azimuthal_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

/// Samples from one node to the next; a block is two of them wide, and begins a sample before the raster.
constexpr int kSpacing = 32, kBlock = 2 * kSpacing;
/// Beyond these the approximations are not to be trusted.
constexpr double kMostTurn = 0.05, kMostAngle = 0.3, kMostPlanError = 0.02;

struct Node {
  double distance = 0, curvature = 0;
  Vec2 ground;  ///< metres east and north
};

std::optional<Node> nodeAt(const SightEarth& earth, Vec2 observer, Vec2 plan) {
  const auto track = earth.track(observer, plan);
  if (!track) return std::nullopt;
  const double s = track->points.back().distance, a = track->azimuthDegrees * std::numbers::pi / 180;
  return Node{s, track->curvature, {s * std::sin(a), s * std::cos(a)}};
}

/// In steps; the inverse of x * steps.x + y * steps.y.
Vec2 inSteps(const SightEarth::PlaneSteps& steps, Vec2 ground) {
  const double area = steps.x.x * steps.y.y - steps.x.y * steps.y.x;
  return {(ground.x * steps.y.y - ground.y * steps.y.x) / area,
          (steps.x.x * ground.y - steps.x.y * ground.x) / area};
}

/// Of the powers of v in -1, 0, 1.
std::array<double, 3> parabola(double before, double middle, double after) {
  return {middle, (after - before) / 2, (after + before) / 2 - middle};
}

void raise(std::atomic<double>& most, double v) {
  double old = most.load();
  while (!(v <= old) && !most.compare_exchange_weak(old, v)) continue;
}

}  // namespace

AzimuthalMap::Quantities AzimuthalMap::at(double column, double row) const {
  Quantities q;
  const int across = static_cast<int>((column + 1) / kBlock), down = static_cast<int>((row + 1) / kBlock);
  const double u = (column + 1 - across * kBlock - kSpacing) / kSpacing,
               v = (row + 1 - down * kBlock - kSpacing) / kSpacing;
  const Block& block = blocks_[static_cast<std::size_t>(down) * static_cast<std::size_t>(blocksAcross_) +
                               static_cast<std::size_t>(across)];
  double* out[3] = {&q.x, &q.y, &q.bend};
  for (int i = 0; i < 3; ++i) {
    const Parabolas& p = block.of[static_cast<std::size_t>(i)];
    *out[i] = (p[0] + u * (p[1] + u * p[2])) +
              v * ((p[3] + u * (p[4] + u * p[5])) + v * (p[6] + u * (p[7] + u * p[8])));
  }
  return q;
}

void AzimuthalMap::along(bool isColumn, int line, int from, int count, double* x, double* y,
                         double* bend) const {
  const int fixed = (line + 1) / kBlock;
  const double w = (line + 1 - fixed * kBlock - kSpacing) / double(kSpacing);
  double* out[3] = {x, y, bend};
  for (int i = 0; i < count;) {
    const int sample = from + i + 1, b = sample / kBlock, end = std::min(count, (b + 1) * kBlock - from - 1);
    const std::size_t block =
        isColumn ? static_cast<std::size_t>(b) * static_cast<std::size_t>(blocksAcross_) +
                       static_cast<std::size_t>(fixed)
                 : static_cast<std::size_t>(fixed) * static_cast<std::size_t>(blocksAcross_) +
                       static_cast<std::size_t>(b);
    for (std::size_t q = 0; q < 3; ++q) {
      const Parabolas& p = blocks_[block].of[q];
      double c[3];
      for (std::size_t k = 0; k < 3; ++k)
        c[k] = isColumn ? p[3 * k] + w * (p[3 * k + 1] + w * p[3 * k + 2])
                        : p[k] + w * (p[3 + k] + w * p[6 + k]);
      const double start = sample - b * kBlock - kSpacing;
      for (int j = i; j < end; ++j) {
        const double t = (start + (j - i)) * (1.0 / kSpacing);
        out[q][j] = c[0] + t * (c[1] + t * c[2]);
      }
    }
    i = end;
  }
}

tl::expected<AzimuthalMap, std::string> AzimuthalMap::make(const SightEarth& earth, Vec2 observer,
                                                           std::uint32_t columns, std::uint32_t rows,
                                                           const RunContext& context) {
  const auto geodesicError = earth.geodesicError();
  if (!geodesicError) return tl::unexpected(std::string("tracks over this Earth are not geodesics"));
  const auto broken = [] {
    return tl::unexpected(std::string("the Earth's lines do not reach all of the DEM in one piece"));
  };
  AzimuthalMap fan;
  // The steps around the observer.
  const double c = observer.x < columns / 2.0 ? 1 : -1, r = observer.y < rows / 2.0 ? 1 : -1;
  const auto x = nodeAt(earth, observer, {observer.x + c, observer.y}),
             y = nodeAt(earth, observer, {observer.x, observer.y + r});
  if (!x || !y) return broken();
  fan.steps = {{x->ground.x * c, x->ground.y * c}, {y->ground.x * r, y->ground.y * r}};
  const double area = fan.steps.x.x * fan.steps.y.y - fan.steps.x.y * fan.steps.y.x;
  const double stepX = std::hypot(fan.steps.x.x, fan.steps.x.y),
               stepY = std::hypot(fan.steps.y.x, fan.steps.y.y);
  if (!(std::fabs(area) > 0.1 * stepX * stepY)) return broken();

  const int across = static_cast<int>(columns + 1) / kBlock + 1,
            down = static_cast<int>(rows + 1) / kBlock + 1;
  const int nodesAcross = 2 * across + 1, nodesDown = 2 * down + 1;
  fan.blocksAcross_ = across;
  fan.blocks_.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  std::vector<Quantities> nodes(static_cast<std::size_t>(nodesAcross) * static_cast<std::size_t>(nodesDown));
  const auto nodeIndex = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodesAcross) + static_cast<std::size_t>(i);
  };
  const auto quantities = [&](const Node& node) {
    const Vec2 p = inSteps(fan.steps, node.ground);
    return Quantities{p.x, p.y, node.curvature * node.distance * node.distance};
  };
  std::atomic<bool> isBroken = false;
  std::atomic<double> turn = 0, bent = 0, bentPerSquare = 0, off = 0, offBend = 0, curving = 0, bend = 0,
                      angle = 0, greatest = -HUGE_VAL, lowest = -HUGE_VAL;
  withThreads(context, [&] {
    tbb::parallel_for(0, nodesDown, [&](int j) {
      for (int i = 0; i < nodesAcross && !isBroken; ++i) {
        const Vec2 plan{double(i * kSpacing - 1), double(j * kSpacing - 1)};
        const auto node = nodeAt(earth, observer, plan);
        if (!node) {
          isBroken = true;
          return;
        }
        nodes[nodeIndex(i, j)] = quantities(*node);
        const Quantities& q = nodes[nodeIndex(i, j)];
        const double dx = plan.x - observer.x, dy = plan.y - observer.y;
        if (std::hypot(dx, dy) > 4)
          raise(turn, std::fabs(std::atan2(q.y * dx - q.x * dy, q.x * dx + q.y * dy)));
        raise(bend, std::fabs(node->curvature));
        if (node->distance > 0) {
          raise(greatest, node->curvature);
          raise(lowest, -node->curvature);
        }
        raise(angle, std::fabs(node->curvature) * node->distance);
        // How much the curvature differs along the way to the border, and what that makes of heights.
        if (i == 0 || j == 0 || i + 1 >= nodesAcross - 1 || j + 1 >= nodesDown - 1) {
          const auto half = nodeAt(earth, observer, {observer.x + dx / 2, observer.y + dy / 2});
          if (!half) {
            isBroken = true;
            return;
          }
          const double s = node->distance;
          const double differs = std::fabs(half->curvature - node->curvature);
          raise(bentPerSquare, differs);
          raise(bent, differs * s * s * (4.0 / 27));
        }
      }
    });
    if (isBroken) return;
    tbb::parallel_for(0, down, [&](int b) {
      for (int a = 0; a < across && !isBroken; ++a) {
        Block& block = fan.blocks_[static_cast<std::size_t>(b) * static_cast<std::size_t>(across) +
                                   static_cast<std::size_t>(a)];
        for (std::size_t q = 0; q < 3; ++q) {
          const auto value = [&](int i, int j) {
            const Quantities& n = nodes[nodeIndex(2 * a + i, 2 * b + j)];
            return q == 0 ? n.x : q == 1 ? n.y : n.bend;
          };
          std::array<std::array<double, 3>, 3> inU;
          for (int j = 0; j < 3; ++j)
            inU[static_cast<std::size_t>(j)] = parabola(value(0, j), value(1, j), value(2, j));
          for (std::size_t k = 0; k < 3; ++k) {
            const auto inV = parabola(inU[0][k], inU[1][k], inU[2][k]);
            for (std::size_t power = 0; power < 3; ++power) block.of[q][3 * power + k] = inV[power];
          }
          // The curvature of the map, which is that of geodesics in the plan.
          if (q < 2)
            raise(curving,
                  std::numbers::sqrt2 * 2 / (kSpacing * kSpacing) *
                      (std::fabs(block.of[q][2]) + std::fabs(block.of[q][4]) + std::fabs(block.of[q][6])));
        }
        for (const double at : {0.5, 1.5}) {
          const Vec2 plan{(2 * a + at) * kSpacing - 1, (2 * b + at) * kSpacing - 1};
          const auto node = nodeAt(earth, observer, plan);
          if (!node) {
            isBroken = true;
            return;
          }
          const Quantities exact = quantities(*node), here = fan.at(plan.x, plan.y);
          raise(off, std::hypot(exact.x - here.x, exact.y - here.y));
          raise(offBend, std::fabs(exact.bend - here.bend));
        }
      }
    });
  });
  if (isBroken) return broken();
  // A line that meets its target all but level dips below it by k d^2 / 8 on the last way d over a cell, and
  // by nothing only if it is k d^2 / 2 above the terrain at that way's beginning.
  const double diagonal =
      std::sqrt(stepX * stepX + stepY * stepY +
                2 * std::fabs(fan.steps.x.x * fan.steps.y.x + fan.steps.x.y * fan.steps.y.y));
  fan.turn = 1.2 * turn + 1e-3;
  fan.leastCurvature = -lowest;
  fan.mostCurvature = greatest;
  // An edge, a diagonal at most, is off its chord by an eighth of the curvature times its square, 2.
  fan.leastPlanError_ = 1.1 * (4 * off + curving / 4) + 1e-6;
  fan.planErrorPerStep_ =
      1.5 * std::numbers::sqrt2 * 4 * *geodesicError * std::sqrt(curving / (2 * *geodesicError));
  fan.mostPlanError_ = fan.leastPlanError_ + 1.1 * std::numbers::sqrt2 * *geodesicError;
  fan.heightError_ = 4 * offBend + 1.2 * bend * diagonal * diagonal / 2 + 1e-6;
  fan.bentPerSquare_ = 2 * bentPerSquare;
  fan.mostBent_ = 2 * bent;
  if (!(fan.turn < kMostTurn && angle < kMostAngle && fan.mostPlanError_ < kMostPlanError &&
        std::isfinite(fan.heightError_ + fan.mostBent_)))
    return tl::unexpected(std::string("the DEM is too large or too near a pole for it"));
  return fan;
}

}  // namespace arete
