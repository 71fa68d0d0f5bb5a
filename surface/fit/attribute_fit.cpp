// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/attribute_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "engine/parallel/with_threads.h"
#include "surface/fit/affine_charts.h"
#include "surface/fit/element_borders.h"
#include "surface/fit/scalar_problem.h"
#include "surface/fit/sided_nearest.h"
#include "surface/fit/source_samples.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

using Corners3 = std::array<std::uint32_t, 3>;
constexpr std::uint64_t kPerTriangle = 40, kPerFace = 16, kMostOfFaces = 100'000;
/// Of the largest number: what equals the source's to this share is not fitted, and decimals of text round
/// so.
constexpr double kRoundingOfText = 2e-6;

std::vector<double> numbersOf(const Attribute& a) {
  std::vector<double> all;
  for (std::size_t e = 0; e < a.elementCount(); ++e)
    for (const double x : a.numbers(e)) all.push_back(x);
  return all;
}

/// One attribute of a cut, its source and the samples.
class OneAttribute {
 public:
  OneAttribute(SurfaceMesh& cut, const std::vector<Vec3>& before, const SurfaceMesh& source, bool areWedges,
               Attribute& of, const Attribute& from)
      : cut_(cut),
        before_(before),
        source_(source),

        attribute_(of),
        components_(of.components),
        ofCut_(elementsOf(cut, areWedges)),
        ofSource_(elementsOf(source, areWedges)),
        was_(numbersOf(of)),
        from_(numbersOf(from)) {
    for (const double x : from_)
      if (std::isfinite(x)) largest_ = std::max(largest_, std::abs(x));
    rounding_ = isFloat(of.type) ? kRoundingOfText * largest_ : 0.5 * std::sqrt(double(components_));
  }

