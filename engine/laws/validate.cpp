// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every law but the fifth concerns a node and its neighbours in the graph, so nodes are checked independently
// and the violation with the smallest node is reported. Law 3 needs no table: a floor lists t only if
// remover(t) is that node, each floor lists without repeats, and the total of the floors equals the number of
// removed triangles; together that is a bijection. No triangle can occur twice in different stars because a
// star's apex is the youngest of its corners.
//
// Law 4 cannot be broken alone. A floor has slots - 2 triangles by the layout of the arrays, and by law 2 its
// boundary is the link, a simple cycle of so many edges. By Euler's formula a connected component with that
// boundary, v vertices inside and g handles has slots - 2 + 2 v + 4 g triangles, so v = g = 0: the floor is a
// polygon, and there are no other components. A proper part of a star has the apex on its boundary, which no
// floor has: no smaller modification exists. So law 4 follows from the other checks.
#include "engine/laws/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "engine/laws/front_edges.h"
#include "engine/mt/node_blocks.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;

struct PlanArea {
  double twice = 0;
  double uncertainty = 0;
};

PlanArea twiceArea(Vec2 a, Vec2 b, Vec2 c) {
  const double p = (b.x - a.x) * (c.y - a.y), q = (b.y - a.y) * (c.x - a.x);
  return {p - q, 8 * std::numeric_limits<double>::epsilon() * (std::abs(p) + std::abs(q))};
}

class NodeCheck {
 public:
  NodeCheck(const MultiTriangulation& mt, const ValidateOptions& options)
      : mt_(mt), a_(mt.arrays()), options_(options), hasPlan_(mt.vertices().hasPlan()) {}

  /// Empty when node n keeps the laws.
  std::string violation(std::uint32_t n) const {
    const NodeId node(n);
    const auto floor = mt_.floor(node);
    const auto link = mt_.link(node);
    const std::uint32_t slots = mt_.slotCount(node), roots = mt_.rootTriangleCount();

    for (std::size_t i = 0; i < floor.size(); ++i) {
      const std::uint32_t t = floor[i];
      const NodeId creator = mt_.creator(TriangleId(t));
      if (creator.isValid() && creator.index() >= n)
        return fmt::format("law 1: node {} removes triangle {}, which the younger node {} creates", n, t,
                           creator.index());
      if (a_.remover[t] != n)
        return fmt::format("law 3: node {} has triangle {} in its floor, but the remover of {} is {}", n, t,
                           t, a_.remover[t]);
      for (std::size_t j = 0; j < i; ++j)
        if (floor[j] == t) return fmt::format("law 3: node {} lists triangle {} twice", n, t);
    }
    // The last slot of an open star holds no triangle, and its remover is the node itself.
    for (std::uint32_t i = 0; i < slots; ++i) {
      if (link[i] >= mt_.apex(node).index())
        return fmt::format("law 1: node {} inserts vertex {} next to the younger vertex {}", n,
                           mt_.apex(node).index(), link[i]);
      for (std::uint32_t j = 0; j < i; ++j)
        if (link[j] == link[i])
          return fmt::format("law 3: node {} has vertex {} twice in its link", n, link[i]);
      const std::uint32_t r = a_.remover[roots + a_.slotBegin[n] + i];
      if (r != kNone && r <= n && !(r == n && i + 1 == slots))
        return fmt::format("law 1: node {} creates triangle {}, which the older node {} removes", n,
                           roots + a_.slotBegin[n] + i, r);
    }
    if (std::string what = boundary(n); !what.empty()) return what;
    if (std::string what = saturation(n); !what.empty()) return what;
    // Blocks and pages of nodes bound their members' errors and spheres, since cuts skip them as a whole.
    for (const std::uint64_t entry : blockEntries(mt_.nodeCount(), n)) {
      if (!holdsError(a_, entry, n))
        return fmt::format("law 6: block {} has a smaller error than its node {}", entry, n);
      if (!holdsSphere(a_, entry, n))
        return fmt::format("law 6: the sphere of block {} does not hold that of its node {}", entry, n);
    }
    return {};
  }

