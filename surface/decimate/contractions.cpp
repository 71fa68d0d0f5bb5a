// SPDX-License-Identifier: GPL-3.0-or-later
//
// Candidates are edges (and pairs of near vertices), or triangles. The least one is taken from a heap; a
// candidate whose cost changed has a new stamp, and entries with an older one are passed over. A candidate
// that may not be contracted waits until a vertex near it changes.
//
// A vertex of very many triangles makes each candidate at it dear. These are not even priced before it has
// fewer triangles, by the contraction of the edges around it; only where no other candidate is left are they
// tried.
//
// At borders the face operator contracts edges: a triangle that takes three vertices of a border along would
// eat the border away where nothing better is left. So it does where a triangle's short side is far cheaper
// than the triangle: those of a fan around an apex would take the rim to the apex.
//
// A vertex that goes hands its quadric to the one that stays.
#include "surface/decimate/contractions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

#include "surface/decimate/contraction_mesh.h"
#include "surface/decimate/corner_attributes.h"
#include "surface/decimate/crossing_guard.h"
#include "surface/decimate/mesh_quadrics.h"
#include "surface/decimate/near_pairs.h"
#include "surface/decimate/quadric.h"
#include "surface/decimate/small_vector.h"
#include "surface/model/charts.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Vertices with more triangles are no end of a contraction as long as another one is left; the second, none.
constexpr std::size_t kMostAround = 256;
constexpr std::size_t kMostAroundAtLast = 4096;
/// A triangle that costs more than so many times what its short side does makes way for that. It removes
/// twice as many triangles, and costs about four times as much where a surface bends evenly.
constexpr double kMostDearer = 8;
/// Where attributes count, an edge along a sharp change of them is cheap, and the triangle on it lies across.
constexpr double kMostDearerInLooks = 1.5;
/// What attributes count where a place is solved, of what they count in its cost: places that follow sharp
/// changes of colour leave the surface.
constexpr double kShareInPlace = 0.1;

struct Candidate {
  std::array<std::uint32_t, 2> ends{};  // of an edge; of a triangle its number
  double cost = kNever;
  std::uint32_t stamp = 0;
  bool isTriangle = false, isGone = false, isDirty = false, waits = false;
};

struct Step {
  SmallVector<std::uint32_t> vertices;  // the first one stays
  Vec3 place{0, 0, 0};
  double cost = kNever;
};

class Contractions {
 public:
  Contractions(const FramedMesh& mesh, const DecimateOptions& options, const RunContext& context)
      : source_(mesh.source),
        shape_(mesh.shape),
        options_(options),
        context_(context),
        mesh_(mesh.shape, mesh.rounding),
        attributes_(mesh.source, mesh.shape, options),
        isOffLines_(mesh.shape.positions.size(), 0),
        takesFaces_(options.method == DecimateOperator::face),
        candidatesOf_(mesh.shape.positions.size()),
        waitingAt_(mesh.shape.positions.size()) {
    result_.joinedTo.resize(mesh.shape.positions.size());
    std::iota(result_.joinedTo.begin(), result_.joinedTo.end(), 0u);
    MeshQuadrics quadrics = quadricsOf(mesh.source, mesh.shape, attributes_.partOf(), options.weighsByArea);
    quadrics_ = std::move(quadrics.ofVertex);
    isOnBorder_ = std::move(quadrics.isOnBorder);
    hasBorders_ = std::ranges::find(isOnBorder_, 1) != isOnBorder_.end();
    if (options.method == DecimateOperator::vertexPair) return;
    chartOf_ = chartsOf(mesh.source);
    leftOf_.assign(chartOf_.size(), 0);
    for (std::uint32_t t = 0; t < chartOf_.size(); ++t)
      if (mesh_.isThere(t)) ++leftOf_[chartOf_[t]];
  }

