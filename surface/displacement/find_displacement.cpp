// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is in the uniform cuts for tolerances from the saturated error of the node that removes it to
// that of the node that creates it. Each of its samples asks that the triangle, displaced by the scale that
// its root mean square error stands for, comes nearer: along its normal, and a little across it. The
// samples' weights are their areas in units of the square of that scale, and the logarithm of the ratio of
// those tolerances, so that every octave of tolerances counts alike.
//
// A second pass finds the reaches of the directions, rounded as they are stored
// (surface/displacement/reach.h).
#include "surface/displacement/find_displacement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_shares.h"
#include "engine/cut/cut.h"
#include "engine/parallel/with_threads.h"
#include "surface/displacement/direction_problem.h"
#include "surface/displacement/piece_replay.h"
#include "surface/displacement/reach.h"
#include "surface/error/samples.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

/// The pull of a sample across the normal, beside that along it.
constexpr double kAcross = 0.05;
/// Shares below this are those of a point on the boundary of its triangle.
constexpr double kOnBoundary = 1e-9;

/// The logarithm of the ratio of the tolerances of a triangle's uniform cuts.
double lifeOf(const MultiTriangulation& mt, TriangleId t) {
  const NodeId remover = mt.remover(t), creator = mt.creator(t);
  const double first = std::max(mt.error(t), remover.isValid() ? mt.saturatedError(remover) : 0.0);
  const double last = creator.isValid() ? mt.saturatedError(creator) : 2 * first;
  return last > first ? std::log(last / first) : 0;
}

/// The triangles of a batch are visited by several threads, and added in their order at its end, so that sums
/// do not depend on threads.
class Pulls final : public CoarseTriangleVisitor {
 public:
  Pulls(const SurfaceModel& model, const OriginalSurface& original)
      : mt_(model.mt),
        original_(original),
        samples_(original),
        areaUnit_(1 / (model.diagonal * model.diagonal)),
        problem_(model.mt) {}

  void begin(std::size_t count) override { batch_.assign(count, {}); }

  void visit(std::size_t number, const CoarseTriangle& t) override {
    Entry& entry = batch_[number];
    entry.corners = t.corners;
    const double scale = mt_.decoded(kRms, TriangleId(t.id)), life = lifeOf(mt_, TriangleId(t.id));
    const SpaceTriangle place = {original_.positions[t.corners[0]], original_.positions[t.corners[1]],
                                 original_.positions[t.corners[2]]};
    const Vec3 normal = areaNormal(place);
    // A triangle without error, life or area cannot say what its samples want.
    if (!(scale > 0) || !(life > 0) || !(dot(normal, normal) > 0)) return;
    const Symmetric3 along = metricAlong(unit(normal), kAcross);
    std::vector<SurfaceSample> samples;
    t.pieces.forEach([&](const Piece& piece) {
      if (piece.across == 0) samples_.append(piece, samples);
    });
    for (const SurfaceSample& sample : samples) {
      // Where the nearest point is inside, the distance along the normal counts most; on the boundary a
      // sample pulls in all directions alike.
      const std::array<double, 3> shares = sharesAt(nearestOnTriangle(sample.place, place), place);
      const Vec3 r = sample.place - (shares[0] * place[0] + shares[1] * place[1] + shares[2] * place[2]);
      const bool isInside = std::min({shares[0], shares[1], shares[2]}) > kOnBoundary;
      Symmetric3 metric = isInside ? along : identity3();
      metric *= life * sample.area * areaUnit_;
      entry.part.add(shares, metric, r / scale);
    }
  }

  void end() override {
    for (const Entry& entry : batch_) problem_.add(entry.corners, entry.part);
  }

  std::vector<Vec3> directions() const { return problem_.solve(); }

 private:
  struct Entry {
    std::array<std::uint32_t, 3> corners{};
    DirectionProblem::Part part;
  };

  const MultiTriangulation& mt_;
  const OriginalSurface& original_;
  SurfaceSamples samples_;
  double areaUnit_;
  DirectionProblem problem_;
  std::vector<Entry> batch_;
};

class Reaches final : public CoarseTriangleVisitor {
 public:
  /// @param displacement has directions, and receives the reaches
  Reaches(const SurfaceModel& model, const OriginalSurface& original, SurfaceDisplacement& displacement)
      : model_(model), original_(original), displacement_(displacement) {
    displacement_.reaches.assign(model.mt.triangleIdCount(), 0);
  }

  void visit(std::size_t, const CoarseTriangle& t) override {
    SpaceTriangle place;
    std::array<Vec3, 3> directions;
    for (std::size_t i = 0; i < 3; ++i) {
      place[i] = original_.positions[t.corners[i]];
      directions[i] = displacement_.direction(t.corners[i]);
    }
    // A place of the source is where rounding has put it, or no farther from there than positionError.
    const double stored = model_.mt.error(TriangleId(t.id)), error = stored - model_.positionError;
    if (!(error > 0)) return;
    const std::uint8_t reach = reachOf(original_, t.pieces, place, directions, error, t.corners);
    displacement_.reaches[t.id] = static_cast<std::uint8_t>(reach * (error / stored));
  }

 private:
  const SurfaceModel& model_;
  const OriginalSurface& original_;
  SurfaceDisplacement& displacement_;
};

std::array<std::int8_t, 3> stored(const Vec3& direction) {
  constexpr double kMost = 127;
  const Vec3 steps = direction / SurfaceDisplacement::kStep;
  const double longest = std::max({std::abs(steps.x), std::abs(steps.y), std::abs(steps.z)});
  const double part = longest > kMost ? kMost / longest : 1;
  const auto round = [&](double x) { return static_cast<std::int8_t>(std::lround(part * x)); };
  return {round(steps.x), round(steps.y), round(steps.z)};
}

void holdBorders(const MultiTriangulation& mt, std::vector<Vec3>& directions) {
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  const MeshEdges edges(finest.triangles, finest.vertices.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (const MeshEdges::Edge edge = edges[e]; edge.isBorder())
      for (const VertexId v : {edge.low, edge.high}) directions[finest.vertices[v.index()]] = {0, 0, 0};
}

Result<SurfaceDisplacement> find(const SurfaceModel& model, const RunContext& context) {
  const PieceReplay replay(model);
  SurfaceDisplacement displacement;
  {
    Pulls pulls(model, replay.original());
    ARETE_CHECK(replay.run(pulls, "displace", context));
    std::vector<Vec3> directions = pulls.directions();
    if (model.options.keepsBorders) holdBorders(model.mt, directions);
    displacement.directions.reserve(directions.size());
    for (const Vec3& direction : directions) displacement.directions.push_back(stored(direction));
  }
  Reaches reaches(model, replay.original(), displacement);
  ARETE_CHECK(replay.run(reaches, "bound", context));
  return displacement;
}

}  // namespace

Result<SurfaceDisplacement> findDisplacement(const SurfaceModel& model, const RunContext& context) {
  return withThreads(context, [&] { return find(model, context); });
}

}  // namespace arete
