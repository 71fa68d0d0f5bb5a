// SPDX-License-Identifier: GPL-3.0-or-later
//
// The root's triangles are joined by sorting their edges. Saturation goes from the last node of a packet to
// the first, so children come before parents; packets are saturated after those that depend on them. A node's
// sphere contains its star and grows around the spheres of its children. A radius is negative until the
// sphere and the saturated error are final, and is written after them: in a damaged file a child may belong
// to any packet.
#include "io/store/packed/nodes/arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/mt/enclosing_ball.h"
#include "engine/parallel/parallel_loops.h"
#include "io/store/packed/nodes/spread.h"

namespace arete::packed {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;
constexpr std::uint32_t kMissing = kNone - 1;
constexpr std::uint32_t kAhead = 8;
constexpr std::size_t kReadable = 8;  // elements behind a column's end

AmtFacts MtKind::facts() const {
  AmtFacts facts;
  facts.kind = model;
  facts.isLattice = isLattice;
  facts.heights = encoding.type;
  facts.hasDoubles = hasDoubles;
  return facts;
}

bool Arrays::allocate(const AmtCounts& counts, std::uint64_t borders) {
  rootVertices = static_cast<std::uint32_t>(counts.rootVertices);
  roots = static_cast<std::uint32_t>(counts.rootTriangles);
  nodes = static_cast<std::uint32_t>(counts.nodes);
  slots = static_cast<std::uint32_t>(counts.slots);
  AmtFacts facts = this->facts();
  facts.counts = counts;
  mtColumns.clear();
  // Columns of blocks are left out: model() derives them from the columns of nodes.
  for (const AmtMtColumn& column : amtMtColumns(facts))
    if (column.per != AmtPer::block && column.coding != AmtCoding::dropped)
      mtColumns.push_back({column, {}, amtCountOf(column.per, facts)});
  const std::size_t n = nodes, v = std::size_t{rootVertices} + n;
  // What the model keeps and what only coding needs are in two arenas, so that the second can go as a whole.
  const bool hasMemory = stays.lay([&](const auto& array) {
    for (Column& column : mtColumns)
      array(column.memory, (column.elements + kReadable) * column.elementBytes());
  }) && goes.lay([&](const auto& array) {
    array(floatPlaces, hasPlan() && holdsFloats() ? v : 0);
    array(doublePlaces, hasPlan() && !holdsFloats() ? v : 0);
    array(star, n);
    array(border, roots + borders);
  });
  if (!hasMemory) return false;
  bindColumns();
  if (!hasPlan()) return true;
  // Whole-numbered heights on a lattice have few errors on small triangles, so their codes come from a table.
  wholeErrors.assign((kLatticeErrorArea + 1) * 16, 0);
  for (unsigned area = 1; area <= kLatticeErrorArea; ++area)
    for (unsigned whole = 0; whole < 16; ++whole)
      wholeErrors[area * 16 + whole] = wholeErrorCode(scale, encoding, whole, area);
  return true;
}

std::uint64_t Arrays::bytesOf(const MtKind& kind, const AmtCounts& counts, std::uint64_t borders) {
  AmtFacts facts = kind.facts();
  facts.counts = counts;
  std::uint64_t bytes = 0;
  for (const AmtMtColumn& column : amtMtColumns(facts))
    if (column.coding != AmtCoding::dropped) bytes += amtCountOf(column.per, facts) * column.elementBytes();
  const std::uint64_t vertices = counts.rootVertices + counts.nodes;
  if (kind.hasPlan()) bytes += vertices * sizeof(Place<double>);  // of floats half as many
  return bytes + counts.nodes + (counts.rootTriangles + borders) * sizeof(Border) +
         (counts.rootTriangles + counts.slots) / 8;
}

void Arrays::bindColumns() {
  bind(amt_tag::kRootTriangles, rootTriangles);
  bind(amt_tag::kSlotBegin, slotBegin);
  bind(amt_tag::kLink, link);
  bind(amt_tag::kRemover, remover);
  bind(amt_tag::kFloor, floor);
  bind(amt_tag::kCreatorHint, creatorHint);
  bind(amt_tag::kError, error);
  bind(amt_tag::kBelow, below);
  bind(amt_tag::kAbove, above);
  bind(amt_tag::kRms, rms);
  bind(amt_tag::kSaturatedError, saturatedError);
  bind(amt_tag::kSphere, sphere);
  bind(amt_tag::kSamples, samples);
  bind(amt_tag::kPlan, plan);
  bind(amt_tag::kHeights, rawHeights);
  if (hasDoubles)
    bind(amt_tag::kPlaces, places64);
  else
    bind(amt_tag::kPlaces, places32);
}

void Arrays::joinRoot() {
  struct Side {
    std::uint64_t edge;
    std::uint32_t at;
  };
  std::vector<Side> sides;
  sides.reserve(3 * std::size_t{roots});
  for (std::uint32_t t = 0; t < roots; ++t)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint64_t p = rootTriangles[t][e], q = rootTriangles[t][(e + 1) % 3];
      sides.push_back({std::min(p, q) << 32 | std::max(p, q), 3 * t + e});
    }
  // The sides of an edge become neighbours. Equal edges go by triangle, so the order does not depend on the
  // sort.
  std::ranges::sort(
      sides, [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.at < b.at; });
  for (std::uint32_t t = 0; t < roots; ++t) border[t] = {rootTriangles[t], t, {kNone, kNone, kNone}};
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const std::uint32_t p = sides[i].at, q = sides[i + 1].at;
    if (sides[i].edge != sides[i + 1].edge) continue;
    border[p / 3].across[p % 3] = q / 3;
    border[q / 3].across[q % 3] = p / 3;
  }
  // A thread that sees the mark also sees the border that it names.
  for (std::uint32_t t = 0; t < roots; ++t)
    std::atomic_ref(remover[t]).store(kMarks | t, std::memory_order_release);
}

