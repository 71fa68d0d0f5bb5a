// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sample pulls at the corners of the triangle that has its nearest point, along the triangle's normal;
// across it only a little, because there the nearest point moves along. Where the nearest point is on an edge
// or at a corner, it pulls in all directions. A step that leaves a larger sum is halved. Vertices of
// triangles that would turn too far keep their place for this step.
//
// All of it happens in a frame around the middle of the cut, in which the cut is about as large as 1.
#include "surface/fit/fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/box3.h"
#include "engine/base/symmetric3.h"
#include "engine/parallel/with_threads.h"
#include "surface/fit/least_squares.h"
#include "surface/fit/nearest_on_front.h"
#include "surface/fit/source_samples.h"
#include "surface/topology/edges.h"
#include "surface/topology/turn_guard.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// The pull of a sample across the normal, beside that along it.
constexpr double kAcross = 0.05;
/// Shares below this are those of a point on the boundary of its triangle.
constexpr double kOnBoundary = 1e-9;
constexpr double kLeastGain = 0.01;  // of the sum of squares, in a step
constexpr int kHalvings = 3;

/// The complement of metricAlong().
Symmetric3 beside(const Vec3& t, double across) {
  const double a = 1 - across;
  return {1 - a * t.x * t.x, -a * t.x * t.y, -a * t.x * t.z,
          1 - a * t.y * t.y, -a * t.y * t.z, 1 - a * t.z * t.z};
}

class Fitting {
 public:
  Fitting(const TriangleMesh& cut, const std::vector<std::uint8_t>& isHeld, const RunContext& context)
      : triangles_(cut.triangles), isHeld_(isHeld), context_(context), positions_(cut.positions) {
    const MeshEdges edges(cut.triangles, cut.positions.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      if (edge.isBorder()) {
        borders_.push_back({edge.low.index(), edge.high.index()});
        // An element of three corners, the third without a share.
        elements_.push_back({edge.low.index(), edge.high.index(), edge.high.index()});
      }
    }
    elements_.insert(elements_.begin(), cut.triangles.begin(), cut.triangles.end());
  }

