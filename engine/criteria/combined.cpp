// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all parts accept is allowed the least of their errors, what any part accepts the largest. Both bounds
// stay bounds: a minimum or a maximum of functions that do not grow with the ball does not grow with it
// either.
#include "engine/criteria/combined.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace arete {
namespace {

enum class Rule { all, any };

bool isFineEnoughFor(const CriterionParts& parts, Rule rule, const MultiTriangulation& mt, TriangleId t,
                     const Criterion::Corners& corners) {
  const auto accepts = [&](const auto& part) { return part->isFineEnough(mt, t, corners); };
  return rule == Rule::all ? std::ranges::all_of(parts, accepts) : std::ranges::any_of(parts, accepts);
}

double severityFor(const CriterionParts& parts, Rule rule, const MultiTriangulation& mt, TriangleId t,
                   const Criterion::Corners& corners) {
  double worst = 0, least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts) {
    if (rule == Rule::any)
      least = std::min(least, part->severity(mt, t, corners));
    else if (!part->isFineEnough(mt, t, corners))
      worst = std::max(worst, part->severity(mt, t, corners));
  }
  return rule == Rule::all ? worst : least;
}

class Combined final : public Criterion {
 public:
  Combined(CriterionParts parts, Rule rule) : parts_(std::move(parts)), rule_(rule) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return isFineEnoughFor(parts_, rule_, mt, t, corners);
  }
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return severityFor(parts_, rule_, mt, t, corners);
  }

 private:
  CriterionParts parts_;
  Rule rule_;
};

/// Precondition: all parts are bounded.
class BoundedCombined final : public BoundedCriterion {
 public:
  BoundedCombined(CriterionParts parts, Rule rule) : parts_(std::move(parts)), rule_(rule) {
    for (const auto& part : parts_) bounds_.push_back(part->bounded());
  }
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return isFineEnoughFor(parts_, rule_, mt, t, corners);
  }
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return severityFor(parts_, rule_, mt, t, corners);
  }
  double allowedError(const Sphere& s) const override {
    return combined([&](const BoundedCriterion& part) { return part.allowedError(s); });
  }
  double mostAllowed(const Sphere& s) const override {
    return combined([&](const BoundedCriterion& part) { return part.mostAllowed(s); });
  }
  std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const override {
    std::uint64_t any = 0, all = ~std::uint64_t(0);
    for (const BoundedCriterion* part : bounds_) {
      const std::uint64_t bits = part->exceeding(balls, errors);
      any |= bits;
      all &= bits;
    }
    return rule_ == Rule::all ? any : all;
  }

 private:
  /// The least of the parts' values when all must accept, else the largest.
  template <class Value>
  double combined(const Value& value) const {
    double result = rule_ == Rule::all ? std::numeric_limits<double>::infinity() : 0;
    for (const BoundedCriterion* part : bounds_)
      result = rule_ == Rule::all ? std::min(result, value(*part)) : std::max(result, value(*part));
    return result;
  }

  CriterionParts parts_;
  std::vector<const BoundedCriterion*> bounds_;  // of the parts, in order
  Rule rule_;
};

std::shared_ptr<const Criterion> combine(CriterionParts parts, Rule rule) {
  if (std::ranges::all_of(parts, [](const auto& part) { return part->bounded() != nullptr; }))
    return std::make_shared<BoundedCombined>(std::move(parts), rule);
  return std::make_shared<Combined>(std::move(parts), rule);
}

}  // namespace

std::shared_ptr<const Criterion> allOf(CriterionParts parts) {
  return combine(std::move(parts), Rule::all);
}

std::shared_ptr<const Criterion> anyOf(CriterionParts parts) {
  return combine(std::move(parts), Rule::any);
}

}  // namespace arete
