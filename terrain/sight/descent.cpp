// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle of the multitriangulation bounds the terrain of full resolution over all of it: z_triangle -
// z_terrain is in [-below, above]. Where the line passes it, the judge is asked whether terrain as high as
// the bound allows would matter. If not, all that is finer there is passed over. If so, the node that removes
// the triangle has a star over the same ground; the triangles of the star that the line crosses are treated
// the same way, in their order, down to the finest, which are the terrain (De Floriani and Magillo 1994, for
// rays on a hierarchy; VARIANT 2000, for refining along a ray).
// Triangles next to each other that one node removes are entered once.
#include <algorithm>
#include <span>
#include <vector>

#include "terrain/locate/surface_height.h"
#include "terrain/locate/triangle_locator.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/mt_crossing.h"
#include "terrain/sight/walk.h"

namespace arete {
namespace {

class Descent {
 public:
  Descent(const TriangleLocator& locator, const SightPiece& piece, SightJudge& judge,
          OutwardScale::Code allowed, bool mayFill)
      : crossing_(locator, piece),
        arrays_(locator.mt().arrays()),
        piece_(piece),
        judge_(judge),
        allowed_(allowed),
        mayFill_(mayFill),
        shortest_(crossing_.shortest()) {}

  /// The root triangles below the piece.
  void findRoots() {
    crossing_.addRoots(spans_);
    for (const TriangleSpan& span : spans_) {
      hasFirst_ = hasFirst_ || (span.t0 <= shortest_ && span.t1 > shortest_);
      hasLast_ = hasLast_ || (span.t1 >= 1 - shortest_ && span.t0 < 1 - shortest_);
    }
  }
  /// Precondition: findRoots().
  std::uint64_t run() {
    follow(0, 0, 1, true);
    return visited_;
  }
  /// Whether there is terrain on the line up to its ends; if not, an end may still stand on a corner of it.
  bool hasFirst() const { return !mayFill_ && hasFirst_; }
  bool hasLast() const { return !mayFill_ && hasLast_; }

 private:
  /// Treats the spans from `begin` on, which cover [first, last] but for gaps, in order, and drops them.
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
        if (mayHaveGaps) judge_.gap(piece_.distance(done), piece_.distance(span.t0));
      }
      const double from = std::max(span.t0, done);
      span.z0 = span.at(from);
      span.t0 = from;
      ++visited_;
      const Says says = saysOf(span);
      if (says == Says::enough) tell(span);
      if (says != Says::tooLittle) {
        done = span.t1;
        continue;
      }
      // As far as the same node goes on. What comes after it is told after it.
      const std::uint32_t node = arrays_.remover[span.triangle];
      double to = span.t1;
      while (i < end && spans_[i].t0 <= to + shortest_) {
        TriangleSpan next = spans_[i];
        if (next.t1 > to) {
          if (arrays_.remover[next.triangle] != node) break;
          next.z0 = next.at(std::max(next.t0, to));
          next.t0 = std::max(next.t0, to);
          if (saysOf(next) != Says::tooLittle) break;
          ++visited_;
          to = next.t1;
        }
        ++i;
      }
      star(node, from, to);
      done = to;
    }
    spans_.resize(begin);
    if (mayHaveGaps && !judge_.isDone() && last > done + shortest_)
      judge_.gap(piece_.distance(done), piece_.distance(last));
  }

  /// Terrain that the bound of a triangle promises.
  void hint(const TriangleSpan& span) {
    const double lower = arrays_.scale.decode(arrays_.above[span.triangle]);
    judge_.hint(piece_.distance(span.t0), span.z0 - lower);
    judge_.hint(piece_.distance(span.t1), span.z1 - lower);
  }

  /// What the triangle of a span says of the terrain there.
  enum class Says {
    nothing,    ///< of importance, and what is finer neither
    enough,     ///< to be told, with its bounds
    tooLittle,  ///< what is finer has to be looked at
  };

  Says saysOf(const TriangleSpan& span) const {
    if (arrays_.remover[span.triangle] == MultiTriangulation::kNone) return Says::enough;
    const OutwardScale::Code below = arrays_.below[span.triangle], above = arrays_.above[span.triangle];
    const double higher = arrays_.scale.decode(below);
    if (!judge_.matters(piece_.distance(span.t0), span.z0 + higher, piece_.distance(span.t1),
                        span.z1 + higher, mayFill_))
      return Says::nothing;
    return !mayFill_ && allowed_ > 0 && std::max(below, above) <= allowed_ ? Says::enough : Says::tooLittle;
  }

  /// Precondition: it says enough.
  void tell(const TriangleSpan& span) {
    const double s0 = piece_.distance(span.t0), s1 = piece_.distance(span.t1);
    if (arrays_.remover[span.triangle] == MultiTriangulation::kNone)
      judge_.terrain(s0, span.z0, s1, span.z1);
    else
      judge_.terrain(s0, span.z0, s1, span.z1, arrays_.scale.decode(arrays_.above[span.triangle]),
                     arrays_.scale.decode(arrays_.below[span.triangle]));
  }

  void star(std::uint32_t node, double first, double last) {
    const std::size_t mine = spans_.size();
    crossing_.addStar(node, first, last, spans_);
    follow(mine, first, last, mayFill_);
  }

  MtCrossing crossing_;
  const MtArrays& arrays_;
  const SightPiece& piece_;
  SightJudge& judge_;
  OutwardScale::Code allowed_;
  bool mayFill_;
  double shortest_;
  std::vector<TriangleSpan> spans_;
  std::uint64_t visited_ = 0;
  bool hasFirst_ = false, hasLast_ = false;
};

class SightDescent final : public SightEngine {
 public:
  explicit SightDescent(const TerrainModel& model)
      : heights_(model), mayFill_(model.options.rimTolerance > 0) {}

  SightAnswer answer(const SightLine& line, const SightOptions& options) const override {
    SightJudge judge(line, options);
    const TriangleLocator& locator = heights_.locator();
    const OutwardScale::Code allowed = locator.mt().arrays().scale.floorCode(options.maxError);
    std::uint64_t visited = 0;
    const auto points = line.points();
    const auto tellEnd = [&](const SightPoint& end) {
      if (judge.isDone()) return;
      if (const auto z = heights_.at(heights_.model().toSource(end.plan)))
        judge.terrain(end.distance, z->height, end.distance, z->height);
    };
    bool hasLast = false;
    for (std::size_t i = 1; i < points.size() && !judge.isDone(); ++i) {
      const SightPiece piece(points[i - 1], points[i]);
      if (piece.dx == 0 && piece.dy == 0) {
        if (const auto z = heights_.at(heights_.model().toSource(points[i].plan))) {
          judge.terrain(piece.s, z->height, piece.distance(1), z->height);
        } else {
          judge.gap(piece.s, piece.distance(1));
        }
        hasLast = true;
        continue;
      }
      Descent descent(locator, piece, judge, allowed, mayFill_);
      descent.findRoots();
      if (i == 1 && !descent.hasFirst()) tellEnd(points.front());
      visited += descent.run();
      hasLast = descent.hasLast();
    }
    if (!hasLast) tellEnd(points.back());
    return judge.answer(visited);
  }

 private:
  SurfaceHeights heights_;
  bool mayFill_;
};

}  // namespace

std::unique_ptr<SightEngine> makeSightDescent(const TerrainModel& model) {
  return std::make_unique<SightDescent>(model);
}

}  // namespace arete