 private:
  std::string boundary(std::uint32_t n) const {
    const NodeId node(n);
    const auto link = mt_.link(node);
    const auto floor = mt_.floor(node);
    const std::uint32_t slots = mt_.slotCount(node);
    struct Edge {
      std::uint32_t from, to, triangle;
    };
    std::vector<Edge> edges;
    double floorArea = 0, starArea = 0, uncertainty = 0;
    // Areas are sums with bounds of their rounding, so that a valid file is never refused for it.
    for (std::uint32_t f = 0; f < floor.size(); ++f) {
      const auto c = mt_.corners(TriangleId(floor[f]));
      if (hasPlan_) {
        const PlanArea area = twiceArea(plan(c[0]), plan(c[1]), plan(c[2]));
        if (area.twice < -area.uncertainty) return fmt::format("law 2: triangle {} is turned over", floor[f]);
        floorArea += area.twice;
        uncertainty += area.uncertainty;
      }
      for (int i = 0; i < 3; ++i) edges.push_back({c[i], c[(i + 1) % 3], f});
    }
    for (std::uint32_t i = 0; hasPlan_ && i < mt_.ceilingSize(node); ++i) {
      const Vec2 apex = plan(mt_.apex(node).index());
      const PlanArea area = twiceArea(apex, plan(link[i]), plan(link[(i + 1) % slots]));
      if (area.twice < -area.uncertainty)
        return fmt::format("law 2: triangle {} is turned over", mt_.slotTriangle(node, i).index());
      starArea += area.twice;
      uncertainty += area.uncertainty;
    }
    // Each rim edge once among the floor's edges; every other edge paired with its reverse, joining two
    // triangles.
    std::vector<std::uint32_t> group(floor.size());
    std::iota(group.begin(), group.end(), 0u);
    const auto find = [&](std::uint32_t x) {
      while (group[x] != x) x = group[x];
      return x;
    };
    std::size_t onRim = 0, inner = 0;
    // Edges are compared with each other in pairs, since a floor has few triangles.
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Edge& e = edges[i];
      std::size_t same = 0, reverse = 0;
      for (const Edge& g : edges) {
        same += g.from == e.from && g.to == e.to ? 1 : 0;
        if (g.from == e.to && g.to == e.from) {
          ++reverse;
          group[find(g.triangle)] = find(e.triangle);
        }
      }
      bool isRim = false;
      for (std::uint32_t k = 0; k < slots; ++k) isRim |= link[k] == e.from && link[(k + 1) % slots] == e.to;
      if (same != 1 || reverse != (isRim ? 0u : 1u))
        return fmt::format(
            "law 2: in node {}, the floor's edge {}-{} occurs {} times, its reverse {} times, {} the rim", n,
            e.from, e.to, same, reverse, isRim ? "on" : "off");
      (isRim ? onRim : inner) += 1;
    }
    // The floor is one polygon if its triangles are connected and share one inner edge less than there are
    // triangles.
    if (onRim != slots)
      return fmt::format("law 2: the floor of node {} holds {} of the rim's {} edges", n, onRim, slots);
    for (std::uint32_t f = 1; f < floor.size(); ++f)
      if (find(f) != find(0)) return fmt::format("law 4: the floor of node {} falls into parts", n);
    if (inner != 2 * (floor.size() - 1))
      return fmt::format("law 4: the floor of node {} is not one polygon", n);
    const double excess = floorArea - starArea;
    const bool mayExceed = options_.allowsFills && mt_.isOpen(node);
    if (excess < -uncertainty || (!mayExceed && excess > uncertainty))
      return fmt::format("law 2: node {} covers {} with its floor and {} with its ceiling", n, floorArea / 2,
                         starArea / 2);
    return {};
  }

  /// A test of a node must never pass where its child's, or a triangle's of its floor, fails: errors and
  /// spheres of a node hold all below it.
  std::string saturation(std::uint32_t n) const {
    const NodeId node(n);
    for (const std::uint32_t t : mt_.floor(node))
      if (a_.error[t] > a_.saturatedError[n])
        return fmt::format("law 6: node {} has saturated error {}, its floor's triangle {} has {}", n,
                           mt_.saturatedError(node), t, mt_.error(TriangleId(t)));
    const Sphere& s = a_.sphere[n];
    const auto reaches = [&](double x, double y, double z, double radius) {
      const double dx = x - s.x, dy = y - s.y, dz = z - s.z;
      return std::sqrt(dx * dx + dy * dy + dz * dz) + radius;
    };
    const auto holds = [&](std::uint32_t v) {
      const Vec3 p = a_.metric.toMetric(mt_.position(VertexId(v)));
      return reaches(p.x, p.y, p.z, 0) <= s.radius * (1 + 1e-9);
    };
    if (!holds(mt_.apex(node).index()))
      return fmt::format("law 6: the sphere of node {} misses its own vertex", n);
    for (const std::uint32_t v : mt_.link(node))
      if (!holds(v)) return fmt::format("law 6: the sphere of node {} misses its link's vertex {}", n, v);
    // The triangles that a node adds are removed by its children, whose errors and spheres the node must
    // hold.
    for (std::uint32_t i = 0; i < mt_.ceilingSize(node); ++i) {
      const NodeId child = mt_.remover(mt_.slotTriangle(node, i));
      if (!child.isValid()) continue;
      if (a_.saturatedError[child.index()] > a_.saturatedError[n])
        return fmt::format("law 6: node {} has a smaller saturated error than its child {}", n,
                           child.index());
      const Sphere& c = a_.sphere[child.index()];
      if (reaches(c.x, c.y, c.z, c.radius) > s.radius * (1 + 1e-9))
        return fmt::format("law 6: the sphere of node {} does not hold that of its child {}", n,
                           child.index());
    }
    return {};
  }

  Vec2 plan(std::uint32_t v) const { return a_.vertices.planPosition(VertexId(v)); }

  const MultiTriangulation& mt_;
  const MtArrays& a_;
  const ValidateOptions& options_;
  const bool hasPlan_;  // areas are those of the plan
};

