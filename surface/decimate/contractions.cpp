// SPDX-License-Identifier: GPL-3.0-or-later
//
// Candidates are edges (and pairs of near vertices), or triangles. The least one is taken from a heap; a
// candidate whose cost changed has a new stamp, and entries with an older one are passed over. A candidate
// that may not be contracted waits until a vertex near it changes.
//
// A vertex that goes hands its quadric to the one that stays. Edges of borders, and of lines between classes
// of corners, add the plane that stands on their triangle, so that they stay where they are.
#include "surface/decimate/contractions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

#include "engine/base/box3.h"
#include "surface/decimate/contraction_mesh.h"
#include "surface/decimate/corner_attributes.h"
#include "surface/decimate/crossing_guard.h"
#include "surface/decimate/quadric.h"
#include "surface/model/charts.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Pairs without an edge are nearer than this share of the diagonal.
constexpr double kPairDistance = 0.005;

struct Candidate {
  std::array<std::uint32_t, 2> ends{};  // of an edge; of a triangle its number
  double cost = kNever;
  std::uint32_t stamp = 0;
  bool isGone = false, isDirty = false, waits = false;
};

/// The vertices of a candidate, at most three, or something of each: without memory of its own.
template <class Element>
class Few {
 public:
  Few() = default;
  explicit Few(std::span<const Element> elements) {
    for (const Element& e : elements) push_back(e);
  }
  void push_back(const Element& e) { elements_[size_++] = e; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Element& operator[](std::size_t i) { return elements_[i]; }
  const Element& operator[](std::size_t i) const { return elements_[i]; }
  Element* begin() { return elements_.data(); }
  Element* end() { return elements_.data() + size_; }
  const Element* begin() const { return elements_.data(); }
  const Element* end() const { return elements_.data() + size_; }

 private:
  std::array<Element, 3> elements_{};
  std::size_t size_ = 0;
};

struct Step {
  Few<std::uint32_t> vertices;  // the first one stays
  Vec3 place{0, 0, 0};
  double cost = kNever;
};

class Contractions {
 public:
  Contractions(const SurfaceMesh& source, const DecimateOptions& options, const RunContext& context)
      : source_(source),
        options_(options),
        context_(context),
        mesh_(source),
        attributes_(source),
        quadrics_(source.positions.size()),
        isOnBorder_(source.positions.size(), 0),
        isFace_(options.method == DecimateOperator::face),
        candidatesOf_(source.positions.size()) {
    if (options.method == DecimateOperator::vertexPair) return;
    chartOf_ = chartsOf(source);
    leftOf_.assign(chartOf_.size(), 0);
    for (std::uint32_t t = 0; t < chartOf_.size(); ++t)
      if (mesh_.isThere(t)) ++leftOf_[chartOf_[t]];
  }

