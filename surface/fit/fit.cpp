// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sample pulls at the corners of the triangle that has its nearest point, along the triangle's normal;
// across it only a little, because there the nearest point moves along. Where the nearest point is on an edge
// or at a corner, it pulls in all directions. A step that leaves a larger sum is halved. Vertices of
// triangles that would turn too far keep their place for this step.
//
// All of it happens in a frame around the middle of the cut, in which the cut is about as large as 1.
#include "surface/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/box3.h"
#include "engine/base/triangle_bvh.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "surface/fit/least_squares.h"
#include "surface/fit/line_samples.h"
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
constexpr std::uint64_t kSamplesPerTriangle = 40, kSamplesPerFace = 16, kMostForFaces = 100'000;
constexpr std::size_t kPerSum = 1024;  // samples
constexpr double kLeastGain = 0.01;    // of the sum of squares, in a step
constexpr int kHalvings = 3;

class Fitting {
 public:
  Fitting(const TriangleMesh& cut, const std::vector<std::uint8_t>& isHeld, const FitLines& lines,
          const RunContext& context)
      : triangles_(cut.triangles),
        isHeld_(isHeld),
        lines_(lines),
        context_(context),
        positions_(cut.positions) {
    const MeshEdges edges(cut.triangles, cut.positions.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      // An element of three corners, the third without a share.
      if (edge.isBorder()) borders_.push_back({edge.low.index(), edge.high.index(), edge.high.index()});
    }
    elements_ = cut.triangles;
    elements_.insert(elements_.end(), borders_.begin(), borders_.end());
    for (const FitLines::Edge& edge : lines.edges)
      elements_.push_back({edge.ends[0], edge.ends[1], edge.ends[1]});
  }

  Result<FittedSurface> run(const TriangleMesh& source, const SurfaceFitOptions& options) {
    lineWeight_ = options.lineWeight;
    enterFrame();
    TriangleMesh framed = source;
    for (Vec3& p : framed.positions) p = (p - middle_) * scale_;
    const std::uint64_t count =
        options.samples > 0 ? options.samples
                            : std::max(kSamplesPerTriangle * triangles_.size(),
                                       std::min(kMostForFaces, kSamplesPerFace * source.triangles.size()));
    Samples all(sampleSource(framed, count), lines_, [&](const Vec3& p) { return (p - middle_) * scale_; });
    if (all.source.ofArea.empty()) return failure(ErrorCode::invalidData, "has no area to be fitted to");
    if (borders_.empty()) all.source.ofBorder.clear();
    guard_.emplace(triangles_, positions_);

    FittedSurface result;
    Sums sums = assign(all);
    result.rmsBefore = all.rmsOf(sums.surface) / scale_;
    result.lineBefore = all.ofLines.largest() / scale_;
    const double rounding = roundingOf(source) * scale_;
    // Of a surface that is exact, lines alone are off.
    if (!(sums.surface > all.squaresOf(rounding)) && !lines_.isEmpty())
      for (std::size_t v = 0; v < isHeld_.size(); ++v)
        if (lines_.mayMove[v] == 0) isHeld_[v] = 1;
    if (sums.surface > all.squaresOf(rounding) || all.ofLines.largest() > 2 * rounding)
      ARETE_CHECK(take(all, std::max(sums.surface, all.squaresOf(rounding)), sums, options, result));
    context_.report("fit", 1);
    result.rmsAfter = all.rmsOf(sums.surface) / scale_;
    result.lineAfter = all.ofLines.largest() / scale_;
    for (std::size_t v = 0; v < positions_.size(); ++v)
      positions_[v] = isHeld_[v] != 0 || wasNotMoved(v) ? source_[v] : positions_[v] / scale_ + middle_;
    result.positions = std::move(positions_);
    return result;
  }

 private:
  /// A sample of the source, and the point of the cut that is nearest to it.
  struct Assigned {
    std::uint32_t element = TriangleBvh::kNone;  // of triangles_, or of borders_
    std::array<double, 3> shares{};
    Vec3 residual{};
  };
  struct Samples {
    SourceSamples source;
    std::vector<Assigned> ofArea = {}, ofBorder = {};
    LineSamples ofLines;

    template <class InFrame>
    Samples(SourceSamples of, const FitLines& lines, const InFrame& inFrame)
        : source(std::move(of)), ofLines(lines, source.width, inFrame) {}
    double count() const { return double(source.ofArea.size() + source.ofBorder.size()); }
    double rmsOf(double sum) const { return std::sqrt(sum / count()); }
    double squaresOf(double rms) const { return rms * rms * count(); }
  };

  /// Of squared distances: of the surface with its borders, and of lines.
  struct Sums {
    double surface = 0, lines = 0;
  };

  double allOf(const Sums& sums) const { return sums.surface + lineWeight_ * sums.lines; }