  /// @param mostAround  of narrowWideVertices(); 0: it is not that
  Result<FramedResult> run(std::size_t mostAround = 0) {
    isForWide_ = mostAround > 0;
    if (isForWide_) mostAround_ = mostAround;
    addCandidates();
    if (options_.forbidsCrossings) crossings_.emplace(mesh_);
    ARETE_CHECK(contractAll());
    if (takesFaces_ && mesh_.triangleCount() > options_.maxTriangles) {
      // A triangle beside a vertex of three triangles cannot be contracted. Then edges are.
      takesFaces_ = false;
      candidates_.clear();
      for (auto& ids : candidatesOf_) ids.clear();
      for (auto& ids : waitingAt_) ids.clear();
      addCandidates();
      ARETE_CHECK(contractAll());
    }
    if (!isForWide_ && mesh_.triangleCount() > options_.maxTriangles && hasWide()) {
      mostAround_ = kMostAroundAtLast;
      for (std::uint32_t id = 0; id < candidates_.size(); ++id) wake(id);
      ARETE_CHECK(contractAll());
    }
    context_.report("decimate", 1);
    DecimatedMesh& decimated = result_.decimated;
    decimated.mesh = attributes_.take(source_, mesh_, decimated.vertexOf, decimated.faceOf);
    return std::move(result_);
  }