  Result<DecimatedMesh> run() {
    addQuadrics();
    addCandidates();
    if (options_.forbidsCrossings) crossings_.emplace(mesh_);
    if (const Status contracted = contractAll(); !contracted) return tl::unexpected(contracted.error());
    if (isFace_ && mesh_.triangleCount() > options_.maxTriangles) {
      // A triangle beside a vertex of three triangles cannot be contracted. Then edges are.
      isFace_ = false;
      candidates_.clear();
      addCandidates();
      if (const Status contracted = contractAll(); !contracted) return tl::unexpected(contracted.error());
    }
    context_.report("decimate", 1);
    result_.mesh = attributes_.take(source_, mesh_, result_.vertexOf, result_.faceOf);
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
        candidate.waits = true;
        continue;
      }
      take(step);
    }
    return {};
  }

  void addQuadrics() {
    const auto& triangles = source_.triangles;
    const auto& at = source_.positions;
    std::vector<Vec3> normals(triangles.size(), Vec3{0, 0, 0});
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [i, j, k] = triangles[t];
      const Vec3 n = cross(at[j] - at[i], at[k] - at[i]);
      const double size = norm(n);
      if (!(size > 0)) continue;
      normals[t] = n / size;
      const Quadric quadric = Quadric::ofPlane(at[i], normals[t], options_.weighsByArea ? size / 2 : 1);
      for (const std::uint32_t v : triangles[t]) quadrics_[v] += quadric;
    }
    const MeshEdges edges(triangles, at.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      const std::uint32_t a = edge.low.index(), b = edge.high.index();
      if (edge.isBorder()) isOnBorder_[a] = isOnBorder_[b] = 1;
      if (!edge.isBorder() && !isLine(edge)) continue;
      const Vec3 along = at[b] - at[a];
      for (const CornerId side : edge.sides) {
        const Vec3 across = cross(along, normals[triangleOf(side).index()]);
        if (!(norm(across) > 0)) continue;
        const Quadric quadric =
            Quadric::ofPlane(at[a], unit(across), options_.weighsByArea ? dot(along, along) : 1);
        quadrics_[a] += quadric;
        quadrics_[b] += quadric;
      }
    }
  }
  /// Whether wedges or parts differ across an edge.
  bool isLine(const MeshEdges::Edge& edge) const {
    if (edge.sides.size() != 2) return false;
    const std::uint32_t s = triangleOf(edge.sides[0]).index(), t = triangleOf(edge.sides[1]).index();
    const std::vector<std::uint32_t>& parts = attributes_.partOf();
    if (!parts.empty() && parts[s] != parts[t]) return true;
    if (!source_.hasWedges()) return false;
    for (const std::uint32_t v : {edge.low.index(), edge.high.index()}) {
      const auto wedgeAt = [&](std::uint32_t of) {
        const auto& corners = source_.triangles[of];
        return source_.wedges[of][static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin())];
      };
      if (wedgeAt(s) != wedgeAt(t)) return true;
    }
    return false;
  }

  void addCandidates() {
    if (isFace_) {
      for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
        add({t, t});
        if (!mesh_.isThere(t)) candidates_.back().isGone = true;
      }
    } else {
      std::vector<std::array<std::uint32_t, 3>> triangles;
      for (std::uint32_t t = 0; t < source_.triangles.size(); ++t)
        if (mesh_.isThere(t)) triangles.push_back(mesh_.corners(t));
      const MeshEdges edges(triangles, source_.positions.size());
      for (std::size_t e = 0; e < edges.size(); ++e) add({edges[e].low.index(), edges[e].high.index()});
      if (options_.method == DecimateOperator::vertexPair) addPairs();
    }
    for (std::uint32_t id = 0; id < candidates_.size(); ++id) price(id);
  }
  void add(std::array<std::uint32_t, 2> ends) {
    const auto id = static_cast<std::uint32_t>(candidates_.size());
    candidates_.push_back({.ends = ends});
    if (isFace_) return;
    for (const std::uint32_t v : ends) candidatesOf_[v].push_back(id);
  }
  /// Pairs of near vertices without an edge, by cells as wide as the distance.
  void addPairs() {
    const auto& at = source_.positions;
    if (at.empty()) return;
    Box3 box = Box3::empty();
    for (const Vec3& p : at) box.include(p);
    const double reach = kPairDistance * box.diagonal();
    if (!(reach > 0)) return;
    using Cell = std::array<std::int64_t, 3>;
    const auto cellOf = [&](const Vec3& p) {
      return Cell{static_cast<std::int64_t>((p.x - box.low.x) / reach),
                  static_cast<std::int64_t>((p.y - box.low.y) / reach),
                  static_cast<std::int64_t>((p.z - box.low.z) / reach)};
    };
    std::map<Cell, std::vector<std::uint32_t>> cells;
    for (std::uint32_t v = 0; v < at.size(); ++v)
      if (!mesh_.trianglesOf(v).empty()) cells[cellOf(at[v])].push_back(v);
    ContractionMesh::Neighbours neighbours;
    for (const auto& [cell, vertices] : cells)
      for (const std::uint32_t v : vertices) {
        mesh_.neighboursOf(v, neighbours);
        for (std::int64_t i = 0; i < 27; ++i) {
          const auto found = cells.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
          if (found == cells.end()) continue;
          for (const std::uint32_t w : found->second)
            if (w > v && norm(at[w] - at[v]) < reach && !std::ranges::binary_search(neighbours, w))
              add({v, w});
        }
      }
  }

  void price(std::uint32_t id) {
    Candidate& candidate = candidates_[id];
    candidate.isDirty = false;
    candidate.waits = false;
    candidate.cost = stepOf(id, false).cost;
    push(id);
  }
  void push(std::uint32_t id) {
    Candidate& candidate = candidates_[id];
    ++candidate.stamp;
    if (candidate.cost < kNever)
      heap_.emplace(candidate.cost, id, candidate.stamp);
    else
      candidate.waits = true;
  }

  /// @param isTaken  the place is wanted, not the cost alone
  Step stepOf(std::uint32_t id, bool isTaken) {
    const Candidate& candidate = candidates_[id];
    Step step;
    if (isFace_)
      step.vertices = Few<std::uint32_t>(mesh_.corners(candidate.ends[0]));
    else
      step.vertices = Few<std::uint32_t>(candidate.ends);
    Few<Vec3> places;
    for (const std::uint32_t v : step.vertices) places.push_back(mesh_.position(v));
    if (options_.queue == DecimateQueue::estimate && !isTaken) {
      Vec3 middle{0, 0, 0};
      for (const Vec3& p : places) middle = middle + p / double(places.size());
      step.cost = 0;
      for (const Vec3& p : places) step.cost += dot(p - middle, p - middle);
      return step;
    }
    if (!isTaken || options_.queue == DecimateQueue::estimate) ++result_.evaluations;
    Quadric quadric;
    for (const std::uint32_t v : step.vertices) quadric += quadrics_[v];
    const auto isHeld = [&](std::uint32_t v) {
      return attributes_.isOnLine(mesh_, v) || (options_.keepsBorders && isOnBorder_[v] != 0);
    };
    Few<std::size_t> held;
    for (std::size_t i = 0; i < step.vertices.size(); ++i)
      if (isHeld(step.vertices[i])) held.push_back(i);
    const bool isAtEnds = options_.method == DecimateOperator::halfEdge || !held.empty();
    if (!isAtEnds) {
      step.place = placeFor(quadric, places);
      step.cost = std::max(0.0, quadric.at(step.place));
      return step;
    }
    // The place of one of them; where some are held, of one of these, along their line.
    for (std::size_t i = 0; i < step.vertices.size(); ++i) {
      if (!held.empty() && std::ranges::find(held, i) == held.end()) continue;
      const double cost = std::max(0.0, quadric.at(places[i]));
      if (!(cost < step.cost)) continue;
      Few<std::uint32_t> order = step.vertices;
      std::swap(order[0], order[i]);
      if (!mayGo(order)) continue;
      step.cost = cost;
      step.place = places[i];
      std::swap(step.vertices, order);
      std::swap(places[0], places[i]);
      for (std::size_t& h : held) h = h == i ? 0 : h == 0 ? i : h;
    }
    return step;
  }
  /// Whether all but the first may go to it.
  bool mayGo(std::span<const std::uint32_t> vertices) const {
    if (options_.keepsBorders)
      for (const std::uint32_t v : vertices.subspan(1))
        if (isOnBorder_[v] != 0) return false;
    return attributes_.mayJoin(mesh_, vertices);
  }

  bool isAllowed(const Step& step) const {
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

  void take(const Step& step) {
    ++result_.steps;
    if (!chartOf_.empty()) forRemoved(step, [&](std::uint32_t t) { --leftOf_[chartOf_[t]]; });
    const std::uint32_t kept = step.vertices[0];
    attributes_.join(mesh_, step.vertices, weightsOf(step));
    for (const std::uint32_t v : std::span(step.vertices).subspan(1)) {
      quadrics_[kept] += quadrics_[v];
      isOnBorder_[kept] |= isOnBorder_[v];
    }
    if (isFace_) {
      std::vector<std::uint32_t> around;
      for (const std::uint32_t v : step.vertices)
        around.insert(around.end(), mesh_.trianglesOf(v).begin(), mesh_.trianglesOf(v).end());
      contract(step);
      for (const std::uint32_t t : around)
        if (!mesh_.isThere(t)) candidates_[t].isGone = true;
      for (const std::uint32_t t : mesh_.trianglesOf(kept)) change(t);
      wakeNear(kept);
      return;
    }
    // Of the candidates at these vertices, one for each other end is left: the least.
    costs_.clear();
    for (const std::uint32_t v : step.vertices) {
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
    std::ranges::sort(costs_);
    const auto isSameEnd = [](const auto& a, const auto& b) { return a.first == b.first; };
    costs_.erase(std::unique(costs_.begin(), costs_.end(), isSameEnd), costs_.end());
    for (const auto& [end, cost] : costs_) {
      if (mesh_.trianglesOf(end).empty()) continue;
      std::erase_if(candidatesOf_[end], [&](std::uint32_t id) { return candidates_[id].isGone; });
      add({kept, end});
      candidates_.back().cost = cost;
      change(static_cast<std::uint32_t>(candidates_.size() - 1));
    }
    wakeNear(kept);
  }
  void contract(const Step& step) {
    mesh_.contract(step.vertices, step.place);
    if (crossings_) crossings_->moved(step.vertices[0]);
  }
  /// The quadric of a vertex of the candidate has changed.
  void change(std::uint32_t id) {
    if (options_.queue == DecimateQueue::greedy || candidates_[id].cost == kNever) return price(id);
    candidates_[id].isDirty = true;
    candidates_[id].waits = false;
    push(id);
  }
  /// Candidates that wait near a vertex that changed are tried again.
  void wakeNear(std::uint32_t kept) {
    const auto wake = [&](std::uint32_t id) {
      Candidate& candidate = candidates_[id];
      if (candidate.isGone || !candidate.waits) return;
      candidate.waits = false;
      if (candidate.cost == kNever) return price(id);
      push(id);
    };
    mesh_.neighboursOf(kept, near_);
    near_.push_back(kept);
    for (const std::uint32_t v : near_) {
      const std::span<const std::uint32_t> ids =
          isFace_ ? mesh_.trianglesOf(v) : std::span<const std::uint32_t>(candidatesOf_[v]);
      for (const std::uint32_t id : ids) wake(id);
    }
  }

  /// By vertex, its share in the attributes of the new one.
  Few<double> weightsOf(const Step& step) const {
    Few<double> weights, distances;
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
  const DecimateOptions& options_;
  const RunContext& context_;
  ContractionMesh mesh_;
  CornerAttributes attributes_;
  std::optional<CrossingGuard> crossings_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint8_t> isOnBorder_;
  std::vector<std::uint32_t> chartOf_, leftOf_;  // by triangle; by chart, how many triangles are left
  bool isFace_;                                  // candidates are triangles
  std::vector<Candidate> candidates_;
  std::vector<std::vector<std::uint32_t>> candidatesOf_;           // by vertex; not of triangles
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // cost, candidate, stamp
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
  DecimatedMesh result_;
  // Scratch of take() and wakeNear().
  std::vector<std::pair<std::uint32_t, double>> costs_;
  ContractionMesh::Neighbours near_;
};

}  // namespace

Result<DecimatedMesh> decimateByContractions(const SurfaceMesh& mesh, const DecimateOptions& options,
                                             const RunContext& context) {
  return Contractions(mesh, options, context).run();
}

}  // namespace arete
