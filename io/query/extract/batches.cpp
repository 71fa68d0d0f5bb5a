// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places are sorted along a curve that visits quarter after quarter of their box [Morton1966], and
// the sorted places are halved until each half fits. A half that is refused has read the directory of the
// model and no more.
#include "io/query/extract/batches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/caught_failure.h"
#include "engine/base/morton.h"
#include "engine/memory/pages.h"
#include "engine/memory/required_memory.h"

namespace arete {
namespace {

/// Cells of the curve along each axis, less 1.
constexpr double kCurveSteps = 65535;

std::vector<std::uint32_t> byPlace(std::span<const Vec2> places) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Vec2 p : places) {
    if (!std::isfinite(p.x + p.y)) continue;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const auto stepOf = [](double x, double from, double to) {
    const double part = (x - from) / (to - from) * kCurveSteps;
    return part > 0 ? static_cast<std::uint32_t>(std::min(part, kCurveSteps)) : 0u;
  };
  std::vector<std::uint64_t> keys(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    keys[i] = mortonCode(stepOf(places[i].x, low.x, high.x), stepOf(places[i].y, low.y, high.y));
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return keys[i]; });
  return order;
}

Status answerGuarded(const AnswerBatch& answer, std::span<const std::uint32_t> questions) try {
  return answer(questions);
} catch (...) {
  return caughtFailure();
}

Status answerHalves(std::span<std::uint32_t> sorted, const AnswerBatch& answer) {
  const std::size_t half = sorted.size() / 2;
  for (const auto part : {sorted.first(half), sorted.subspan(half)}) {
    std::vector<std::uint32_t> questions(part.begin(), part.end());
    std::ranges::sort(questions);
    giveFreeHeapBack();  // what the batch before has freed counts as in use until then
    Status status = answerGuarded(answer, questions);
    if (!status && status.error().code == ErrorCode::outOfMemory && part.size() > 1)
      status = answerHalves(part, answer);
    if (!status) return status;
  }
  return {};
}

}  // namespace

Status answerInBatches(std::span<const Vec2> places, const AnswerBatch& answer) {
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  if (memoryBudget() == 0) return answer(all);
  const Status status = answerGuarded(answer, all);
  if (status || status.error().code != ErrorCode::outOfMemory || places.size() < 2) return status;
  std::vector<std::uint32_t> sorted = byPlace(places);
  return answerHalves(sorted, answer);
}

}  // namespace arete