 private:
  /// Takes the least candidates until few enough triangles are left, or no candidate.
  Status contractAll() {
    std::uint64_t turns = 0;
    while (mesh_.triangleCount() > options_.maxTriangles && !heap_.empty()) {
      if ((turns++ & 1023) == 0) {
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "decimation was interrupted");
        const double all = double(source_.triangles.size()), left = mesh_.triangleCount();
        context_.report("decimate", (all - left) / std::max(1.0, all - options_.maxTriangles));
      }
      const auto [cost, id, stamp] = heap_.top();
      heap_.pop();
      Candidate& candidate = candidates_[id];
      if (candidate.isGone || candidate.stamp != stamp) continue;
      if (candidate.isDirty) {
        price(id);
        continue;
      }
      const Step step = stepOf(id, true);
      if (step.cost == kNever || !isAllowed(step)) {
        wait(id);
        continue;
      }
      take(step);
    }
    return {};
  }

  void addCandidates() {
    if (takesFaces_)
      for (std::uint32_t t = 0; t < source_.triangles.size(); ++t)
        candidates_.push_back({.ends = {t, t}, .isTriangle = true, .isGone = !mesh_.isThere(t)});
    if (!takesFaces_ || hasBorders_) {
      std::vector<std::array<std::uint32_t, 3>> triangles;
      for (std::uint32_t t = 0; t < source_.triangles.size(); ++t)
        if (mesh_.isThere(t)) triangles.push_back(mesh_.corners(t));
      const MeshEdges edges(triangles, source_.positions.size());
      for (std::size_t e = 0; e < edges.size(); ++e) add({edges[e].low.index(), edges[e].high.index()});
      if (options_.method == DecimateOperator::vertexPair)
        for (const auto& pair : nearPairs(mesh_)) add(pair);
    }
    for (std::uint32_t id = 0; id < candidates_.size(); ++id)
      if (!candidates_[id].isGone) price(id);
  }
  void add(std::array<std::uint32_t, 2> ends) {
    const auto id = static_cast<std::uint32_t>(candidates_.size());
    candidates_.push_back({.ends = ends});
    for (const std::uint32_t v : ends) candidatesOf_[v].push_back(id);
  }

  SmallVector<std::uint32_t> verticesOf(const Candidate& candidate) const {
    return candidate.isTriangle ? SmallVector<std::uint32_t>(mesh_.corners(candidate.ends[0]))
                                : SmallVector<std::uint32_t>(candidate.ends);
  }
  bool isWide(std::uint32_t v) const { return mesh_.trianglesOf(v).size() > mostAround_; }
  bool hasWide() const {
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v)
      if (isWide(v)) return true;
    return false;
  }
  /// Whether the operator has candidates of this kind here: triangles, but edges at borders.
  bool isOfOperator(const Candidate& candidate, const SmallVector<std::uint32_t>& vertices) const {
    if (!takesFaces_) return true;
    const bool isAtBorder =
        std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return isOnBorder_[v] != 0; });
    return candidate.isTriangle != isAtBorder;
  }

  void price(std::uint32_t id) {
    Candidate& candidate = candidates_[id];
    candidate.isDirty = false;
    const SmallVector<std::uint32_t> vertices = verticesOf(candidate);
    const bool isAtWide =
        std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return isWide(v); });
    candidate.cost = isAtWide || !isOfOperator(candidate, vertices) ? kNever : stepOf(id, false).cost;
    push(id);
  }
  void push(std::uint32_t id) {
    Candidate& candidate = candidates_[id];
    ++candidate.stamp;
    candidate.waits = false;
    if (candidate.cost < kNever)
      heap_.emplace(candidate.cost, id, candidate.stamp);
    else
      wait(id);
  }
  /// A candidate that cannot be contracted waits until something changes near one of its vertices, or, at
  /// wide ones, until they are no longer wide.
  void wait(std::uint32_t id) {
    candidates_[id].waits = true;
    const SmallVector<std::uint32_t> vertices = verticesOf(candidates_[id]);
    // That changes with the vertices themselves alone, and then change() prices it.
    if (!isOfOperator(candidates_[id], vertices)) return;
    const bool isAtWide =
        std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return isWide(v); });
    for (const std::uint32_t v : vertices)
      if (!isAtWide || isWide(v)) waitingAt_[v].push_back(id);
  }
  void wake(std::uint32_t id) {
    Candidate& candidate = candidates_[id];
    if (candidate.isGone || !candidate.waits) return;
    if (candidate.cost == kNever) return price(id);
    push(id);
  }

  /// @param isTaken  the place is wanted, not the cost alone
  Step stepOf(std::uint32_t id, bool isTaken) {
    const SmallVector<std::uint32_t> vertices = verticesOf(candidates_[id]);
    if (vertices.size() < 3 || (options_.queue == DecimateQueue::estimate && !isTaken))
      return stepOf(vertices, isTaken);
    const Step whole = stepOf(vertices, isTaken), ofSide = stepOf(shortSideOf(vertices), isTaken);
    if (ofSide.cost == kNever) return whole;
    const bool isLast = isTaken && mesh_.triangleCount() <= options_.maxTriangles + 2;  // the side is enough
    const double most = attributes_.areWeighed() ? kMostDearerInLooks : kMostDearer;
    return isLast || whole.cost > most * ofSide.cost ? ofSide : whole;
  }
  /// The ends of the short side of a triangle.
  SmallVector<std::uint32_t> shortSideOf(const SmallVector<std::uint32_t>& corners) const {
    std::array<double, 3> squared;  // of the sides opposite to the corners
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = mesh_.position(corners[(i + 1) % 3]) - mesh_.position(corners[(i + 2) % 3]);
      squared[i] = dot(side, side);
    }
    const auto opposite = static_cast<std::size_t>(std::ranges::min_element(squared) - squared.begin());
    return SmallVector<std::uint32_t>(std::array{corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]});
  }
  Step stepOf(const SmallVector<std::uint32_t>& vertices, bool isTaken) {
    Step step;
    step.vertices = vertices;
    SmallVector<Vec3> places;
    for (const std::uint32_t v : step.vertices) places.push_back(mesh_.position(v));
    if (options_.queue == DecimateQueue::estimate && !isTaken) {
      Vec3 middle{0, 0, 0};
      for (const Vec3& p : places) middle = middle + p / double(places.size());
      step.cost = 0;
      for (const Vec3& p : places) step.cost += dot(p - middle, p - middle);
      return step;
    }
    if (!isTaken || options_.queue == DecimateQueue::estimate) ++result_.decimated.evaluations;
    Quadric quadric;
    for (const std::uint32_t v : step.vertices) quadric += quadrics_[v];
    const auto isHeld = [&](std::uint32_t v) {
      return isOnLine(v) || (options_.keepsBorders && isOnBorder_[v] != 0);
    };
    SmallVector<std::size_t> held;
    for (std::size_t i = 0; i < step.vertices.size(); ++i)
      if (isHeld(step.vertices[i])) held.push_back(i);
    const bool isAtEnds = options_.method == DecimateOperator::halfEdge || !held.empty();
    if (!isAtEnds) {
      solve(step, quadric, places);
      return step;
    }
    if (held.size() == 2 && goesAlongLine(step.vertices, held[0], held[1])) {
      std::swap(step.vertices[0], step.vertices[held[0]]);
      std::swap(places[0], places[held[0]]);
      solve(step, quadric, places);
      return step;
    }
    // The place of one of them; where some are held, of one of these, along their line.
    for (std::size_t i = 0; i < step.vertices.size(); ++i) {
      if (!held.empty() && std::ranges::find(held, i) == held.end()) continue;
      double cost = std::max(0.0, quadric.at(places[i]));
      if (!(cost < step.cost)) continue;
      SmallVector<std::uint32_t> order = step.vertices;
      std::swap(order[0], order[i]);
      if (!mayGo(order)) continue;
      if (attributes_.areWeighed()) {
        cost += std::max(0.0, attributes_.quadricOf(mesh_, order).at(places[i]));
        if (options_.method == DecimateOperator::halfEdge) cost += attributes_.gapOf(mesh_, order);
        if (!(cost < step.cost)) continue;
      }
      step.cost = cost;
      step.place = places[i];
      std::swap(step.vertices, order);
      std::swap(places[0], places[i]);
      for (std::size_t& h : held) h = h == i ? 0 : h == 0 ? i : h;
    }
    return step;
  }
  void solve(Step& step, const Quadric& ofShape, std::span<const Vec3> places) const {
    if (!attributes_.areWeighed()) {
      step.place = placeFor(ofShape, places);
      step.cost = std::max(0.0, ofShape.at(step.place));
      return;
    }
    const Quadric ofAttributes = attributes_.quadricOf(mesh_, step.vertices);
    Quadric forPlace = ofShape, whole = ofShape;
    step.place = placeFor(forPlace += ofAttributes.times(kShareInPlace), places);
    step.cost = std::max(0.0, (whole += ofAttributes).at(step.place));
  }
  /// Whether two of the vertices are on a line that neither ends nor branches at them, so that the line may
  /// take any place there: planes across it hold it, and what the sides of a seam have. A third vertex goes
  /// along.
  bool goesAlongLine(const SmallVector<std::uint32_t>& vertices, std::size_t one, std::size_t other) const {
    if (!attributes_.areWeighed() || options_.method == DecimateOperator::halfEdge || options_.keepsBorders)
      return false;
    const auto mayGoTo = [&](std::size_t first) {
      SmallVector<std::uint32_t> order = vertices;
      std::swap(order[0], order[first]);
      return mayGo(order);
    };
    return mayGoTo(one) && mayGoTo(other);
  }
  /// A vertex that is on no line gets on none by what happens around it.
  bool isOnLine(std::uint32_t v) {
    if (isOffLines_[v] != 0) return false;
    const bool isOnLine = attributes_.isOnLine(mesh_, v);
    if (!isOnLine) isOffLines_[v] = 1;
    return isOnLine;
  }
  /// Whether all but the first may go to it.
  bool mayGo(std::span<const std::uint32_t> vertices) const {
    if (options_.keepsBorders)
      for (const std::uint32_t v : vertices.subspan(1))
        if (isOnBorder_[v] != 0) return false;
    return attributes_.mayJoin(mesh_, vertices);
  }

  bool isAllowed(const Step& step) const {
    if (isForWide_ && !isBesideWide(step.vertices)) return false;
    if (!mayGo(step.vertices)) return false;
    if (options_.method != DecimateOperator::vertexPair && !mesh_.keepsTopology(step.vertices)) return false;
    if (!mesh_.keepsTurns(step.vertices, step.place) || !leavesEveryChart(step)) return false;
    return !crossings_ || crossings_->keepsApart(step.vertices, step.place);
  }

  /// Calls visit(triangle) for those that a step removes: each has an edge that is contracted.
  template <class Visit>
  void forRemoved(const Step& step, const Visit& visit) const {
    for (std::size_t i = 0; i < step.vertices.size(); ++i)
      for (const std::uint32_t t : mesh_.trianglesOf(step.vertices[i])) {
        const auto& corners = mesh_.corners(t);
        const auto isThere = [&](std::size_t k) {
          return std::ranges::find(corners, step.vertices[k]) != corners.end();
        };
        std::size_t before = 0, all = 0;
        for (std::size_t k = 0; k < step.vertices.size(); ++k)
          if (isThere(k)) {
            before += k < i ? 1 : 0;
            ++all;
          }
        if (before == 0 && all > 1) visit(t);
      }
  }
  /// Whether every chart keeps a triangle: what lines enclose never vanishes.
  bool leavesEveryChart(const Step& step) const {
    if (chartOf_.empty()) return true;
    bool leaves = true;
    forRemoved(step, [&](std::uint32_t t) {
      std::uint32_t same = 1;
      forRemoved(step,
                 [&](std::uint32_t other) { same += other != t && chartOf_[other] == chartOf_[t] ? 1 : 0; });
      leaves = leaves && leftOf_[chartOf_[t]] > same;
    });
    return leaves;
  }

  /// Whether an edge is opposite to a wide vertex.
  bool isBesideWide(const SmallVector<std::uint32_t>& ends) const {
    return std::ranges::any_of(mesh_.trianglesOf(ends[0]), [&](std::uint32_t t) {
      const auto& corners = mesh_.corners(t);
      return std::ranges::find(corners, ends[1]) != corners.end() &&
             std::ranges::any_of(corners, [&](std::uint32_t v) { return isWide(v); });
    });
  }

  void take(const Step& step) {
    ++result_.decimated.steps;
    if (!chartOf_.empty()) forRemoved(step, [&](std::uint32_t t) { --leftOf_[chartOf_[t]]; });
    const std::uint32_t kept = step.vertices[0];
    attributes_.join(mesh_, step.vertices, weightsOf(step), step.place,
                     options_.method != DecimateOperator::halfEdge);
    isOffLines_[kept] = 0;
    for (const std::uint32_t v : std::span(step.vertices).subspan(1)) {
      quadrics_[kept] += quadrics_[v];
      isOnBorder_[kept] |= isOnBorder_[v];
      result_.joinedTo[v] = kept;
    }
    // Of the edges at these vertices, one for each other end is left: the least.
    around_.clear();
    costs_.clear();
    for (const std::uint32_t v : step.vertices) {
      if (takesFaces_)
        around_.insert(around_.end(), mesh_.trianglesOf(v).begin(), mesh_.trianglesOf(v).end());
      for (const std::uint32_t id : candidatesOf_[v]) {
        Candidate& candidate = candidates_[id];
        if (candidate.isGone) continue;
        candidate.isGone = true;
        const std::uint32_t end = candidate.ends[0] == v ? candidate.ends[1] : candidate.ends[0];
        if (std::ranges::find(step.vertices, end) != step.vertices.end()) continue;
        costs_.emplace_back(end, candidate.cost);
      }
      candidatesOf_[v].clear();
    }
    contract(step);
    if (takesFaces_) {
      for (const std::uint32_t t : around_)
        if (!mesh_.isThere(t)) candidates_[t].isGone = true;
      for (const std::uint32_t t : mesh_.trianglesOf(kept)) change(t);
    }
    std::ranges::sort(costs_);
    const auto isSameEnd = [](const auto& a, const auto& b) { return a.first == b.first; };
    costs_.erase(std::unique(costs_.begin(), costs_.end(), isSameEnd), costs_.end());
    for (const auto& [end, cost] : costs_) {
      if (mesh_.trianglesOf(end).empty()) continue;
      add({kept, end});
      candidates_.back().cost = cost;
      change(static_cast<std::uint32_t>(candidates_.size() - 1));
    }
    wakeNear(step.vertices);
  }
  void contract(const Step& step) {
    mesh_.contract(step.vertices, step.place);
    if (crossings_) crossings_->moved(step.vertices[0]);
  }
  /// The quadric of a vertex of the candidate has changed.
  void change(std::uint32_t id) {
    if (options_.queue == DecimateQueue::greedy || candidates_[id].cost == kNever ||
        (takesFaces_ && hasBorders_))
      return price(id);
    candidates_[id].isDirty = true;
    push(id);
  }
  /// Candidates that wait near vertices that became the first of them are tried again, but not at wide ones.
  void wakeNear(std::span<const std::uint32_t> vertices) {
    mesh_.neighboursOf(vertices[0], near_);
    near_.insert(near_.end(), vertices.begin(), vertices.end());
    for (const std::uint32_t v : near_) {
      if (isWide(v)) continue;
      woken_.swap(waitingAt_[v]);
      // A candidate that waits again stands here again, and a second time at its other end.
      std::ranges::sort(woken_);
      woken_.erase(std::unique(woken_.begin(), woken_.end()), woken_.end());
      for (const std::uint32_t id : woken_) wake(id);
      woken_.clear();
      // Of an end that stays, candidates that are gone are left out when they are as many as its triangles.
      if (candidatesOf_[v].size() > 4 * mesh_.trianglesOf(v).size() + 8)
        std::erase_if(candidatesOf_[v], [&](std::uint32_t id) { return candidates_[id].isGone; });
    }
  }

  /// By vertex, its share in the attributes of the new one.
  SmallVector<double> weightsOf(const Step& step) const {
    SmallVector<double> weights, distances;
    for (const std::uint32_t v : step.vertices) {
      weights.push_back(0);
      distances.push_back(norm(step.place - mesh_.position(v)));
    }
    const auto nearest = std::ranges::min_element(distances);
    if (*nearest == 0) {
      weights[static_cast<std::size_t>(nearest - distances.begin())] = 1;
      return weights;
    }
    if (weights.size() == 2) {
      const Vec3 way = mesh_.position(step.vertices[1]) - mesh_.position(step.vertices[0]);
      const double share =
          std::clamp(dot(step.place - mesh_.position(step.vertices[0]), way) / dot(way, way), 0.0, 1.0);
      weights[0] = 1 - share;
      weights[1] = share;
      return weights;
    }
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] = 1 / distances[i];
    for (double& w : weights) w /= sum;
    return weights;
  }

  const SurfaceMesh& source_;
  const TriangleMesh& shape_;
  const DecimateOptions& options_;
  const RunContext& context_;
  ContractionMesh mesh_;
  CornerAttributes attributes_;
  std::optional<CrossingGuard> crossings_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint8_t> isOnBorder_;
  std::vector<std::uint32_t> chartOf_, leftOf_;  // by triangle; by chart, how many triangles are left
  std::vector<std::uint8_t> isOffLines_;         // not 0: known to be on no line
  bool hasBorders_ = false, isForWide_ = false;
  bool takesFaces_;
  std::size_t mostAround_ = kMostAround;
  std::vector<Candidate> candidates_;                              // of faces: by triangle, then the edges
  std::vector<std::vector<std::uint32_t>> candidatesOf_;           // edges, by vertex
  std::vector<std::vector<std::uint32_t>> waitingAt_;              // by vertex
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, candidate, stamp
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
  FramedResult result_;
  // Scratch of take() and wakeNear().
  std::vector<std::pair<std::uint32_t, double>> costs_;
  std::vector<std::uint32_t> around_, woken_;
  ContractionMesh::Neighbours near_;
};

}  // namespace

Result<FramedResult> decimateByContractions(const FramedMesh& mesh, const DecimateOptions& options,
                                            const RunContext& context) {
  return Contractions(mesh, options, context).run();
}

Result<FramedResult> narrowWideVertices(const FramedMesh& mesh, std::size_t most,
                                        const DecimateOptions& options, const RunContext& context) {
  DecimateOptions ofEdges = options;
  ofEdges.method = DecimateOperator::edge;
  ofEdges.queue = DecimateQueue::lazy;
  ofEdges.forbidsCrossings = false;
  return Contractions(mesh, ofEdges, context).run(most);
}

}  // namespace arete
