// SPDX-License-Identifier: GPL-3.0-or-later
//
// The build of de Berg and Dobrindt (1995): repeat { choose an independent set of removable vertices; remove
// each; retriangulate its hole; record the modification } until nothing is removable. A level goes through
// four steps:
//
//   evaluate  For every vertex whose star has changed, triangulate the hole it would leave and find the
//   error; give up
//             as soon as the error is known to be well beyond the threshold and keep what was found as a
//             lower bound.
//   choose    The vertices under the threshold, in order of their error, each unless a neighbour was chosen
//   before it. refill    Rewrite each chosen star, record the modification, mark its link for evaluation. sew
//   Join the new triangles to their neighbours.
//
// Then the threshold grows by a constant ratio: cheap removals go first everywhere, which is what keeps the
// cuts at any error small (DESIGN: without thresholds the same bound takes 1.9 times as many triangles).
//
// Evaluate, refill and sew are parallel over vertices: stars of chosen vertices share no triangle. Choosing
// is a greedy pass in a total order (error, then a bijective hash of the vertex), so every level, and hence
// the whole MT, is the same for any number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/mt_recorder.h"
#include "engine/result.h"
#include "engine/run_context.h"
#include "terrain/build_checks.h"
#include "terrain/build_options.h"
#include "terrain/hole.h"
#include "terrain/hole_fidelity.h"
#include "terrain/live_mesh.h"
#include "terrain/rim.h"
#include "terrain/signed_bound.h"

namespace arete {

/// What the levels leave: the root.
struct SimplifiedRoot {
  std::vector<std::uint32_t> vertices;
  std::vector<SurvivingTriangle> triangles;
  std::uint32_t levels = 0;
};

/// Plan: LatticePlan or PointPlan. Errors: RasterError or PointError, see there for the interface:
///   Hole hole(star, apex)                        what the hole's triangles are measured against
///   hole.maximum(i, j, m, limit)                 error of the triangle of three corners
///   hole.maximum(i, j, m, bound)                 the same, with the signed difference at the samples
///   hole.alongEdge(i, j)                         signed difference along an edge
///   hole.settle(floor)                           after a refill: samples find their new triangles
template <class Plan, class Errors>
class Simplifier {
 public:
  static constexpr std::uint32_t kNone = LiveMesh::kNone;

  Simplifier(LiveMesh& mesh, const Plan& plan, Errors& errors, MtRecorder& recorder, Rim* rim,
             const BuildOptions& options, const RunContext& context)
      : mesh_(mesh),
        plan_(plan),
        errors_(errors),
        recorder_(recorder),
        rim_(rim),
        options_(options),
        context_(context) {}

  /// Removes what can be removed. `isFixed`: per vertex, not 0 = stays.
  Result<SimplifiedRoot> run(const std::vector<std::uint8_t>& isFixed, const MetricFrame& metric) {
    const auto vertexCount = static_cast<std::uint32_t>(mesh_.vertexHalfedge.size());
    for (std::uint32_t v = 0; v < vertexCount; ++v) {
      if (mesh_.vertexHalfedge[v] == kNone) continue;
      if (!isFixed[v]) live_.push_back(v);
    }
    // From here on vertices are visited in the order of their triangles in memory, which is that of the
    // ground.
    tbb::parallel_sort(live_.begin(), live_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return mesh_.vertexHalfedge[a] < mesh_.vertexHalfedge[b];
    });
    notes_.assign(vertexCount, {});
    movedHalfedge_.resize(mesh_.triangles.size());
    liveTriangles_ = mesh_.triangles.size();
    metric_ = metric;

    // Below a ten-millionth of the relief all errors are alike: noise of the arithmetic must not make levels.
    double threshold = heightRange_ * 1e-7;
    std::uint32_t level = 0;
    const auto removableAtStart = static_cast<double>(std::max<std::size_t>(live_.size(), 1));
    while (!live_.empty()) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the build was interrupted");
      ++level;
      evaluate(threshold);
      choose(threshold, level);
      if (chosen_.empty()) {
        const double pending = leastPending();
        if (!(pending < std::numeric_limits<double>::infinity())) break;
        threshold = std::max(threshold * options_.thresholdRatio, pending);
        continue;
      }
      removeChosen();
      // Most levels are late and short: progress by what is left, on the scale of vertices.
      context_.report("simplify", 1.0 - double(live_.size()) / removableAtStart);
      threshold *= options_.thresholdRatio;
    }

