// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle of the multitriangulation bounds the terrain of full resolution over all of it: z_triangle -
// z_terrain is in [-below, above]. Where the line passes the triangle, the judge decides whether terrain as
// high as the bound allows would matter. If not, everything finer below the triangle is skipped. If so, the
// node that removes the triangle has a star over the same ground, and the star's triangles below the line are
// treated the same way, in their order, down to the finest, which are the terrain. (Hierarchical visibility:
// [DeFlorianiMagillo1994]; refinement along a ray: [DeFlorianiMagilloPuppo2000].) Adjacent triangles that one
// node removes are refined together.
#include <algorithm>
#include <span>
#include <vector>

#include "terrain/locate/ground_height.h"
#include "terrain/locate/triangle_locator.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/mt_crossing.h"
#include "terrain/sight/walk.h"

namespace arete {
namespace {

class Descent {
 public:
  Descent(const TriangleLocator& locator, const SightLeg& leg, SightJudge& judge, OutwardScale::Code allowed,
          bool mayFill)
      : crossing_(locator, leg),
        mt_(locator.mt()),
        below_(mt_.column(kBelow)),
        above_(mt_.column(kAbove)),
        leg_(leg),
        judge_(judge),
        allowed_(allowed),
        mayFill_(mayFill),
        shortest_(crossing_.shortest()) {}

  /// First step: the root triangles below the leg.
  void findRoots() {
    crossing_.addRoots(spans_);
    for (const TriangleSpan& span : spans_) {
      hasFirst_ = hasFirst_ || (span.t0 <= shortest_ && span.t1 > shortest_);
      hasLast_ = hasLast_ || (span.t1 >= 1 - shortest_ && span.t0 < 1 - shortest_);
    }
  }
  /// Second step. Returns the number of triangles visited.
  std::uint64_t run() {
    follow(0, 0, 1, true);
    return visited_;
  }
  /// Whether terrain reaches the ends of the leg for sure. If not, an end may still stand on a single point
  /// of it.
  bool hasFirst() const { return !mayFill_ && hasFirst_; }
  bool hasLast() const { return !mayFill_ && hasLast_; }

 private:
  /// Treats the spans from `begin` on, which cover [first, last] except for gaps, in order; then removes
  /// them.
  void follow(std::size_t begin, double first, double last, bool mayHaveGaps) {
    MtCrossing::sort(std::span(spans_).subspan(begin));
    const std::size_t end = spans_.size();
    if (!mayFill_)
      for (std::size_t i = begin; i < end; ++i)
        if (spans_[i].t1 - spans_[i].t0 > shortest_) hint(spans_[i]);
    double done = first;
    for (std::size_t i = begin; i < end && !judge_.isDone();) {
      TriangleSpan span = spans_[i++];
      if (span.t1 <= done) continue;
      if (span.t0 > done + shortest_) {
        if (mayHaveGaps) judge_.gap(leg_.distance(done), leg_.distance(span.t0));
      }
      const double from = std::max(span.t0, done);
      span.z0 = span.at(from);
      span.t0 = from;
      ++visited_;
      const Action action = actionOf(span);
      if (action == Action::report) report(span);
      if (action != Action::refine) {
        done = span.t1;
        continue;
      }
      // All adjacent spans that the same node removes. What follows them is reported after the star.
      const NodeId node = mt_.remover(TriangleId(span.triangle));
      double to = span.t1;
      while (i < end && spans_[i].t0 <= to + shortest_) {
        TriangleSpan next = spans_[i];
        if (next.t1 > to) {
          if (mt_.remover(TriangleId(next.triangle)) != node) break;
          next.z0 = next.at(std::max(next.t0, to));
          next.t0 = std::max(next.t0, to);
          if (actionOf(next) != Action::refine) break;
          ++visited_;
          to = next.t1;
        }
        ++i;
      }
      star(node.index(), from, to);
      done = to;
    }
    spans_.resize(begin);
    if (mayHaveGaps && !judge_.isDone() && last > done + shortest_)
      judge_.gap(leg_.distance(done), leg_.distance(last));
  }

  /// Gives the judge the lower bounds of the terrain at the ends of a span.
  void hint(const TriangleSpan& span) {
    const double lower = mt_.scale().decode(above_[span.triangle]);
    judge_.hint(leg_.distance(span.t0), span.z0 - lower);
    judge_.hint(leg_.distance(span.t1), span.z1 - lower);
  }

