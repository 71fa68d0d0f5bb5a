// SPDX-License-Identifier: GPL-3.0-or-later
//
// The wider the nodes of a packet reach, the more packets depend on each other. A node's reach is the width
// of its star; its class is the number of widths (each a fixed multiple of the one before) that it or any of
// its descendants exceeds, so no node has a parent of a lower class. Of pages it rises with the saturated
// error too, which no descendant exceeds either, so that the nodes of a coarse cut lie together in few pages.
// The highest class is packet 0. Each other class has tiles, as many times as wide as the tiles of the class
// below. A node's rectangle is the union of its own tile and of the rectangles of its parents of the same
// class, rounded outwards to at most 2 x 2 tiles of some level (the least one for which so few suffice, and
// no less than the parents'). Reaches are a fraction of a tile and most parents are of a higher class than
// their children, so most rectangles are one tile. A packet is the nodes of one class and rectangle.
//
// Packets of one class are in Morton order of the last corner of their rectangles. This corner is not before
// that of any part of the rectangle, so a packet comes soon after those that it depends on.
//
// What nodes get from their parents, or parents from their children, lies all over the arrays, so it is
// prefetched (slot_to_node.h). The rest goes packet by packet, in parallel.
#include "io/store/packed/nodes/plan.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/base/box3.h"
#include "engine/base/morton.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/enclosing_ball.h"
#include "engine/mt/hole_limit.h"
#include "engine/parallel/parallel_loops.h"
#include "io/store/packed/nodes/spread.h"

namespace arete::packed {
namespace {

constexpr int kMostClasses = 24;

/// The place of a vertex, by which nodes are put into packets. The third coordinate of one of a heightfield
/// is 0.
Vec3 placeOf(const VertexArrays& vertices, VertexId v) {
  if (!vertices.hasPlan()) return vertices.place(v);
  const Vec2 p = vertices.planPosition(v);
  return {p.x, p.y, 0};
}

/// A box of tiles, along columns, rows and (of a surface) layers.
struct Tiles {
  std::array<std::int32_t, 3> begin{}, end{};
  std::int32_t level = 0;
  std::uint8_t reach = 0;  ///< class

  bool operator==(const Tiles&) const = default;

  void include(const Tiles& t) {
    level = std::max(level, t.level);
    for (std::size_t k = 0; k < 3; ++k) {
      begin[k] = std::min(begin[k], t.begin[k]);
      end[k] = std::max(end[k], t.end[k]);
    }
  }
  /// Rounds outwards to the least level, not below the present one, at which it has at most two tiles along
  /// each axis.
  void round() {
    for (;; ++level) {
      const std::int32_t unit = std::int32_t{1} << level;
      bool fits = true;
      for (std::size_t k = 0; k < 3; ++k) {
        begin[k] &= -unit;
        end[k] = (end[k] + unit - 1) & -unit;
        fits = fits && end[k] - begin[k] <= 2 * unit;
      }
      if (fits) return;
    }
  }
  /// The sort key of packets.
  auto key() const {
    const auto last = [&](std::size_t k) { return static_cast<std::uint32_t>(end[k] - 1); };
    const auto width = [&](std::size_t k) { return std::int64_t{end[k] - begin[k]}; };
    // Rasters may have more tiles along an axis than a code in space has bits for.
    const std::uint64_t code =
        end[2] == 0 ? mortonCode(last(0), last(1)) : mortonCode(last(0), last(1), last(2));
    return std::tuple(-int{reach}, code, level, width(0) * width(1) * std::max<std::int64_t>(width(2), 1),
                      begin[1], begin[0], begin[2]);
  }
};

/// The grid of tiles.
struct Tiling {
  Vec3 origin{0, 0, 0};  ///< of tile (0, 0, 0)
  double size = 1;       ///< the side of a tile
  int classes = 0;       ///< number of classes below that of packet 0
  bool hasLayers = false;
  double reachesPerTile = 8;
  int levelsPerClass = 2;