  double rounding() const { return rounding_; }
  double rms(const SourceSamples& samples, const std::vector<NearestOfCut>& nearest,
             const std::vector<double>& numbers) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const double squared = apart(samples.whereOfArea[i], nearest[i], numbers);
      if (!std::isfinite(squared)) continue;
      sum += squared;
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
  }
  const std::vector<double>& was() const { return was_; }
  /// Of was(); not finite where a number is not.
  double apart(const SourceSamples::Where& at, const NearestOfCut& of,
               const std::vector<double>& numbers) const {
    if (of.triangle == TriangleBvh::kNone) return std::numeric_limits<double>::quiet_NaN();
    double squared = 0;
    for (std::size_t c = 0; c < components_; ++c) {
      const double d =
          at3(from_, ofSource_[at.triangle], at.shares, c) - at3(numbers, ofCut_[of.triangle], of.shares, c);
      squared += d * d;
    }
    return squared;
  }

  std::vector<double> fitted(const SourceSamples& samples, const std::vector<NearestOfCut>& nearest) {
    const std::size_t count = was_.size() / components_;
    std::vector<double> now = was_;
    std::vector<std::uint8_t> isHeld(count, 0);
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t c = 0; c < components_; ++c)
        if (!std::isfinite(was_[e * components_ + c])) isHeld[e] = 1;
    const std::vector<std::uint32_t> chartOf = place(now, isHeld);
    ScalarProblem problem(count, ofCut_);
    std::vector<std::vector<double>> right(components_, std::vector<double>(count, 0));
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (!std::isfinite(apart(samples.whereOfArea[i], nearest[i], now))) continue;
      problem.add(nearest[i].triangle, nearest[i].shares);
      const SourceSamples::Where& at = samples.whereOfArea[i];
      for (std::size_t c = 0; c < components_; ++c) {
        const double r = at3(from_, ofSource_[at.triangle], at.shares, c) -
                         at3(now, ofCut_[nearest[i].triangle], nearest[i].shares, c);
        for (std::size_t k = 0; k < 3; ++k)
          right[c][ofCut_[nearest[i].triangle][k]] += nearest[i].shares[k] * r;
      }
    }
    const bool isTangent = attribute_.meaning == AttributeMeaning::tangent;
    const std::vector<double> start = now;
    for (std::size_t c = 0; c < (isTangent ? std::min<std::size_t>(3, components_) : components_); ++c) {
      const std::vector<double> change = problem.solve(right[c], isHeld);
      for (std::size_t e = 0; e < count; ++e)
        if (isHeld[e] == 0) {
          const auto& [low, high] = rangeOf_[chartOf[e] * components_ + c];
          if (low <= high)
            now[e * components_ + c] = std::clamp(now[e * components_ + c] + change[e], low, high);
        }
    }
    if (isTangent || attribute_.meaning == AttributeMeaning::normal) keepLengths(now);
    if (attribute_.meaning == AttributeMeaning::textureCoords && components_ >= 2) keepTurns(now, start);
    return now;
  }

  void write(const std::vector<double>& numbers) {
    Attribute to = emptyLike(attribute_);
    for (std::size_t e = 0; e < attribute_.elementCount(); ++e) {
      const std::span<const double> some = std::span(numbers).subspan(e * components_, components_);
      if (std::ranges::equal(some, std::span(was_).subspan(e * components_, components_)))
        to.append(attribute_.element(e));
      else
        to.append(some);
    }
    attribute_ = std::move(to);
  }
  std::vector<double> asWritten(const std::vector<double>& numbers) const {
    Attribute to = emptyLike(attribute_);
    for (std::size_t e = 0; e < attribute_.elementCount(); ++e)
      to.append(std::span(numbers).subspan(e * components_, components_));
    return numbersOf(to);
  }

 private:
  double at3(const std::vector<double>& numbers, const Corners3& corners, const std::array<double, 3>& shares,
             std::size_t c) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (shares[k] != 0) sum += shares[k] * numbers[corners[k] * components_ + c];
    return sum;
  }
  /// Numbers that follow from the place: of affine charts, and of texture coordinates on lines.
  /// @return by element: its chart of the source, of which rangeOf_ has the ranges
  std::vector<std::uint32_t> place(std::vector<double>& now, std::vector<std::uint8_t>& isHeld) {
    const std::size_t count = now.size() / components_, ofSource = from_.size() / components_;
    const std::vector<std::uint32_t> vertexOf = verticesOfElements(cut_, ofCut_, count),
                                     sourceVertexOf = verticesOfElements(source_, ofSource_, ofSource);
    // Elements of the source by place and numbers.
    using Key = std::vector<double>;
    const auto keyOf = [&](const Vec3& p, const std::vector<double>& numbers, std::size_t e) {
      Key key = {p.x, p.y, p.z};
      for (std::size_t c = 0; c < components_; ++c) key.push_back(numbers[e * components_ + c]);
      return key;
    };
    std::map<Key, std::uint32_t> elementAt;
    for (std::uint32_t e = 0; e < ofSource; ++e)
      if (sourceVertexOf[e] != MeshAttributes::kNone)
        elementAt.emplace(keyOf(source_.positions[sourceVertexOf[e]], from_, e), e);
    const AffineCharts affine(ofSource_, sourceVertexOf, source_.positions, from_, components_,
                              std::max(rounding_, kRoundingOfText * largest_));
    // The last range covers all charts, for what has none.
    const auto charts = static_cast<std::uint32_t>(affine.function.size());
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    rangeOf_.assign((charts + 1) * components_, {kInfinity, -kInfinity});
    for (std::size_t e = 0; e < ofSource; ++e)
      for (std::size_t c = 0; c < components_; ++c)
        for (const std::size_t chart : {affine.chartOf[e], charts}) {
          const double x = from_[e * components_ + c];
          auto& [low, high] = rangeOf_[chart * components_ + c];
          if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
        }
    std::vector<std::uint32_t> chartOf(count, charts);
    const bool isPicture = attribute_.meaning == AttributeMeaning::textureCoords;
    const bool isDirection =
        attribute_.meaning == AttributeMeaning::normal || attribute_.meaning == AttributeMeaning::tangent;
    const ElementBorders borders(ofSource_, sourceVertexOf, source_.positions);
    for (std::size_t e = 0; e < count; ++e) {
      const std::uint32_t v = vertexOf[e];
      if (v == MeshAttributes::kNone || isHeld[e] != 0) continue;
      const auto found = elementAt.find(keyOf(before_[v], was_, e));
      if (found == elementAt.end()) continue;
      const std::uint32_t origin = found->second;
      chartOf[e] = affine.chartOf[origin];
      const bool isMoved = cut_.positions[v] != before_[v];
      if (isPicture && borders.isOnBorder(origin)) {
        isHeld[e] = 1;
        if (!isMoved || !borders.passes(origin)) continue;
        const ElementBorders::Place at = borders.nearest(origin, cut_.positions[v]);
        for (std::size_t c = 0; c < components_; ++c)
          now[e * components_ + c] = (1 - at.share) * from_[at.first * components_ + c] +
                                     at.share * from_[at.second * components_ + c];
        continue;
      }
      const auto& f = affine.function[affine.chartOf[origin]];
      if (!f || isDirection) continue;
      isHeld[e] = 1;
      if (!isMoved) continue;
      for (std::size_t c = 0; c < components_; ++c) {
        double gained = dot(f->gradient[c], cut_.positions[v] - before_[v]);
        now[e * components_ + c] += gained;
      }
    }
    return chartOf;
  }
  void keepLengths(std::vector<double>& now) const {
    if (components_ < 3) return;
    for (std::size_t e = 0; e < now.size(); e += components_) {
      const double wanted = std::hypot(was_[e], was_[e + 1], was_[e + 2]),
                   length = std::hypot(now[e], now[e + 1], now[e + 2]);
      for (std::size_t c = 0; c < 3; ++c)
        now[e + c] = length > 0.1 * wanted ? now[e + c] * (wanted / length) : was_[e + c];
    }
  }
  /// Corners of triangles that would turn over in the picture keep what they had.
  void keepTurns(std::vector<double>& now, const std::vector<double>& start) const {
    const auto area = [&](const std::vector<double>& uv, const Corners3& t) {
      const auto at = [&](std::uint32_t e, std::size_t c) { return uv[e * components_ + c]; };
      return (at(t[1], 0) - at(t[0], 0)) * (at(t[2], 1) - at(t[0], 1)) -
             (at(t[1], 1) - at(t[0], 1)) * (at(t[2], 0) - at(t[0], 0));
    };
    for (bool isChanged = true; isChanged;) {
      isChanged = false;
      for (const Corners3& t : ofCut_) {
        if (area(was_, t) * area(now, t) > 0 || area(was_, t) == 0) continue;
        for (const std::uint32_t e : t)
          for (std::size_t c = 0; c < components_; ++c) {
            const std::size_t i = e * components_ + c;
            isChanged = isChanged || now[i] != start[i];
            now[i] = start[i];
          }
      }
    }
  }

  SurfaceMesh& cut_;
  const std::vector<Vec3>& before_;
  const SurfaceMesh& source_;

  Attribute& attribute_;
  std::size_t components_;
  std::vector<Corners3> ofCut_, ofSource_;
  std::vector<double> was_, from_;
  std::vector<std::array<double, 2>> rangeOf_;  // by chart of the source and component, of finite numbers
  double largest_ = 0, rounding_ = 0;
};

}  // namespace