tl::unexpected<Error> broken(std::string what) {
  return failure(ErrorCode::brokenPromise, std::move(what));
}

}  // namespace

Status validate(const MultiTriangulation& mt, const ValidateOptions& options, const RunContext& context) try {
  const MtArrays& a = mt.arrays();
  const std::uint32_t nodes = mt.nodeCount();
  for (std::uint32_t n = 0; n + 1 < nodes; ++n)
    if (MultiTriangulation::bandOf(a.saturatedError[n]) < MultiTriangulation::bandOf(a.saturatedError[n + 1]))
      return broken(
          fmt::format("order: node {} is in a lower band of saturated errors than node {}", n, n + 1));
  for (std::size_t i = 0; i < a.creatorHint.size(); ++i) {
    const std::uint32_t n = a.creatorHint[i];
    const std::size_t slot = i * MultiTriangulation::kSlotsPerHint;
    if (n >= nodes || a.slotBegin[n] > slot || a.slotBegin[n + 1] <= slot)
      return broken(
          fmt::format("order: creator hint {} names node {}, which does not own slot {}", i, n, slot));
  }

  const NodeCheck check(mt, options);
  struct First {
    std::uint32_t node = kNone;
    std::string what;
  };
  const First first = parallelReduce(
      IndexRange<std::uint32_t>(0, nodes, 4096), First{},
      [&](const auto& range, First found) {
        for (std::uint32_t n = range.begin(); n != range.end() && found.node == kNone; ++n) {
          if (context.cancelled()) break;
          if (std::string what = check.violation(n); !what.empty()) found = {n, std::move(what)};
        }
        return found;
      },
      [](const First& x, const First& y) { return x.node <= y.node ? x : y; });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the validation was interrupted");
  if (first.node != kNone) return broken(first.what);

  std::uint64_t removed = 0, dummies = 0;
  for (std::uint32_t n = 0; n < nodes; ++n) dummies += mt.isOpen(NodeId(n)) ? 1 : 0;
  for (const std::uint32_t r : a.remover) removed += r != kNone ? 1 : 0;
  if (removed - dummies != a.floor.size())
    return broken(fmt::format("law 3: {} a remover, the floors list {}",
                              counted(removed - dummies, "triangle has", "triangles have"), a.floor.size()));
  if (!a.vertices.hasPlan()) return {};
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
    const auto& c = a.rootTriangles[t];
    const auto p = [&](int i) { return a.vertices.planPosition(VertexId(c[i])); };
    const PlanArea area = twiceArea(p(0), p(1), p(2));
    if (area.twice < -area.uncertainty)
      return broken(fmt::format("law 5: root triangle {} is turned over", t));
  }
  return {};
} catch (...) {
  return caughtFailure();
}