  /// The width of a tile in tiles of the class below.
  double step() const { return std::exp2(levelsPerClass); }
};

/// Classes of about as many nodes each; nodes without error are one of their own.
void findBandClasses(const std::array<std::uint32_t, MultiTriangulation::kBands>& perBand,
                     std::uint32_t nodes, Directory& directory) {
  std::uint64_t above = 0;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
    directory.bandClass[band] = static_cast<std::uint8_t>(
        std::min<std::uint64_t>(kClasses - 2, above * (kClasses - 1) / std::max(nodes, 1u)));
    above += perBand[band];
  }
  directory.bandClass[0] = kClasses - 1;
}

/// Per band, the least class of its nodes, which falls with the bands.
std::array<std::uint8_t, MultiTriangulation::kBands> leastClasses(
    const std::array<std::uint32_t, MultiTriangulation::kBands>& perBand, std::uint32_t nodes,
    double shareOfClassOne, const Tiling& tiling) {
  std::array<std::uint8_t, MultiTriangulation::kBands> least{};
  std::uint64_t sofar = 0;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
    sofar += perBand[band];
    double most = shareOfClassOne * nodes;
    for (; least[band] < tiling.classes && static_cast<double>(sofar) <= most;
         most /= tiling.step() * tiling.step())
      ++least[band];
  }
  return least;
}

/// The area of the triangles that stay.
double finestArea(const MultiTriangulation& mt) {
  const VertexArrays& vertices = mt.vertices();
  double doubled = 0;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    if (mt.remover(TriangleId(t)).isValid()) continue;
    const auto [i, j, k] = mt.corners(TriangleId(t));
    const Vec3 p = vertices.place(VertexId(i));
    doubled += norm(cross(vertices.place(VertexId(j)) - p, vertices.place(VertexId(k)) - p));
  }
  return doubled / 2;
}

Tiling tilingOf(const MultiTriangulation& mt, const MtKind& kind, const PlanRule& rule) {
  Tiling tiling;
  tiling.hasLayers = !kind.hasPlan();
  tiling.reachesPerTile = rule.reachesPerTile;
  tiling.levelsPerClass = rule.levelsPerClass;
  double width = std::max(kind.columns, kind.rows);
  if (kind.hasPlan() && kind.isLattice) {
    tiling.size = rule.tileSamples;
  } else {
    const std::uint32_t count = mt.vertices().size();
    if (count == 0) return tiling;
    Box3 box = Box3::empty();
    for (std::uint32_t v = 0; v < count; ++v) box.include(placeOf(mt.vertices(), VertexId(v)));
    tiling.origin = box.low;
    width = box.longestSide();
    const double area =
        !kind.hasPlan() ? finestArea(mt) : (box.high.x - box.low.x) * (box.high.y - box.low.y);
    const double fit = std::sqrt(area / static_cast<double>(count)) * rule.tileSamples;
    // Long thin clouds: never more than a million tiles along a side.
    const double size = std::fmax(fit, width / 1e6);
    if (!std::isfinite(size) || !(size > 0)) return tiling;
    tiling.size = size;
  }
  for (double size = tiling.size; size < width && tiling.classes < kMostClasses; size *= tiling.step())
    ++tiling.classes;
  return tiling;
}

/// The largest values of a node and all its descendants.
struct Descent {
  std::uint16_t error = 0;  ///< saturated, as by the recorder
  std::uint8_t reach = 0;   ///< class of its reach
};

/// The values of a node alone.
Descent ownOf(const MultiTriangulation& mt, NodeId n, const Tiling& tiling) {
  const MtArrays& a = mt.arrays();
  Descent own;
  for (const std::uint32_t t : mt.floor(n)) own.error = std::max(own.error, a.error[t]);
  Box3 box = Box3::empty();
  box.include(placeOf(a.vertices, mt.apex(n)));
  for (const std::uint32_t v : mt.link(n)) box.include(placeOf(a.vertices, VertexId(v)));
  const double width = box.longestSide();
  double most = tiling.size / tiling.reachesPerTile;
  for (; own.reach < tiling.classes && width > most; most *= tiling.step()) ++own.reach;
  return own;
}

/// Visits the parents of nodes, one floor after the other, with prefetches.
class Parents {
 public:
  Parents(const MultiTriangulation& mt, const SlotToNode& owners)
      : floor_(mt.arrays().floor), owners_(owners), roots_(mt.rootTriangleCount()), slots_(mt.slotTotal()) {}