  /// Takes steps until one gains too little.
  /// @param most  of the surface: what it was at first, or rounding. No step makes more of it, whatever lines
  ///              gain
  Status take(Samples& samples, double most, Sums& sums, const SurfaceFitOptions& options,
              FittedSurface& result) {
    while (result.steps < options.steps) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "fitting was interrupted");
      context_.report("fit", double(result.steps) / options.steps);
      const std::vector<Vec3> before = positions_, moves = problem(samples).solve(isHeld_);
      Sums next = sums;
      const auto isBetter = [&] { return allOf(next) < allOf(sums) && next.surface <= most; };
      for (int halving = 0; halving <= kHalvings; ++halving) {
        move(before, moves, std::ldexp(1.0, -halving));
        next = assign(samples);
        if (isBetter()) break;
      }
      if (!isBetter()) {
        positions_ = before;
        assign(samples);
        return {};
      }
      ++result.steps;
      const double gain = 1 - allOf(next) / allOf(sums);
      sums = next;
      if (gain < kLeastGain) return {};
    }
    return {};
  }

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
  /// How far the coordinates of a mesh are from where they were meant, at the least: half of the distance to
  /// the next number at the largest one, of floats where all are floats.
  static double roundingOf(const TriangleMesh& mesh) {
    double largest = 0;
    bool areFloats = true;
    for (const Vec3& p : mesh.positions)
      for (const double x : {p.x, p.y, p.z}) {
        largest = std::max(largest, std::fabs(x));
        areFloats = areFloats && double(static_cast<float>(x)) == x;
      }
    return std::ldexp(largest, areFloats ? -24 : -52);
  }
  bool wasNotMoved(std::size_t v) const { return positions_[v] == framed_[v]; }

  /// Finds the nearest points of all samples. The last ones are the guesses.
  Sums assign(Samples& samples) {
    if (!nearest_) {
      nearest_.emplace(positions_, triangles_);
      if (!borders_.empty()) nearestBorder_.emplace(positions_, borders_);
    } else {
      nearest_->refit(positions_, triangles_);
      if (nearestBorder_) nearestBorder_->refit(positions_, borders_);
    }
    double sum = assign(*nearest_, samples.source.ofArea, samples.ofArea);
    if (!samples.source.ofBorder.empty())
      sum += assign(*nearestBorder_, samples.source.ofBorder, samples.ofBorder);
    return {sum, samples.ofLines.assign(positions_)};
  }
  static double assign(const TriangleBvh& nearest, const std::vector<Vec3>& samples,
                       std::vector<Assigned>& assigned) {
    assigned.resize(samples.size());
    // Runs of samples have a sum each, so that no rounding depends on the threads.
    std::vector<double> sums((samples.size() + kPerSum - 1) / kPerSum, 0);
    parallelFor(std::size_t(0), sums.size(), [&](std::size_t run) {
      for (std::size_t i = run * kPerSum; i < std::min(samples.size(), (run + 1) * kPerSum); ++i) {
        Assigned& one = assigned[i];
        // The samples of a face follow each other.
        const bool isFirst = one.element == TriangleBvh::kNone && i > run * kPerSum;
        const TriangleBvh::Answer answer =
            nearest.nearest(samples[i], isFirst ? assigned[i - 1].element : one.element);
        one = {answer.triangle, answer.point.shares, samples[i] - answer.point.place};
        sums[run] += answer.squaredDistance;
      }
    });
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
  }
  /// For the nearest points that assign() found.
  MoveProblem problem(const Samples& samples) const {
    MoveProblem problem(positions_.size(), elements_);
    for (const auto& [t, shares, residual] : samples.ofArea) {
      const bool isInside = std::min({shares[0], shares[1], shares[2]}) > kOnBoundary;
      const auto& [a, b, c] = triangles_[t];
      const Vec3 normal = cross(positions_[b] - positions_[a], positions_[c] - positions_[a]);
      problem.add(t, shares,
                  isInside && dot(normal, normal) > 0 ? metricAlong(unit(normal), kAcross) : identity3(),
                  residual);
    }
    for (const auto& [e, shares, residual] : samples.ofBorder) {
      const Vec3 along = positions_[borders_[e][1]] - positions_[borders_[e][0]];
      const bool isInside = std::min(shares[0], shares[1]) > kOnBoundary && dot(along, along) > 0;
      problem.add(static_cast<std::uint32_t>(triangles_.size()) + e, shares,
                  isInside ? metricAcross(unit(along), kAcross) : identity3(), residual);
    }
    for (const auto& [place, e, shares, residual] : samples.ofLines.all()) {
      const auto& [i, j] = lines_.edges[e].ends;
      const Vec3 along = positions_[j] - positions_[i];
      const bool isInside = std::min(shares[0], shares[1]) > kOnBoundary && dot(along, along) > 0;
      problem.add(static_cast<std::uint32_t>(triangles_.size() + borders_.size()) + e,
                  {shares[0], shares[1], 0},
                  lineWeight_ * (isInside ? metricAcross(unit(along), kAcross) : identity3()), residual);
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
  std::vector<std::uint8_t> isHeld_;
  const FitLines& lines_;
  double lineWeight_ = 0;
  const RunContext& context_;
  std::vector<Vec3> positions_, source_, framed_;  // in the frame; as given; as given, in the frame
  Vec3 middle_{0, 0, 0};
  double scale_ = 1;
  std::vector<Triangle> elements_;  // the triangles, then the edges of borders and of lines
  std::vector<Triangle> borders_;   // edges, the second corner twice
  std::optional<TriangleBvh> nearest_, nearestBorder_;
  std::optional<TurnGuard> guard_;
};

}  // namespace

Result<FittedSurface> fitSurface(const TriangleMesh& cut, const std::vector<std::uint8_t>& isHeld,
                                 const TriangleMesh& source, const SurfaceFitOptions& options,
                                 const RunContext& context, const FitLines& lines) {
  for (const TriangleMesh* mesh : {&cut, &source}) ARETE_CHECK(mesh->validate());
  if (cut.triangles.empty()) return FittedSurface{cut.positions, 0, 0, 0};
  return withThreads(context, [&] { return Fitting(cut, isHeld, lines, context).run(source, options); });
}

}  // namespace arete