  enum class Action {
    skip,    ///< no terrain there can matter
    report,  ///< to the judge, with the triangle's bounds
    refine,  ///< finer triangles decide
  };

  bool isFinest(const TriangleSpan& span) const { return !mt_.remover(TriangleId(span.triangle)).isValid(); }

  Action actionOf(const TriangleSpan& span) const {
    if (isFinest(span)) return Action::report;
    const OutwardScale::Code below = below_[span.triangle], above = above_[span.triangle];
    const double higher = mt_.scale().decode(below);
    if (!judge_.matters(leg_.distance(span.t0), span.z0 + higher, leg_.distance(span.t1), span.z1 + higher,
                        mayFill_))
      return Action::skip;
    return !mayFill_ && allowed_ > 0 && std::max(below, above) <= allowed_ ? Action::report : Action::refine;
  }

  /// Precondition: its action is `report`.
  void report(const TriangleSpan& span) {
    const double s0 = leg_.distance(span.t0), s1 = leg_.distance(span.t1);
    if (isFinest(span))
      judge_.terrain(s0, span.z0, s1, span.z1);
    else
      judge_.terrain(s0, span.z0, s1, span.z1, mt_.scale().decode(above_[span.triangle]),
                     mt_.scale().decode(below_[span.triangle]));
  }

  void star(std::uint32_t node, double first, double last) {
    const std::size_t begin = spans_.size();
    crossing_.addStar(node, first, last, spans_);
    follow(begin, first, last, mayFill_);
  }

  // The spans of the stars below each other share one vector as a stack, so that no star allocates.
  MtCrossing crossing_;
  const MultiTriangulation& mt_;
  std::span<const OutwardScale::Code> below_, above_;
  const SightLeg& leg_;
  SightJudge& judge_;
  OutwardScale::Code allowed_;
  bool mayFill_;
  double shortest_;
  std::vector<TriangleSpan> spans_;
  std::uint64_t visited_ = 0;
  bool hasFirst_ = false, hasLast_ = false;
};

/// A line has legs, each straight in the plan. The judge gets the terrain of each in the order of distances.
class SightDescent final : public SightEngine {
 public:
  explicit SightDescent(const TerrainModel& model)
      : heights_(model), mayFill_(model.options.rimTolerance > 0) {}

  SightAnswer answer(const SightLine& line, const SightOptions& options) const override {
    SightJudge judge(line, options);
    const TriangleLocator& locator = heights_.locator();
    const OutwardScale::Code allowed = locator.mt().scale().floorCode(options.maxError);
    std::uint64_t visited = 0;
    const auto points = line.points();
    // An end that lies on no triangle, as on an isolated sample, still has a height, which the judge gets
    // alone.
    const auto addEnd = [&](const SightPoint& end) {
      if (judge.isDone()) return;
      if (const auto z = heights_.at(heights_.model().toSource(end.plan)))
        judge.terrain(end.distance, z->height, end.distance, z->height);
    };
    bool hasLast = false, isFirst = true;
    for (std::size_t i = 1; i < points.size() && !judge.isDone(); ++i) {
      const SightLeg leg(points[i - 1], points[i]);
      if (leg.isJump()) continue;
      // A leg without extent in the plan stays in one place, whose height holds for all of it.
      if (leg.dx == 0 && leg.dy == 0) {
        if (const auto z = heights_.at(heights_.model().toSource(points[i].plan))) {
          judge.terrain(leg.s, z->height, leg.distance(1), z->height);
        } else {
          judge.gap(leg.s, leg.distance(1));
        }
        hasLast = true;
        isFirst = false;
        continue;
      }
      Descent descent(locator, leg, judge, allowed, mayFill_);
      descent.findRoots();
      if (isFirst && !descent.hasFirst()) addEnd(points.front());
      isFirst = false;
      visited += descent.run();
      hasLast = descent.hasLast();
    }
    if (!hasLast) addEnd(points.back());
    return judge.answer(visited);
  }

 private:
  GroundHeights heights_;
  bool mayFill_;
};

}  // namespace

std::unique_ptr<SightEngine> makeSightDescent(const TerrainModel& model) {
  return std::make_unique<SightDescent>(model);
}

}  // namespace arete