void Arrays::finish(bool isPart) {
  // A mark that is left means that no node removes the triangle; marks on other triangles end in saturate().
  // In a part the remover of a triangle with an error may not have been read.
  for (std::uint32_t t = 0; t < roots; ++t)
    if ((remover[t] & kMark) != 0) remover[t] = isPart && error[t] != 0 ? kMissing : kNone;
  slotBegin[nodes] = slots;
  constexpr std::uint32_t k = MultiTriangulation::kSlotsPerHint;
  parallelFor(IndexRange<std::uint32_t>(0, nodes, 1u << 14), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n < range.end(); ++n)
      for (std::uint32_t h = (slotBegin[n] + k - 1) / k; h * k < slotBegin[n + 1]; ++h) creatorHint[h] = n;
  });
  // Triangles that stay are not coded one by one: they all have the same error and RMS.
  if (finestError != 0 || finestRms != 0)
    for (std::uint32_t t = 0; t < roots + slots; ++t)
      if (remover[t] == kNone) {
        error[t] = finestError;
        rms[t] = finestRms;
      }
  if (isPart) {
    missing.assign((std::size_t{roots} + slots + 63) / 64, 0);
    parallelFor(std::size_t{0}, missing.size(), [&](std::size_t word) {
      const std::uint32_t end =
          static_cast<std::uint32_t>(std::min(64 * word + 64, std::size_t{roots} + slots));
      for (std::uint32_t t = static_cast<std::uint32_t>(64 * word); t < end; ++t) {
        if (remover[t] != kMissing) continue;
        missing[word] |= std::uint64_t{1} << t % 64;
        remover[t] = kNone;
      }
    });
  }
}

MultiTriangulation Arrays::model(std::shared_ptr<Arrays> arrays) {
  Arrays& from = *arrays;
  // The arrays of coding go before the blocks are made, so that both are never in memory together.
  from.floatPlaces = {};
  from.doublePlaces = {};
  from.star = {};
  from.border = {};
  from.goes = {};
  from.blocks = makeNodeBlocks(from.saturatedError.view(), from.sphere.view());
  MtArrays a;
  a.rootVertices = from.rootVertices;
  for (const Column& column : from.mtColumns)
    column.mt.put(a, column.memory.view().first(column.elements * column.elementBytes()));
  a.blockError = from.blocks.error;
  a.blockSphere = from.blocks.sphere;
  a.missing = from.missing;
  a.scale = from.scale;
  a.metric = from.metric;
  a.vertices.columns = from.hasPlan() && from.isLattice ? from.columns : 0;
  a.vertices.encoding = from.encoding;
  return MultiTriangulation(a, std::move(arrays));
}

namespace {

/// Grows a ball around others, as EnclosingBall::encloseChild() does, but branch-free, because a processor
/// cannot predict which of two balls contains the other. In floats, for faster roots and quotients; rounded()
/// widens the ball by what they lose.
struct GrowingBall {
  float x, y, z, radius;