  /// Calls visit(parent) for the i-th entry of all floors, unless that is a triangle of the root.
  /// @param step       1 or -1: the direction of the visits
  /// @param ofParents  the array that visit() reads at the parent; prefetched for later entries
  template <class T, class Visit>
  [[gnu::always_inline]] void at(std::uint32_t i, int step, const T* ofParents, const Visit& visit) const {
    const std::uint32_t far = slotAt(i + kFarAhead * step), near = slotAt(i + kAhead * step);
    if (far < slots_) owners_.prefetch(far);
    if (near < slots_) __builtin_prefetch(ofParents + owners_.of(near));
    if (const std::uint32_t slot = slotAt(i); slot < slots_) visit(owners_.of(slot));
  }

 private:
  /// At least slots_ for a triangle of the root, and beyond either end.
  std::uint32_t slotAt(std::int64_t i) const {
    if (i < 0 || i >= static_cast<std::int64_t>(floor_.size())) return ~0u;
    return floor_[static_cast<std::size_t>(i)] - roots_;
  }

  static constexpr std::int64_t kAhead = 32, kFarAhead = 64;  // entries of floors
  std::span<const std::uint32_t> floor_;
  const SlotToNode& owners_;
  std::uint32_t roots_, slots_;
};

std::uint32_t floorBegin(const MtArrays& a, std::uint32_t n) {
  return a.slotBegin[n] - 2 * n;
}

/// The values of all nodes with their descendants.
UninitializedVector<Descent> descentsOf(const MultiTriangulation& mt, const Parents& parents,
                                        const Tiling& tiling) {
  UninitializedVector<Descent> descents(mt.nodeCount());
  parallelFor(IndexRange<std::uint32_t>(0, mt.nodeCount(), 4096), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n) descents[n] = ownOf(mt, NodeId(n), tiling);
  });
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;)
    for (std::uint32_t i = floorBegin(mt.arrays(), n + 1); i-- > floorBegin(mt.arrays(), n);)
      parents.at(i, -1, descents.data(), [&](std::uint32_t parent) {
        Descent& d = descents[parent];
        d.error = std::max(d.error, descents[n].error);
        d.reach = std::max(d.reach, descents[n].reach);
      });
  return descents;
}

/// Finds the rectangle of every node, and numbers rectangles in the order in which they are found.
class Tiler {
 public:
  Tiler(const MultiTriangulation& mt, const Parents& parents, const Tiling& tiling)
      : a_(mt.arrays()), parents_(parents), tiling_(tiling), rectangleOf_(mt.nodeCount()) {
    rectangles_.push_back({.reach = static_cast<std::uint8_t>(tiling.classes)});
    numbers_[rectangles_[0].key()] = 0;
  }

  void run(std::span<const Descent> descents) {
    for (std::uint32_t n = 0; n < descents.size(); ++n)
      rectangleOf_[n] = descents[n].reach == tiling_.classes ? 0 : rectangleOf(n, descents[n].reach);
  }
  /// Per rectangle, its rank by key.
  std::vector<std::uint32_t> order() const {
    std::vector<std::uint32_t> order(rectangles_.size());
    std::uint32_t next = 0;
    for (const auto& [key, number] : numbers_) order[number] = next++;
    return order;
  }
  /// The number of each node's rectangle, moved out.
  UninitializedVector<std::uint32_t> take() { return std::move(rectangleOf_); }

 private:
  std::uint32_t rectangleOf(std::uint32_t n, std::uint8_t reach) {
    const Vec3 p = placeOf(a_.vertices, VertexId(a_.rootVertices + n));
    const auto tileOf = [&](double x, double origin) {
      return static_cast<std::int32_t>((x - origin) / tiling_.size);
    };
    Tiles tiles{.level = tiling_.levelsPerClass * reach, .reach = reach};
    tiles.begin = {tileOf(p.x, tiling_.origin.x), tileOf(p.y, tiling_.origin.y), 0};
    tiles.end = {tiles.begin[0] + 1, tiles.begin[1] + 1, 0};
    if (tiling_.hasLayers) {
      tiles.begin[2] = tileOf(p.z, tiling_.origin.z);
      tiles.end[2] = tiles.begin[2] + 1;
    }
    std::uint32_t likely = last_;
    for (std::uint32_t i = floorBegin(a_, n); i != floorBegin(a_, n + 1); ++i)
      parents_.at(i, 1, rectangleOf_.data(), [&](std::uint32_t parent) {
        const Tiles& parentTiles = rectangles_[rectangleOf_[parent]];
        if (parentTiles.reach != reach) return;
        tiles.include(parentTiles);
        likely = rectangleOf_[parent];
      });
    tiles.round();
    if (rectangles_[likely] != tiles) likely = numberOf(tiles);
    return last_ = likely;
  }
  std::uint32_t numberOf(const Tiles& tiles) {
    const auto [at, isNew] =
        numbers_.try_emplace(tiles.key(), static_cast<std::uint32_t>(rectangles_.size()));
    if (isNew) rectangles_.push_back(tiles);
    return at->second;
  }

