// SPDX-License-Identifier: GPL-3.0-or-later
//
// All fans that may fill the hole are measured, those around near corners first; each stops where its
// integral exceeds the least so far. Late in a build a star stands for many faces, of which a sample is taken
// with larger weights: the cost decides the order of removals, not what is certain of them.
#include "surface/simplify/cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

/// Factor of the integral of a fan that folds the surface: it delays the removal until the threshold has
/// grown eightfold, when most of what lies around has changed.
constexpr double kFoldWeight = 64;
/// Of the square of a line's largest deviation and of its new edge's length: about what a surface has that is
/// a pyramid as high over a hexagon with such edges.
constexpr double kLineWeight = 0.4;

}  // namespace

void SurfaceCost::collectSamples() {
  samples_.clear();
  std::size_t pieces = 0;
  const Star& star = hole_.star();
  for (int i = 0; i < star.triangleCount; ++i) {
    const PieceList& list = s_.pieces[star.slot(i)];
    pieces += list.isEmpty() ? 1 : list.size();
  }
  const std::size_t step = pieces / (kMostSamples * 2 / 3) + 1;
  std::size_t number = 0;
  otherSide_ = {0, 0};
  for (int i = 0; i < star.triangleCount; ++i) {
    for (std::size_t end = 0; end < 2; ++end)
      if (i == hole_.line().ends[end]) otherSide_[end] = samples_.size();
    const SlotId slot = star.slot(i);
    const PieceList& list = s_.pieces[slot];
    const auto add = [&](const Piece& piece) {
      if (number++ % step == 0 && piece.across == 0) s_.samples.append(piece, samples_);
    };
    if (list.isEmpty()) add({s_.labelsOf(slot).face, 0, wholeFace()});
    list.forEach(add);
  }
  if (step > 1)
    for (SurfaceSample& sample : samples_) sample.area *= double(step);
}

double SurfaceCost::squaredOf(const SurfaceSample& sample) {
  if (s_.field.isEmpty()) return fan_.nearest(sample.place);
  FloorDistance::Squares squares;
  fan_.squares(sample.place, squares);
  const auto nearest = static_cast<std::size_t>(
      std::min_element(squares.begin(), squares.begin() + fan_.size()) - squares.begin());
  wanted_.resize(s_.field.components());
  s_.field.mean(s_.field.cornersOf(sample.face), sample.shares, wanted_);
  // What is only weighed is compared where it is drawn: at the nearest point.
  if (!s_.boundsAttributes) return joint_.squaredAtNearest(nearest, sample.place, wanted_);
  double least = joint_.squared(nearest, sample.place, wanted_);
  for (std::size_t t = 0; t < joint_.size(); ++t)
    if (t != nearest && squares[t] < least) least = std::min(least, joint_.squared(t, sample.place, wanted_));
  return least;
}

double SurfaceCost::integralOver(int corner, double limit) {
  const HoleTriangulation fan = fanAround(corner, hole_.corners());
  const StarLine& line = hole_.line();
  double sum = 0;
  for (int side = 0; side < (line.isThere() ? 2 : 1); ++side) {
    fan_.clear();
    joint_.clear();
    for (const auto& corners : fan.view()) {
      if (line.sideOf(corners) != side) continue;
      const auto& [i, j, m] = corners;
      const SpaceTriangle triangle{hole_.corner(i), hole_.corner(j), hole_.corner(m)};
      fan_.add(triangle);
      if (!s_.field.isEmpty()) {
        const auto vertex = [&](int c) { return hole_.star().link[c].index(); };
        joint_.add(triangle, s_.parts.hasWedges ? hole_.labelsOf(s_, corners).wedges
                                                : std::array{vertex(i), vertex(j), vertex(m)});
      }
      sum += star_[static_cast<std::size_t>(side)].nearest((triangle[0] + triangle[1] + triangle[2]) / 3.0) *
             norm(fan_.normal(fan_.size() - 1)) / 2;
    }
    if (sum > limit) return sum;
    if (fan_.size() == 0) continue;  // what goes across a line: integralAlongLine()
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if ((i >= otherSide_[0] && i < otherSide_[1]) != (side == 1)) continue;
      sum += squaredOf(samples_[i]) * samples_[i].area;
      if (sum > limit) return sum;
    }
  }
  return sum;
}

double SurfaceCost::integralAlongLine() const {
  const StarLine& line = hole_.line();
  if (!line.isThere()) return 0;
  const VertexId first = hole_.star().link[line.ends[0]], second = hole_.star().link[line.ends[1]];
  const Vec3 a = s_.position(first), along = s_.position(second) - a;
  const double squaredLength = dot(along, along);
  const auto squaredFrom = [&](const Vec3& p) {
    const Vec3 away = p - a;
    const double at = squaredLength > 0 ? std::clamp(dot(away, along) / squaredLength, 0.0, 1.0) : 0;
    return squaredDistance(away, at * along);
  };
  double squared = squaredFrom(hole_.apex());
  for (const VertexId way : s_.lineNext[hole_.vertex()]) {
    VertexId before = hole_.vertex();
    for (VertexId at = way; at.isValid() && at != first && at != second && at != hole_.vertex();) {
      squared = std::max(squared, squaredFrom(s_.position(at)));
      const auto& [one, other] = s_.lineNext[at];
      at = std::exchange(before, at) == one ? other : one;
    }
  }
  return kLineWeight * squared * squaredLength;
}

