// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/fit_front.h"

#include <algorithm>
#include <utility>

#include "io/query/surface/take_surface.h"
#include "surface/fit/attribute_fit.h"
#include "surface/fit/fit.h"
#include "surface/fit/fit_lines.h"
#include "surface/fit/held_vertices.h"

namespace arete {
namespace {

/// Fits of the mesh of a cut, and what they are measured by.
class FrontFit {
 public:
  FrontFit(SurfaceFront& front, const SurfaceMesh& source, const ChartsOfCut& charts, double cutError,
           std::optional<double> maxError, const RunContext& context, double positionError)
      : front_(front),
        asCut_(front.mesh),
        source_(source),
        charts_(charts),
        cutError_(cutError),
        maxError_(maxError),
        context_(context),
        positionError_(positionError) {}

  struct Moves {
    std::vector<std::uint8_t> isHeld;
    const FitLines* lines;
    double lineWeight;
    std::optional<FittedSurface> fitted = {};
  };
  /// Makes the largest part of moves that keeps what is to be kept, of the first that do. Otherwise the mesh
  /// is the cut's again.
  Result<FitOutcome> run(std::vector<Moves> all) {
    for (const double part : {1.0, 0.5, 0.25, 0.125})
      for (Moves& moves : all) {
        if (!moves.fitted) {
          ARETE_TRY(moves.fitted, fitSurface(asCut_.shape(), moves.isHeld, source_.shape(),
                                             {.lineWeight = moves.lineWeight}, context_, *moves.lines));
        }
        const FittedSurface& fitted = *moves.fitted;
        FitOutcome outcome{fitted.rmsBefore + positionError_, fitted.rmsAfter + positionError_, cutError_,
                           part};
        // What is not moved has the error of the cut.
        if (fitted.steps == 0) {
          if (&moves == &all.back()) return outcome;
          continue;
        }
        ARETE_TRY(const bool isKept, make(part, fitted, *moves.lines, outcome));
        if (!isKept) {
          front_.mesh = asCut_;
          continue;
        }
        if (part < 1) {
          ARETE_TRY(const FittedSurface measured,
                    fitSurface(front_.mesh.shape(), moves.isHeld, source_.shape(), {.steps = 0}, context_));
          outcome.rmsAfter = measured.rmsBefore + positionError_;
        }
        return outcome;
      }
    const double rms = all.back().fitted->rmsBefore + positionError_;
    return FitOutcome{rms, rms, cutError_, 0};
  }

 private:
  /// Makes a part of the moves. Attributes follow, and no root mean square of one grows; lines stay as near
  /// to the source's as the distance that is stated, or as they were, and do not bring the surface across
  /// itself. @return whether all of it is so
  Result<bool> make(double part, const FittedSurface& fitted, const FitLines& lines, FitOutcome& outcome) {
    const std::vector<Vec3>& before = asCut_.positions;
    for (std::size_t v = 0; v < before.size(); ++v)
      front_.mesh.positions[v] =
          part == 1 ? fitted.positions[v] : before[v] + part * (fitted.positions[v] - before[v]);
    ARETE_TRY(const double distance,
              distanceByChart(source_.shape(), front_.mesh.shape(), charts_, context_));
    outcome.distance = distance + positionError_;
    if (maxError_ && outcome.distance > *maxError_) return false;
    if (fitted.lineAfter > std::max(distance, fitted.lineBefore)) return false;
    const FitCharts fitCharts{charts_.ofSource, charts_.ofCut};
    ARETE_TRY(outcome.attributes, fitAttributes(front_.mesh, before, source_, fitCharts, 0, context_));
    if (std::ranges::any_of(outcome.attributes, &AttributeRms::hasGrown)) return false;
    if (lines.isEmpty()) return true;
    ARETE_TRY(const std::uint64_t crossings, crossingsOf(front_.mesh, context_));
    if (crossings == 0) return true;
    ARETE_TRY(const std::uint64_t ofCut, crossingsOf(asCut_, context_));
    return crossings <= ofCut;
  }

  SurfaceFront& front_;
  const SurfaceMesh asCut_;
  const SurfaceMesh& source_;
  const ChartsOfCut& charts_;
  const double cutError_;
  const std::optional<double> maxError_;
  const RunContext& context_;
  const double positionError_;
};

}  // namespace

Result<FitOutcome> fitFront(SurfaceFront& front, const SurfaceMesh& source, const ChartsOfCut& charts,
                            bool keepsBorders, double cutError, std::optional<double> maxError,
                            const RunContext& context, double positionError) {
  const std::vector<std::uint8_t> isHeld = heldVertices(front.mesh, keepsBorders);
  const FitLines lines = fitLines(front.mesh, source), none;
  std::vector<FrontFit::Moves> all;
  if (!lines.isEmpty()) {
    std::vector<std::uint8_t> heldBesideLines = isHeld;
    for (std::size_t v = 0; v < isHeld.size(); ++v)
      if (lines.mayMove[v] != 0) heldBesideLines[v] = 0;
    // Nearer to the lines where attributes want it.
    const double usual = SurfaceFitOptions().lineWeight;
    for (const double weight : {usual, 4 * usual}) all.push_back({heldBesideLines, &lines, weight});
  }
  all.push_back({isHeld, &none, 0});
  return FrontFit(front, source, charts, cutError, maxError, context, positionError).run(std::move(all));
}

}  // namespace arete