  const MtArrays& a_;
  const Parents& parents_;
  const Tiling& tiling_;
  UninitializedVector<std::uint32_t> rectangleOf_;
  std::vector<Tiles> rectangles_;
  std::map<decltype(Tiles().key()), std::uint32_t> numbers_;
  std::uint32_t last_ = 0;
};

/// The nodes of each packet, rising.
struct NodesByPacket {
  UninitializedVector<std::uint32_t> nodes;
  std::vector<std::uint32_t> begin;  ///< per packet, and the end

  NodesByPacket(std::span<const std::uint32_t> packetOf, std::size_t packets)
      : nodes(packetOf.size()), begin(packets + 1, 0) {
    for (const std::uint32_t c : packetOf) ++begin[c + 1];
    for (std::size_t c = 0; c < packets; ++c) begin[c + 1] += begin[c];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t n = 0; n < packetOf.size(); ++n) nodes[next[packetOf[n]]++] = n;
  }
  std::span<const std::uint32_t> of(std::size_t packet) const {
    return std::span(nodes).subspan(begin[packet], begin[packet + 1] - begin[packet]);
  }
};

void addDependency(Packet& packet, std::uint32_t other) {
  const auto at = std::ranges::lower_bound(packet.dependsOn, other);
  if (at == packet.dependsOn.end() || *at != other) packet.dependsOn.insert(at, other);
}

/// By how much the ball of a node's star has to grow to hold the node's ball.
double growthOfBall(const MultiTriangulation& mt, NodeId n, double moved) {
  std::array<Vec3, kMaxHoleCorners + 1> points;
  std::size_t count = 0;
  const auto add = [&](VertexId v) { points[count++] = mt.metric().toMetric(mt.position(v)); };
  add(mt.apex(n));
  for (const std::uint32_t v : mt.link(n)) add(VertexId(v));
  const EnclosingBall star = EnclosingBall::around({points.data(), count});
  const Sphere& all = mt.sphere(n);
  const double apart = std::hypot(all.x - star.x, all.y - star.y, all.z - star.z);
  return (apart + static_cast<double>(all.radius) + moved) / (star.radius + moved);
}

/// What the triangles that a node removes stand for: of a heightfield what lies above and below them, of a
/// surface what lies beside them, within their errors.
void includeFloor(const MultiTriangulation& mt, NodeId n, Box3& box) {
  // Bounds are packed as at most 1.25 times the greater one.
  constexpr double kRoundedUp = 1.26;
  const std::span<const std::uint16_t> below = mt.column(kBelow), above = mt.column(kAbove);
  for (const std::uint32_t t : mt.floor(n)) {
    const bool hasBounds = !below.empty();
    const double reach =
        kRoundedUp * (hasBounds ? mt.scale().decode(std::max(below[t], above[t])) : mt.error(TriangleId(t)));
    const Vec3 beside = hasBounds ? Vec3{0, 0, reach} : Vec3{reach, reach, reach};
    for (const std::uint32_t v : mt.corners(TriangleId(t))) {
      const Vec3 p = mt.position(VertexId(v));
      box.include(p - beside);
      box.include(p + beside);
    }
  }
}

/// Cuts the runs of a packet into segments: each at least as long as all before it together, so that a reader
/// takes no more than about twice the nodes that it needs, of few segments. What is left for the last one
/// stays with the one before it where it is less than half of a segment.
void cutIntoSegments(Packet& packet, std::uint32_t segmentNodes) {
  packet.segments.assign(1, {});
  std::uint32_t before = 0, left = 0;
  for (const Run& run : packet.runs) left += run.nodes;
  for (const Run& run : packet.runs) {
    const std::uint32_t least = std::max(segmentNodes, before);
    if (segmentNodes > 0 && packet.segments.back().nodes >= least && 2 * std::uint64_t{left} >= least) {
      before += packet.segments.back().nodes;
      packet.segments.emplace_back();
    }
    Segment& segment = packet.segments.back();
    if (segment.runs++ == 0) segment.firstBand = run.band;
    segment.nodes += run.nodes;
    left -= run.nodes;
  }
}

