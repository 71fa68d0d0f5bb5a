// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bound below the largest error is reached when every triangle beyond it can be brought within it, one
// patch at a time, the worst first, without increasing other violations: each patch leaves fewer violations,
// so this terminates. The least bound that can be reached is found by bisection. Few triangles have errors
// near the largest, so most bounds need a few patches only.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "terrain/fit/removal.h"
#include "terrain/fit/steps.h"

namespace arete {
namespace {

constexpr double kFirstStep = 0.9;  // of the largest error, until a bound is not reached
constexpr double kEnough = 0.995;   // the ratio of bounds at which the bisection ends

class LargestErrorDescent {
 public:
  LargestErrorDescent(FitMesh& mesh, std::uint32_t rings, const RunContext& context)
      : mesh_(mesh), rings_(rings), context_(context), patches_(mesh), unit_(mesh.bounds()) {
    unit_.of.clear();
    unit_.everywhere = 1;
  }

  Status run() {
    double reached = worst(), missed = 0;
    std::vector<double> best = mesh_.heights();
    // An error within rounding cannot be reduced: patches have rounding errors of their own.
    while (reached > unit_.rounding && missed < kEnough * reached && std::isfinite(reached)) {
      const double bound = missed > 0 ? (missed + reached) / 2 : kFirstStep * reached;
      if (!(missed < bound && bound < reached)) break;  // neighbouring doubles
      ARETE_TRY(const bool isReached, reach(bound));
      if (isReached) {
        reached = std::min(bound, worst());
        best = mesh_.heights();
      } else {
        missed = bound;
        mesh_.setHeights(best);
      }
    }
    return {};
  }

 private:
  void setBound(double bound) {
    FitBounds bounds = unit_;
    bounds.everywhere = bound;
    mesh_.setBounds(std::move(bounds));
    mesh_.setAccepted(1);
  }

  double worst() {
    setBound(1);
    double worst = 0;
    for (std::uint32_t t = 0; t < mesh_.slotCount(); ++t) worst = std::max(worst, mesh_.severity(t));
    return worst;
  }

  Result<bool> reach(double bound) {
    setBound(bound);
    std::vector<std::pair<double, std::uint32_t>> beyond;
    for (std::uint32_t t = 0; t < mesh_.slotCount(); ++t)
      if (const double s = mesh_.severity(t); s > 1) beyond.emplace_back(-s, t);
    std::ranges::sort(beyond);
    for (const auto& [unused, slot] : beyond) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the fit was interrupted");
      if (mesh_.severity(slot) <= 1) continue;
      if (!patches_.tryTriangle(slot, rings_)) return false;
      for (std::size_t i = 0; i < patches_.moved().size(); ++i)
        mesh_.raise(patches_.moved()[i], patches_.rises()[i]);
    }
    return true;
  }

  FitMesh& mesh_;
  const std::uint32_t rings_;
  const RunContext& context_;
  FitPatches patches_;
  FitBounds unit_;
};

}  // namespace

Status minimizeLargestError(FitMesh& mesh, std::uint32_t rings, const RunContext& context) {
  return LargestErrorDescent(mesh, rings, context).run();
}

}  // namespace arete