  void enclose(const Sphere& child) {
    const float dx = child.x - x, dy = child.y - y, dz = child.z - z, other = child.radius;
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float grown = std::max(std::max(radius, other), (distance + radius + other) * 0.5f);
    // The part of the way to the child's centre: all of it if the child contains this ball.
    const float part = std::min((grown - radius) / std::max(distance, 1e-30f), 1.0f);
    x += dx * part;
    y += dy * part;
    z += dz * part;
    radius = grown;
  }
  /// The ball after `count` steps, each of which lost at most two units in the last place of centre and
  /// radius, widened as by EnclosingBall.
  Sphere rounded(std::uint32_t count) const {
    const float lost = (std::fabs(x) + std::fabs(y) + std::fabs(z) + radius) * 0x1p-22f;
    return {x, y, z, radius * (1 + 3e-6f) + static_cast<float>(count) * lost};
  }
};

/// A node's children, each once or twice.
struct Children {
  std::array<std::uint32_t, 40> nodes;
  std::uint32_t count;
  bool areMissed;  ///< some were not read
};

/// Finds the children of a node and prefetches their spheres. Replaces marks: the dummy record's, of a
/// triangle that no node removes, by kNone, any other by kMissing, as the remover was not read.
void find(const Arrays& a, std::uint32_t n, Children& children) {
  std::uint32_t* const remover = a.remover.get() + a.roots + a.slotBegin[n];
  const std::uint32_t size = a.starSize(n);
  std::uint32_t count = 0, previous = n, missed = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    // A mark becomes kNone, and stands for n; so does n itself, behind an open star.
    static_assert(Arrays::kMark == 1u << 31);
    const std::uint32_t isNone = 0u - (remover[i] >> 31), child = (remover[i] & ~isNone) | (n & isNone);
    const std::uint32_t isMissed = static_cast<std::uint32_t>(((remover[i] & isNone) << 1) != 0);
    missed |= isMissed;
    remover[i] = (remover[i] | isNone) - isMissed;
    children.nodes[count] = child;
    count += static_cast<std::uint32_t>(child != n) & static_cast<std::uint32_t>(child != previous);
    previous = child;
    __builtin_prefetch(&a.sphere[child]);
  }
  // A child of the first and the last triangle is found twice.
  if (count > 1 && children.nodes[0] == children.nodes[count - 1]) --count;
  children.count = count;
  children.areMissed = missed != 0;
}

/// Computes the saturated error and sphere of a node. Precondition: the children are complete; in a damaged
/// file they may not be, which is returned as a problem.
const char* complete(const Arrays& a, std::uint32_t n, const Children& children, std::uint16_t least,
                     const Run& run) {
  Sphere& sphere = a.sphere[n];
  GrowingBall ball{sphere.x, sphere.y, sphere.z, -sphere.radius};
  if (children.areMissed && run.spread > 0) ball.radius *= spreadFactor(run.spread);
  std::uint16_t saturated = std::max(least, a.saturatedError[n]);
  float unready = 0, largest = -1;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < children.count; ++i) {
    const float radius = std::atomic_ref(a.sphere[children.nodes[i]].radius).load(std::memory_order_acquire);
    unready = std::min(unready, radius);
    saturated = std::max(saturated, a.saturatedError[children.nodes[i]]);
    first = radius > largest ? i : first;
    largest = std::max(largest, radius);
  }
  // From the largest child on around the star, so that the ball does not depend on where the link begins,
  // which depends on what is packed together.
  for (std::uint32_t i = 0; i < children.count; ++i) {
    const std::uint32_t at = first + i;
    ball.enclose(a.sphere[children.nodes[at < children.count ? at : at - children.count]]);
  }
  const Sphere grown = ball.rounded(children.count + 1);
  a.saturatedError[n] = saturated;
  sphere.x = grown.x;
  sphere.y = grown.y;
  sphere.z = grown.z;
  std::atomic_ref(sphere.radius).store(grown.radius, std::memory_order_release);
  if (!std::isfinite(grown.x + grown.y + grown.z + grown.radius)) return "an invalid sphere";
  if (unready < 0) return "a child that is not a descendant";
  if (MultiTriangulation::bandOf(saturated) != run.band) return "a saturated error outside of its band";
  return nullptr;
}

}  // namespace

std::optional<std::string> saturate(Arrays& a, const Packet& packet, bool isPart) {
  std::array<Children, kAhead> ahead;
  for (auto run = packet.runs.rbegin(); run != packet.runs.rend(); ++run) {
    const auto least =
        isPart ? static_cast<std::uint16_t>(run->band << MultiTriangulation::kBandShift) : std::uint16_t{0};
    const std::uint32_t last = run->firstNode + run->nodes - 1;
    for (std::uint32_t i = 0; i < std::min(run->nodes, kAhead); ++i) find(a, last - i, ahead[i]);
    for (std::uint32_t i = 0; i < run->nodes; ++i) {
      Children& children = ahead[i % kAhead];
      if (const char* const bad = complete(a, last - i, children, least, *run))
        return fmt::format("node {} has {}", last - i, bad);
      if (run->nodes - i > kAhead) find(a, last - i - kAhead, children);
    }
  }
  return std::nullopt;
}

}  // namespace arete::packed