  Result<FittedSurface> run(const TriangleMesh& source, const SurfaceFitOptions& options) {
    enterFrame();
    TriangleMesh framed = source;
    for (Vec3& p : framed.positions) p = (p - middle_) * scale_;
    const std::uint64_t count =
        options.samples > 0 ? options.samples : std::max<std::uint64_t>(100'000, 40 * triangles_.size());
    samples_ = sampleSource(framed, count);
    if (samples_.ofArea.empty()) return failure(ErrorCode::invalidData, "has no area to be fitted to");
    if (borders_.empty()) samples_.ofBorder.clear();
    guard_.emplace(triangles_, positions_);

    FittedSurface result;
    double sum = assign();
    result.rmsBefore = rmsOf(sum);
    while (result.steps < options.steps) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "fitting was interrupted");
      context_.report("fit", double(result.steps) / options.steps);
      const std::vector<Vec3> before = positions_, moves = problem().solve(isHeld_);
      double next = sum;
      for (int halving = 0; halving <= kHalvings; ++halving) {
        move(before, moves, std::ldexp(1.0, -halving));
        next = assign();
        if (next < sum) break;
      }
      if (!(next < sum)) {
        positions_ = before;
        break;
      }
      ++result.steps;
      const double gain = (sum - next) / sum;
      sum = next;
      if (gain < kLeastGain) break;
    }
    context_.report("fit", 1);
    result.rmsAfter = rmsOf(sum);
    for (std::size_t v = 0; v < positions_.size(); ++v)
      positions_[v] = isHeld_[v] != 0 || wasNotMoved(v) ? source_[v] : positions_[v] / scale_ + middle_;
    result.positions = std::move(positions_);
    return result;
  }

 private:
  void enterFrame() {
    source_ = positions_;
    Box3 box = Box3::empty();
    for (const Vec3& p : positions_) box.include(p);
    middle_ = (box.low + box.high) / 2.0;
    const double side = box.longestSide();
    scale_ = side > 0 ? std::ldexp(1.0, -std::ilogb(side)) : 1;
    for (Vec3& p : positions_) p = (p - middle_) * scale_;
    framed_ = positions_;
  }
  bool wasNotMoved(std::size_t v) const { return positions_[v] == framed_[v]; }
  double rmsOf(double sum) const {
    return std::sqrt(sum / double(samples_.ofArea.size() + samples_.ofBorder.size())) / scale_;
  }

  /// Finds the nearest points of all samples. @return the sum of the squared distances of those of the area,
  /// and of those of the border
  double assign() {
    double sum = 0;
    const auto nearestOf = [&](const NearestOnFront& front, const std::vector<Vec3>& samples,
                               std::vector<FrontPoint>& points) {
      points.resize(samples.size());
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) points[i] = front.nearest(samples[i]);
      });
    };
    nearestOf(NearestOnFront(positions_, triangles_), samples_.ofArea, ofArea_);
    for (std::size_t i = 0; i < ofArea_.size(); ++i) {
      const Vec3 r = samples_.ofArea[i] - at(triangles_[ofArea_[i].element], ofArea_[i].shares);
      sum += dot(r, r);
    }
    if (samples_.ofBorder.empty()) return sum;
    nearestOf(NearestOnFront(positions_, borders_), samples_.ofBorder, ofBorder_);
    for (std::size_t i = 0; i < ofBorder_.size(); ++i) {
      const auto& [from, to] = borders_[ofBorder_[i].element];
      const Vec3 r = samples_.ofBorder[i] - at({from, to, to}, ofBorder_[i].shares);
      sum += dot(r, r);
    }
    return sum;
  }
  Vec3 at(const Triangle& corners, const std::array<double, 3>& shares) const {
    return shares[0] * positions_[corners[0]] + shares[1] * positions_[corners[1]] +
           shares[2] * positions_[corners[2]];
  }

  /// For the nearest points that assign() found.
  MoveProblem problem() const {
    MoveProblem problem(positions_.size(), elements_);
    for (std::size_t i = 0; i < ofArea_.size(); ++i) {
      const auto& [t, shares] = ofArea_[i];
      const Vec3 r = samples_.ofArea[i] - at(triangles_[t], shares);
      const bool isInside = std::min({shares[0], shares[1], shares[2]}) > kOnBoundary;
      const auto& [a, b, c] = triangles_[t];
      problem.add(t, shares,
                  isInside
                      ? metricAlong(unit(cross(positions_[b] - positions_[a], positions_[c] - positions_[a])),
                                    kAcross)
                      : kUnit3,
                  r);
    }
    for (std::size_t i = 0; i < ofBorder_.size(); ++i) {
      const auto& [e, shares] = ofBorder_[i];
      const auto& [from, to] = borders_[e];
      const Vec3 r = samples_.ofBorder[i] - at({from, to, to}, shares);
      const bool isInside = std::min(shares[0], shares[1]) > kOnBoundary;
      problem.add(static_cast<std::uint32_t>(triangles_.size()) + e, shares,
                  isInside ? beside(unit(positions_[to] - positions_[from]), kAcross) : kUnit3, r);
    }
    return problem;
  }

  /// Moves the vertices, but for those whose triangles would turn too far or fold.
  void move(const std::vector<Vec3>& from, const std::vector<Vec3>& moves, double part) {
    std::vector<std::uint8_t> stays(from.size(), 0);
    for (;;) {
      for (std::size_t v = 0; v < from.size(); ++v)
        positions_[v] = stays[v] != 0 ? from[v] : from[v] + part * moves[v];
      if (!guard_->mark(positions_, stays)) return;
    }
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<std::uint8_t>& isHeld_;
  const RunContext& context_;
  std::vector<Vec3> positions_, source_, framed_;  // in the frame; as given; as given, in the frame
  Vec3 middle_{0, 0, 0};
  double scale_ = 1;
  std::vector<Triangle> elements_;  // the triangles, then the border edges
  std::vector<std::array<std::uint32_t, 2>> borders_;
  SourceSamples samples_;
  std::vector<FrontPoint> ofArea_, ofBorder_;
  std::optional<TurnGuard> guard_;
};

}  // namespace

Result<FittedSurface> fitSurface(const TriangleMesh& cut, const std::vector<std::uint8_t>& isHeld,
                                 const TriangleMesh& source, const SurfaceFitOptions& options,
                                 const RunContext& context) {
  for (const TriangleMesh* mesh : {&cut, &source})
    if (const Status valid = mesh->validate(); !valid) return tl::unexpected(valid.error());
  if (cut.triangles.empty()) return FittedSurface{cut.positions, 0, 0, 0};
  return withThreads(context, [&] { return Fitting(cut, isHeld, context).run(source, options); });
}

}  // namespace arete