double SurfaceCost::integralBeyondBorder() const {
  const Star& star = hole_.star();
  if (!star.isOpen || s_.borderNext.size() == 0) return 0;
  const int last = hole_.corners() - 1;
  const Vec3 a = hole_.corner(last), along = hole_.corner(0) - a;
  const double squaredLength = dot(along, along);
  Vec3 inwards{};
  for (int i = 1; i < last; ++i) inwards = inwards + (hole_.corner(i) - a);
  if (!(squaredLength > 0)) return 0;
  inwards = inwards - (dot(inwards, along) / squaredLength) * along;
  double squared = 0;
  const VertexId end = star.link[0];
  const bool countsAll = s_.parts.hasLines();
  for (VertexId v = s_.borderNext[star.link[last]]; v.isValid() && v != end; v = s_.borderNext[v]) {
    const Vec3 away = s_.position(v) - a;
    if (!countsAll && !(dot(away, inwards) > 0)) continue;
    const double at = std::clamp(dot(away, along) / squaredLength, 0.0, 1.0);
    squared = std::max(squared, squaredDistance(away, at * along));
  }
  // Borders and lines of equal deviation are removed at once, or the one would force the other to stay.
  if (countsAll) return kLineWeight * squared * squaredLength;
  // The cost of a rectangle at the full depth of the gap. A smaller cost would let triangles span deep gaps.
  return std::sqrt(squaredLength * squared) * squared;
}

bool SurfaceCost::isStillValid(VertexId v, const RemovalRecord& record) {
  if (!hole_.gather(s_, v) || !hole_.mayBeFilled(s_)) return false;
  const auto link = hole_.star().linkView();
  const auto corner = std::ranges::find(link, VertexId(record.witness)) - link.begin();
  return hole_.keepsTopology(s_, static_cast<int>(corner)) && !hole_.folds(s_, static_cast<int>(corner));
}

void SurfaceCost::evaluate(VertexId v, double threshold, RemovalRecord& record) {
  using State = RemovalRecord::State;
  if (!hole_.gather(s_, v) || !hole_.mayBeFilled(s_)) {
    record.state = State::stuck;
    return;
  }
  record.linkSize = static_cast<std::uint8_t>(hole_.corners());
  struct Candidate {
    int corner;
    double squared;
  };
  std::array<Candidate, kMaxHoleCorners> candidates;
  int count = 0;
  for (int i = 0; i < hole_.corners(); ++i)
    if (hole_.keepsShape(i)) candidates[count++] = {i, squaredDistance(hole_.corner(i), hole_.apex())};
  std::sort(candidates.begin(), candidates.begin() + count,
            [](const Candidate& a, const Candidate& b) { return a.squared < b.squared; });
  // A cost c is an integral of c^2.
  const double unit = s_.unit * s_.unit, limit = threshold * kExactUpTo / unit, most = limit * limit;
  double least = std::numeric_limits<double>::infinity();
  int best = -1;
  double above = std::numeric_limits<double>::infinity();
  bool hasSamples = false;
  const double gap = integralBeyondBorder() + integralAlongLine();
  for (int k = 0; k < count; ++k) {
    const int corner = candidates[k].corner;
    if (!hole_.keepsTopology(s_, corner)) continue;
    if (!hasSamples) {
      collectSamples();
      for (FloorDistance& side : star_) side.clear();
      for (int t = 0; t < hole_.star().triangleCount; ++t)
        star_[static_cast<std::size_t>(hole_.line().sideOfStar(t))].add(
            {hole_.apex(), hole_.corner(t), hole_.corner(t + 1 < hole_.corners() ? t + 1 : 0)});
      hasSamples = true;
    }
    const double weight = hole_.folds(s_, corner) ? kFoldWeight : 1;
    const double sum = weight * (gap + integralOver(corner, std::min(least, most) / weight - gap));
    if (sum > most) above = std::min(above, sum);
    if (sum > most || sum >= least) continue;
    least = sum;
    best = corner;
  }
  if (best >= 0) {
    record.cost = static_cast<float>(std::sqrt(least) * unit);
    record.witness = hole_.star().link[best].index();
    record.state = State::exact;
  } else if (above < std::numeric_limits<double>::infinity()) {
    // Above a limit of 0 the cost must be above 0, or the vertex would be due in every level.
    record.cost = std::max(static_cast<float>(std::sqrt(above) * unit), std::numeric_limits<float>::min());
    record.state = State::atLeast;
  } else {
    record.state = State::stuck;
  }
}

}  // namespace arete