    context_.report("simplify", 1);
    SimplifiedRoot root;
    root.levels = level;
    std::vector<std::uint8_t> seen(vertexCount, 0);
    for (const LiveMesh::Triangle& triangle : mesh_.triangles) {
      if (triangle.isDead()) continue;
      root.triangles.push_back({triangle.birth, triangle.corners});
      for (const std::uint32_t v : triangle.corners) seen[v] = 1;
    }
    for (std::uint32_t v = 0; v < vertexCount; ++v)
      if (seen[v]) root.vertices.push_back(v);
    return root;
  }

 private:
  enum class State : std::uint8_t { stale, atLeast, exact, stuck };
  /// What is known of a vertex, together: one cache line touched, not three.
  struct Note {
    float cost = 0;
    std::uint32_t blockedAt = 0;  ///< level at which a chosen neighbour blocked it
    State state = State::stale;
  };

  static std::uint32_t scatter(std::uint32_t x) {  // murmur3's finaliser: a bijection
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    x ^= x >> 16;
    return x;
  }

  /// Empty when the fidelity shape finds nothing within the limit, unless any shape is welcome: then Delaunay
  /// fills.
  HoleTriangulation fill(const Star& star, std::uint32_t v, const typename Errors::Hole& hole, double limit,
                         bool isAnyShapeWelcome, double& leastError) const {
    const typename Plan::Polygon polygon(plan_, v, star.linkView());
    if (options_.shape == HoleShape::fidelity) {
      const HoleTriangulation floor =
          triangulateHoleFidelity(polygon, star.linkSize, hole, limit, options_.minimumAspect, leastError);
      if (floor.size > 0 || !isAnyShapeWelcome) return floor;
    }
    return triangulateHoleDelaunay(polygon, star.linkSize);
  }

  /// Whether v may go at all, as its star stands. On a border: only from a straight one, or as the rim
  /// allows.
  bool isRemovable(const Star& star, std::uint32_t v) const {
    if (!star.isOpen) return star.linkSize >= 3;
    if (star.linkSize < 3) return false;
    const std::uint32_t after = star.link[0], before = star.link[star.linkSize - 1];
    const int turn = plan_.orientation(before, v, after);
    if (turn == 0) return true;
    return turn < 0 && rim_ != nullptr && rim_->mayFill(before, v, after);
  }

  bool isFill(const Star& star, std::uint32_t v) const {
    return star.isOpen && plan_.orientation(star.link[star.linkSize - 1], v, star.link[0]) != 0;
  }

  void evaluate(double threshold) {
    pending_.clear();
    for (const std::uint32_t v : live_) {
      const Note& note = notes_[v];
      if (note.state == State::stale || (note.state == State::atLeast && note.cost <= threshold))
        pending_.push_back(v);
    }
    // Worth knowing exactly a little beyond the threshold: the next levels will ask.
    const double limit = threshold * kLookAhead;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pending_.size(), 128), [&](const auto& range) {
      Star star;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        prefetchStars<Reach::neighbours>(i, pending_.size(), [&](std::size_t k) { return pending_[k]; });
        const std::uint32_t v = pending_[i];
        if (!star.gather(mesh_, v, static_cast<int>(options_.maxDegree) + 1) ||
            star.triangleCount > static_cast<int>(options_.maxDegree) || !isRemovable(star, v)) {
          notes_[v].state = State::stuck;
          continue;
        }
        const typename Errors::Hole hole(errors_, star, v);
        // No error exceeds the range of the heights: a hole that the aspect bound alone leaves open takes any
        // shape then.
        double leastError = 0;
        const HoleTriangulation floor = fill(star, v, hole, limit, limit >= heightRange_, leastError);
        if (floor.size == 0) {
          notes_[v].state = limit >= heightRange_ ? State::stuck : State::atLeast;
          notes_[v].cost = static_cast<float>(
              std::clamp(leastError, limit * (1 + 1e-6), std::max(heightRange_, limit * 2)));
          continue;
        }
        double worst = 0;
        for (const auto& t : floor.view()) {
          worst = std::max(worst, hole.maximum(t[0], t[1], t[2], limit));
          if (worst > limit) break;
        }
        notes_[v].cost = static_cast<float>(worst);
        notes_[v].state = worst > limit ? State::atLeast : State::exact;
      }
    });
  }

  double leastPending() const {
    float least = std::numeric_limits<float>::infinity();
    for (const std::uint32_t v : live_)
      if (notes_[v].state == State::exact || notes_[v].state == State::atLeast)
        least = std::min(least, notes_[v].cost);
    return least;
  }

  void choose(double threshold, std::uint32_t level) {
    candidates_.clear();
    for (const std::uint32_t v : live_)
      if (notes_[v].state == State::exact && notes_[v].cost <= threshold)
        candidates_.push_back({std::bit_cast<std::uint32_t>(notes_[v].cost), scatter(v), v});
    tbb::parallel_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.tie < b.tie;
    });
    chosen_.clear();
    Star star;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      prefetchStars<Reach::neighbours>(i, candidates_.size(),
                                       [&](std::size_t k) { return candidates_[k].vertex; });
      const std::uint32_t v = candidates_[i].vertex;
      if (notes_[v].blockedAt == level) continue;
      star.gather(mesh_, v, kMaxHoleCorners);
      if (rim_ != nullptr && isFill(star, v) &&
          !rim_->claim(star.link[star.linkSize - 1], star.link[0], level))
        continue;
      for (int k = 0; k < star.linkSize; ++k) notes_[star.link[k]].blockedAt = level;
      notes_[v].blockedAt = level;
      chosen_.push_back({v, mesh_.vertexHalfedge[v], static_cast<std::uint8_t>(star.linkSize)});
    }
    // Errors scatter the chosen all over the terrain; from here on their order is that of memory.
    tbb::parallel_sort(chosen_.begin(), chosen_.end(),
                       [](const Chosen& a, const Chosen& b) { return a.halfedge < b.halfedge; });
    linkSizes_.resize(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) linkSizes_[i] = chosen_[i].linkSize;
  }

  /// A walk around a star follows one pointer after the other. Asking early for what the stars of the next
  /// vertices of a list start with hides most of the waiting: first the half-edge, then its triangle, then
  /// that one's neighbours.
  /// (Always inlined: GCC 12 takes a function of nothing but prefetches for one without effect and drops its
  /// calls.)
  /// Reach::own looks no further than each star's first triangle, which nobody else rewrites.
  enum class Reach { own, neighbours };
  template <Reach reach, class VertexAt>
  [[gnu::always_inline]] void prefetchStars(std::size_t i, std::size_t size, const VertexAt& vertexAt) const {
    constexpr std::size_t kFirst = 16, kSecond = 12, kThird = 8, kFourth = 4;
    if (i + kFirst < size) __builtin_prefetch(&mesh_.vertexHalfedge[vertexAt(i + kFirst)]);
    if (i + kSecond < size) {
      const std::uint32_t v = vertexAt(i + kSecond);
      __builtin_prefetch(&mesh_.triangles[mesh_.vertexHalfedge[v] / 3]);
      errors_.prefetch(v);
    }
    if (i + kThird < size)
      for (const std::uint32_t h : mesh_.triangles[mesh_.vertexHalfedge[vertexAt(i + kThird)] / 3].twin)
        if (h != kNone) __builtin_prefetch(&mesh_.triangles[h / 3]);
    if (reach == Reach::neighbours && i + kFourth < size)
      for (const std::uint32_t h : mesh_.triangles[mesh_.vertexHalfedge[vertexAt(i + kFourth)] / 3].twin)
        if (h != kNone)
          for (const std::uint32_t g : mesh_.triangles[h / 3].twin)
            if (g != kNone) __builtin_prefetch(&mesh_.triangles[g / 3]);
  }

  void removeChosen() {
    const std::uint32_t first = recorder_.beginBatch(linkSizes_);
    seams_.resize(chosen_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chosen_.size(), 64), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        // Not beyond the range: the stars there are being rewritten.
        prefetchStars<Reach::own>(i, range.end(), [&](std::size_t k) { return chosen_[k].vertex; });
        remove(chosen_[i].vertex, first + static_cast<std::uint32_t>(i), seams_[i]);
      }
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chosen_.size(), 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) sew(mesh_, seams_[i], movedHalfedge_, first);
    });
    if (rim_ != nullptr)
      for (const PendingSeams& seams : seams_)
        if (seams.isOpen) Rim::closeVoid(mesh_, seams.movedTo[seams.size - 1]);
    for (const Chosen& gone : chosen_) mesh_.vertexHalfedge[gone.vertex] = kNone;
    std::erase_if(live_, [&](std::uint32_t v) { return mesh_.vertexHalfedge[v] == kNone; });
    liveTriangles_ -= liveTrianglesRemoved();
    if (liveTriangles_ < mesh_.triangles.size() / 2) {
      const std::vector<std::uint32_t> newSlot = mesh_.compact();
      errors_.compact(newSlot, mesh_.triangles.size());
      movedHalfedge_.resize(mesh_.triangles.size());
      movedHalfedge_.shrink_to_fit();
    }
  }

  /// A removal leaves two slots dead, one on a border.
  std::size_t liveTrianglesRemoved() const {
    std::size_t count = 0;
    for (const PendingSeams& seams : seams_) count += seams.isOpen ? 1 : 2;
    return count;
  }

  void remove(std::uint32_t v, std::uint32_t removal, PendingSeams& seams) {
    Star star;
    star.gather(mesh_, v, kMaxHoleCorners);
    typename Errors::Hole hole(errors_, star, v);
    double leastError = 0;
    const HoleTriangulation floor =
        fill(star, v, hole, std::nextafter(notes_[v].cost, INFINITY), true, leastError);
    const int corners = star.linkSize;

    // Bounds: samples inside each triangle, and each edge once for the two triangles that share it.
    std::array<SignedBound, kMaxHoleCorners> bounds{};
    std::array<double, kMaxHoleCorners> errors{};
    std::array<std::array<std::uint8_t, kMaxHoleCorners>, kMaxHoleCorners> owner;
    for (int f = 0; f < floor.size; ++f) {
      const auto& t = floor.triangles[f];
      errors[f] = hole.maximum(t[0], t[1], t[2], bounds[f]);
      for (int c = 0; c < 3; ++c) owner[t[c]][t[(c + 1) % 3]] = static_cast<std::uint8_t>(f);
    }
    for (int f = 0; f < floor.size; ++f)
      for (int c = 0; c < 3; ++c) {
        const int a = floor.triangles[f][c], b = floor.triangles[f][(c + 1) % 3];
        const bool onRim = b == (a + 1 < corners ? a + 1 : 0);
        if (!onRim && a > b) continue;
        const SignedBound bound = hole.alongEdge(a, b);
        bounds[f].include(bound);
        if (!onRim) bounds[owner[b][a]].include(bound);
      }

    std::array<std::uint16_t, kMaxHoleCorners> errorCode, belowCode, aboveCode;
    const OutwardScale& scale = recorder_.scale();
    for (int f = 0; f < floor.size; ++f) {
      errorCode[f] = scale.encode(withoutRounding(errors[f]));
      belowCode[f] = scale.encode(outward(bounds[f].below));
      aboveCode[f] = scale.encode(outward(bounds[f].above));
    }
    std::array<std::uint32_t, kMaxHoleCorners> ceiling, bearer;
    std::array<Vec3, kMaxHoleCorners + 1> positions;
    for (int i = 0; i < star.triangleCount; ++i) {
      ceiling[i] = mesh_.triangles[star.triangle(i)].birth;
      bearer[i] = mesh_.triangles[star.triangle(i)].bearer;
    }
    const auto metricPosition = [&](std::uint32_t u) {
      const Vec2 p = plan_.planPosition(u);
      return metric_.toMetric({p.x, p.y, errors_.height(u)});
    };
    for (int i = 0; i < corners; ++i) positions[i] = metricPosition(star.link[i]);
    positions[corners] = metricPosition(v);

    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    VertexRemoval what;
    what.vertex = v;
    what.link = star.linkView();
    what.isOpen = star.isOpen;
    what.metricPositions = {positions.data(), size(corners + 1)};
    what.ceiling = {ceiling.data(), size(star.triangleCount)};
    what.ceilingBearer = {bearer.data(), size(star.triangleCount)};
    what.floorError = {errorCode.data(), size(floor.size)};
    what.floorBelow = {belowCode.data(), size(floor.size)};
    what.floorAbove = {aboveCode.data(), size(floor.size)};
    recorder_.record(removal, what);

    refill(mesh_, star, floor, recorder_.firstBirth(removal), removal, movedHalfedge_, seams);
    hole.settle(floor);

    // Two stars can share a link vertex: both write the same value.
    for (int i = 0; i < corners; ++i)
      std::atomic_ref(notes_[star.link[i]].state).store(State::stale, std::memory_order_relaxed);
  }

  /// Bounds go beyond the rounding of the scan itself: they prove things.
  double outward(double x) const { return x == 0 ? 0 : x * (1 + 1e-9) + roundingSlack_; }
  /// An error that is a code but for the last bits of its arithmetic is that code: integer heights make
  /// errors of exactly 1 common, and a tolerance of 1 must take them. The bits are far below what "equal to
  /// the bound" allows.
  double withoutRounding(double x) const { return std::fmax(0.0, x - roundingSlack_); }

 public:
  /// Heights span [low, high].
  void setHeights(double low, double high) {
    roundingSlack_ = roundingSlack(low, high);
    heightRange_ = high - low;
  }

 private:
  static constexpr double kLookAhead = 1.5;

  struct Candidate {
    std::uint32_t cost, tie, vertex;
  };
  struct Chosen {
    std::uint32_t vertex;
    std::uint32_t halfedge;  ///< where its star stands in memory
    std::uint8_t linkSize;
  };

  LiveMesh& mesh_;
  const Plan& plan_;
  Errors& errors_;
  MtRecorder& recorder_;
  Rim* rim_;
  const BuildOptions& options_;
  const RunContext& context_;
  MetricFrame metric_;
  double roundingSlack_ = 0;  // what the arithmetic of a plane can be off by
  double heightRange_ = 0;

  std::vector<std::uint32_t> live_;
  std::vector<Note> notes_;             // per vertex
  std::vector<std::uint32_t> pending_;  // of a level: vertices to evaluate
  std::vector<LiveMesh::Corners> movedHalfedge_;
  std::size_t liveTriangles_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<Chosen> chosen_;
  std::vector<std::uint8_t> linkSizes_;
  std::vector<PendingSeams> seams_;
};

}  // namespace arete