namespace {

struct FrontExtent {
  DomainExtent extent;
  double areaUncertainty = 0;
  std::string violation;  ///< the first
};

FrontExtent joined(FrontExtent x, const FrontExtent& y) {
  x.extent.area += y.extent.area;
  x.extent.borderLength += y.extent.borderLength;
  x.areaUncertainty += y.areaUncertainty;
  if (x.violation.empty()) x.violation = y.violation;
  return x;
}

/// The sum over [0, count), add(i, sum) for each until there is a violation: the same for any number of
/// threads.
template <class Add>
FrontExtent sumOf(std::size_t count, const Add& add) {
  return parallelSum(
      IndexRange<std::size_t>(0, count, 1 << 14), FrontExtent{},
      [&](const auto& range, FrontExtent sum) {
        for (std::size_t i = range.begin(); i != range.end() && sum.violation.empty(); ++i)
          add(static_cast<std::uint32_t>(i), sum);
        return sum;
      },
      joined);
}

FrontExtent frontExtent(const MultiTriangulation& mt, const Cut& cut) {
  const auto plan = [&](std::uint32_t i) { return mt.vertices().planPosition(VertexId(cut.vertices[i])); };
  const FrontExtent triangles = sumOf(cut.triangles.size(), [&](std::uint32_t t, FrontExtent& sum) {
    const auto& c = cut.triangles[t];
    const PlanArea area = twiceArea(plan(c[0]), plan(c[1]), plan(c[2]));
    if (area.twice < -area.uncertainty || c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
      sum.violation = fmt::format("law 5: triangle {} of the front is turned over", cut.ids[t]);
    sum.extent.area += area.twice / 2;
    sum.areaUncertainty += area.uncertainty;
  });
  if (!triangles.violation.empty()) return triangles;
  const FrontEdges edges(cut);
  const auto isForward = [&](const FrontEdges::Side& side) {
    return cut.triangles[side.triangle()][(side.corner() + 1) % 3] == side.high;
  };
  return joined(triangles, sumOf(edges.vertices(), [&](std::uint32_t low, FrontExtent& sum) {
                  edges.visitFrom(low, [&](std::span<const FrontEdges::Side> sides) {
                    const bool isOneSided = sides.size() == 2 && isForward(sides[0]) == isForward(sides[1]);
                    if ((sides.size() > 2 || isOneSided) && sum.violation.empty())
                      sum.violation = fmt::format("law 5: edge {}-{} has {} triangles{}", cut.vertices[low],
                                                  cut.vertices[sides[0].high], sides.size(),
                                                  isOneSided ? " on one side" : "");
                    if (sides.size() > 1) return;
                    const Vec2 p = plan(low), q = plan(sides[0].high);
                    sum.extent.borderLength += std::hypot(q.x - p.x, q.y - p.y);
                  });
                }));
}

}  // namespace

DomainExtent domainExtent(const MultiTriangulation& mt) {
  return frontExtent(mt, frontOfPrefix(mt, mt.nodeCount())).extent;
}

Status validateFront(const MultiTriangulation& mt, const Cut& cut, const DomainExtent& domain,
                     const ValidateOptions& options) try {
  const FrontExtent found = frontExtent(mt, cut);
  if (!found.violation.empty()) return broken(found.violation);
  const double slack = found.areaUncertainty + 1e-9 * domain.area;
  const double excess = found.extent.area - domain.area;
  if (excess < -slack || (!options.allowsFills && excess > slack))
    return broken(
        fmt::format("law 5: the front covers {} of a domain of {}", found.extent.area, domain.area));
  if (!options.allowsFills &&
      std::abs(found.extent.borderLength - domain.borderLength) > 1e-9 * domain.borderLength)
    return broken(fmt::format("law 5: the front's border is {} long, the domain's {}",
                              found.extent.borderLength, domain.borderLength));
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