Result<std::vector<AttributeRms>> fitAttributes(SurfaceMesh& cut, const std::vector<Vec3>& before,
                                                const SurfaceMesh& source, const FitCharts& charts,
                                                std::uint64_t count, const RunContext& context) {
  std::vector<AttributeRms> all;
  if (before.size() != cut.positions.size())
    return failure(ErrorCode::invalidData, "the places before the fit are not as many as the vertices");
  std::vector<OneAttribute> attributes;
  std::vector<std::string> names;
  const auto take = [&](std::vector<Attribute>& to, const std::vector<Attribute>& from, bool areWedges) {
    for (std::size_t i = 0; i < std::min(to.size(), from.size()); ++i)
      if (to[i].name == from[i].name && to[i].components == from[i].components && !isLabel(from[i])) {
        attributes.emplace_back(cut, before, source, areWedges, to[i], from[i]);
        names.push_back(to[i].name);
      }
  };
  take(cut.vertexAttributes, source.vertexAttributes, false);
  const std::size_t ofVertices = attributes.size();
  if (cut.hasWedges() && source.hasWedges()) take(cut.wedgeAttributes, source.wedgeAttributes, true);
  if (attributes.empty()) return all;
  if (context.cancelled()) return failure(ErrorCode::interrupted, "fitting was interrupted");
  return withThreads(context, [&]() -> Result<std::vector<AttributeRms>> {
    const SourceSamples samples = sampleSource(
        source, count > 0 ? count
                          : std::max<std::uint64_t>(
                                kPerTriangle * cut.triangles.size(),
                                std::min<std::uint64_t>(kMostOfFaces, kPerFace * source.triangles.size())));
    if (samples.ofArea.empty()) return failure(ErrorCode::invalidData, "has no area to be fitted to");
    ShownDistance shown;
    if (ofVertices < attributes.size())
      shown = [&](std::size_t i, std::uint32_t t, const std::array<double, 3>& shares) {
        double sum = 0;
        for (std::size_t a = ofVertices; a < attributes.size(); ++a) {
          const double squared =
              attributes[a].apart(samples.whereOfArea[i], {t, shares}, attributes[a].was());
          if (std::isfinite(squared)) sum += std::sqrt(squared);
        }
        return sum;
      };
    SurfaceMesh old = cut;
    old.positions = before;
    const std::vector<NearestOfCut> nearestBefore =
        sidedNearest(old, samples, charts.ofSource, charts.ofCut, shown);
    const std::vector<NearestOfCut> nearest =
        sidedNearest(cut, samples, charts.ofSource, charts.ofCut, shown);
    std::vector<std::vector<double>> taken;
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "fitting was interrupted");
      OneAttribute& one = attributes[a];
      AttributeRms rms{names[a], one.rms(samples, nearestBefore, one.was()), 0, one.rounding()};
      std::vector<double> numbers = one.was();
      rms.after = one.rms(samples, nearest, numbers);
      std::vector<double> fitted = one.fitted(samples, nearest);
      const double after = one.rms(samples, nearest, one.asWritten(fitted));
      if (rms.before > rms.rounding || rms.after > rms.rounding || cut.positions != before)
        if (after <= rms.after || after <= rms.before + rms.rounding) {
          numbers = std::move(fitted);
          rms.after = after;
        }
      all.push_back(rms);
      taken.push_back(std::move(numbers));
    }
    for (std::size_t a = 0; a < attributes.size(); ++a) attributes[a].write(taken[a]);
    return all;
  });
}

}  // namespace arete
