// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/importance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/float_bounds.h"
#include "engine/base/nearest_on_triangle.h"

namespace arete {
namespace {

/// After as many descents what is certain of the rest is taken.
constexpr int kMostDescents = 16;
/// A descent ends where no more than this share is to be gained above the triangle's own corners.
constexpr float kNearEnough = 1.03f;

/// What a normalised integer is divided by.
double unitOf(const Attribute& attribute) {
  if (!attribute.isNormalized || isFloat(attribute.type)) return 1;
  switch (attribute.type) {
    case ScalarType::int8:
      return 127;
    case ScalarType::uint8:
      return 255;
    case ScalarType::int16:
      return 32'767;
    case ScalarType::uint16:
      return 65'535;
    case ScalarType::int32:
      return 2'147'483'647;
    default:
      return 4'294'967'295;
  }
}

/// Finds the largest importance of triangles.
class LargestImportance {
 public:
  /// @param most of the finest triangles itself, of others what their corners have, which is too little
  LargestImportance(const SurfaceModel& model, std::vector<float>& most)
      : mt_(model.mt), most_(most), rounding_(1e-9 * model.diagonal) {}

  void ofCoarse() {
    for (std::uint32_t n = mt_.nodeCount(); n-- > 0;)
      for (const std::uint32_t t : mt_.floor(NodeId(n))) most_[t] = ofTriangle(TriangleId(t));
  }

 private:
  struct Ball {
    Vec3 middle;
    double radius;
  };
  struct Candidate {
    float most;
    std::uint32_t triangle;
    bool operator<(const Candidate& other) const { return most < other.most; }
  };

  SpaceTriangle placeOf(TriangleId t) const {
    const auto [a, b, c] = mt_.corners(t);
    return {mt_.position(VertexId(a)), mt_.position(VertexId(b)), mt_.position(VertexId(c))};
  }
  Ball around(TriangleId t) const {
    const SpaceTriangle place = placeOf(t);
    const Vec3 middle = (place[0] + place[1] + place[2]) / 3.0;
    double radius = 0;
    for (const Vec3& p : place) radius = std::max(radius, norm(p - middle));
    return {middle, radius};
  }

  /// Adds those that replace a triangle and may stand for a part of `whole`.
  void descend(TriangleId from, const SpaceTriangle& whole, double error) {
    const NodeId n = mt_.remover(from);
    if (std::ranges::find(descended_, n.index()) != descended_.end()) return;
    descended_.push_back(n.index());
    for (std::uint32_t slot = 0; slot < mt_.ceilingSize(n); ++slot) {
      const TriangleId finer = mt_.slotTriangle(n, slot);
      const Ball ball = around(finer);
      const double reach = ball.radius + error + mt_.error(finer) + rounding_;
      if (distanceToTriangle(ball.middle, whole) > reach) continue;
      candidates_.push_back({most_[finer.index()], finer.index()});
      std::push_heap(candidates_.begin(), candidates_.end());
    }
  }

  float ofTriangle(TriangleId t) {
    const SpaceTriangle whole = placeOf(t);
    const float ofCorners = most_[t.index()];
    candidates_.clear();
    descended_.clear();
    descend(t, whole, mt_.error(t));
    for (int descents = 0; !candidates_.empty(); ++descents) {
      const Candidate best = candidates_.front();
      const bool isFinest = !mt_.remover(TriangleId(best.triangle)).isValid();
      if (isFinest || descents == kMostDescents || best.most <= kNearEnough * ofCorners) return best.most;
      std::pop_heap(candidates_.begin(), candidates_.end());
      candidates_.pop_back();
      descend(TriangleId(best.triangle), whole, mt_.error(t));
    }
    return ofReplaced(t);
  }

  /// Without a thought of where they are.
  float ofReplaced(TriangleId t) const {
    float most = 0;
    const NodeId n = mt_.remover(t);
    for (std::uint32_t slot = 0; slot < mt_.ceilingSize(n); ++slot)
      most = std::max(most, most_[mt_.slotTriangle(n, slot).index()]);
    return most;
  }

  const MultiTriangulation& mt_;
  std::vector<float>& most_;
  double rounding_;
  std::vector<Candidate> candidates_;     // a heap
  std::vector<std::uint32_t> descended_;  // nodes
};

}  // namespace

Result<Importance> importanceOf(const SurfaceModel& model, const Attribute& attribute, bool ofWedges) {
  const MultiTriangulation& mt = model.mt;
  Importance found{.most = std::vector<float>(mt.triangleIdCount(), 0),
                   .largest = 0,
                   .least = std::numeric_limits<double>::infinity()};
  const double unit = unitOf(attribute);
  std::vector<double> values(attribute.elementCount());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = attribute.numbers(i).front() / unit;
  // A face that was split has parts whose corners lie inside it, and are another's.
  std::vector<float> ofFace(model.sourceFaces, 0);
  std::optional<std::pair<std::uint32_t, double>> first;  // that divides nothing, and its number
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    const NodeId remover = mt.remover(TriangleId(t)), creator = mt.creator(TriangleId(t));
    if (remover.isValid() && remover == creator) continue;  // a slot that is no triangle
    const std::array<std::uint32_t, 3> corners = mt.corners(TriangleId(t), creator);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = values[ofWedges ? model.wedgesOf[t][i] : corners[i]];
      const bool divides = value > 0 && std::isfinite(value);
      if (!divides && (!first || model.vertexOf[corners[i]] < first->first))
        first = {model.vertexOf[corners[i]], value};
      most = std::max(most, value);
      found.least = std::min(found.least, value);
    }
    found.most[t] = floatAtLeast(most);
    found.largest = std::max(found.largest, double{found.most[t]});
    if (!remover.isValid()) ofFace[model.faceOf[t]] = std::max(ofFace[model.faceOf[t]], found.most[t]);
  }
  if (first)
    return failure(ErrorCode::invalidData,
                   fmt::format("is {} at vertex {} of the source (the first is 0); what divides a tolerance "
                               "has to be above 0 and finite",
                               first->second, first->first),
                   attribute.name);
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) found.most[t] = ofFace[model.faceOf[t]];
  LargestImportance(model, found.most).ofCoarse();
  return found;
}

bool ImportanceCriterion::isFineEnough(const MultiTriangulation& mt, TriangleId t,
                                       const Corners& corners) const {
  const double times = importance_.of(t);
  if (times >= 1 && !criterion_.isFineEnough(mt, t, corners)) return false;
  if (times == 1) return true;
  const double error = mt.error(t);
  if (const std::optional<double> everywhere = criterion_.uniformError()) return error * times <= *everywhere;
  // A ball around the part of the source that the triangle stands for: within its error of it.
  const MetricFrame& metric = mt.metric();
  std::array<Vec3, 3> places;
  for (std::size_t i = 0; i < 3; ++i) places[i] = metric.toMetric(mt.position(VertexId(corners[i])));
  const Vec3 middle = (places[0] + places[1] + places[2]) / 3.0;
  double radius = 0;
  for (const Vec3& p : places) radius = std::max(radius, norm(p - middle));
  const double rounding = 1e-6 * (norm(middle) + radius + error);
  const Sphere ball{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z),
                    floatAtLeast(radius + error + rounding)};
  return error * times <= criterion_.allowedError(ball);
}

}  // namespace arete