/// Fills in a packet and its nodes. Adds to the borders of the packets that it depends on.
void describe(const MultiTriangulation& mt, std::uint32_t c, std::span<const std::uint32_t> nodes,
              const MtKind& kind, const PlanRule& rule, Plan& plan) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount();
  Packet& packet = plan.directory.packets[c];
  if (c > 0) packet.dependsOn.push_back(0);
  Box3 box = Box3::empty();
  std::array<Run, MultiTriangulation::kBands> runs;
  for (const std::uint32_t n : nodes) {
    plan.ownParents[n] = 0;
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      if (t < roots) continue;
      const std::uint32_t parent = plan.packetOf[plan.owners.of(t - roots)];
      if (parent == c) {
        ++plan.ownParents[n];
      } else {
        addDependency(packet, parent);
        std::atomic_ref(plan.directory.packets[parent].borders).fetch_add(1, std::memory_order_relaxed);
      }
    }
    Run& run = runs[plan.band[n]];
    ++run.nodes;
    run.slots += mt.slotCount(NodeId(n));
    if (plan.ownParents[n] == 0) {
      ++run.listed;
      plan.listed[c].push_back(n);
    }
    if (rule.isPaged())
      run.spread = std::max(run.spread, spreadCode(growthOfBall(mt, NodeId(n), kind.moved)));
    if (rule.isPaged()) includeFloor(mt, NodeId(n), box);
    const auto place = [&](VertexId v) { return rule.isPaged() ? mt.position(v) : placeOf(a.vertices, v); };
    box.include(place(mt.apex(NodeId(n))));
    for (const std::uint32_t v : mt.link(NodeId(n))) box.include(place(VertexId(v)));
  }
  packet.xMin = box.low.x;
  packet.yMin = box.low.y;
  packet.xMax = box.high.x;
  packet.yMax = box.high.y;
  if (plan.directory.isOfSurface || rule.isPaged()) {
    packet.zMin = box.low.z;
    packet.zMax = box.high.z;
  }
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
    if (runs[band].nodes == 0) continue;
    runs[band].band = band;
    packet.runs.push_back(runs[band]);
  }
  cutIntoSegments(packet, rule.segmentNodes);
}

}  // namespace

Plan planPackets(const MultiTriangulation& mt, const MtKind& kind, const PlanRule& rule) {
  const std::uint32_t nodes = mt.nodeCount();
  Plan plan(mt.arrays());
  plan.directory.isOfSurface = !kind.hasPlan();
  std::vector<std::uint32_t> order;
  {
    const Tiling tiling = tilingOf(mt, kind, rule);
    const Parents parents(mt, plan.owners);
    auto descents = descentsOf(mt, parents, tiling);
    plan.band.resize(nodes);
    std::array<std::uint32_t, MultiTriangulation::kBands> perBand{};
    for (std::uint32_t n = 0; n < nodes; ++n) {
      plan.band[n] = static_cast<std::uint8_t>(MultiTriangulation::bandOf(descents[n].error));
      ++perBand[plan.band[n]];
    }
    findBandClasses(perBand, nodes, plan.directory);
    if (rule.shareOfClassOne > 0) {
      const auto least = leastClasses(perBand, nodes, rule.shareOfClassOne, tiling);
      for (std::uint32_t n = 0; n < nodes; ++n)
        descents[n].reach = std::max(descents[n].reach, least[plan.band[n]]);
    }
    Tiler tiler(mt, parents, tiling);
    tiler.run(descents);
    order = tiler.order();
    plan.packetOf = tiler.take();
  }
  parallelFor(IndexRange<std::uint32_t>(0, nodes, 1 << 14), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n) plan.packetOf[n] = order[plan.packetOf[n]];
  });
  plan.directory.packets.resize(order.size());
  plan.ownParents.resize(nodes);
  plan.listed.resize(order.size());
  const NodesByPacket nodesBy(plan.packetOf, order.size());
  parallelFor(std::size_t{0}, order.size(), [&](std::size_t c) {
    describe(mt, static_cast<std::uint32_t>(c), nodesBy.of(c), kind, rule, plan);
  });
  plan.directory.number();
  return plan;
}

}  // namespace arete::packed
