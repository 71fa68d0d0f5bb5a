// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recorder does not look at geometry, so removals are made at random: each takes triangles that are there
// and adds new ones. The oracle sorts the nodes and assigns every element by the definitions of MtArrays.
#include "engine/mt/recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "engine/base/id_array.h"
#include "engine/ids_of.h"

namespace arete {
namespace {

using test::after;
using test::idsBelow;
using test::idsOf;

struct Removal {
  RemovalId id;  // as recorded
  VertexId vertex;
  std::uint32_t batch, inBatch;
  MtRecorder::BatchOrder order;
  bool isOpen;
  std::vector<VertexId> link;
  std::vector<RecorderId> ceiling;
  std::vector<RemovalId> creators;
  std::vector<FloorCodes> codes;
  std::vector<Vec3> positions;
  RecorderId firstFloor;
  std::uint16_t saturated;
};

/// A run of the recorder, and what it was given.
struct Recording {
  std::uint32_t finest, vertices;
  IdArray<RemovalId, std::vector<Removal>> removals;
  std::vector<SurvivingTriangle> surviving;
  std::vector<VertexId> rootVertices, vertexOrder;
  MultiTriangulation mt;
};

std::uint16_t anyCode(std::mt19937_64& random) {
  return static_cast<std::uint16_t>(random() >> (random() % 16));
}

/// @param reversed Records the removals of a batch from the last to the first.
Recording record(unsigned seed, bool reversed = false) {
  std::mt19937_64 random(seed);
  const std::uint32_t wanted = 1 + static_cast<std::uint32_t>(random() % 3000);
  Recording r;
  r.finest = 2 * wanted + 40;
  r.vertices = wanted + 20;
  MtRecorder recorder(r.finest, wanted, OutwardScale(1000), {});
  std::vector<RecorderId> alive;
  std::vector<VertexId> vertices;
  IdArray<RecorderId, std::vector<RemovalId>> creator(r.finest);
  for (const RecorderId t : idsBelow<RecorderId>(r.finest)) alive.push_back(t);
  for (const VertexId v : idsBelow<VertexId>(r.vertices)) vertices.push_back(v);
  std::ranges::shuffle(vertices, random);
  std::uint32_t done = 0;
  for (std::uint32_t batch = 0; done < wanted; ++batch) {
    std::ranges::shuffle(alive, random);
    std::vector<std::uint8_t> sizes;
    std::vector<bool> open;
    std::size_t taken = 0;
    for (std::size_t i = 0, most = 1 + random() % 200; i < most && done + sizes.size() < wanted; ++i) {
      const auto size = static_cast<std::uint8_t>(3 + random() % 6);
      if (taken + size > alive.size()) break;
      sizes.push_back(size);
      open.push_back(random() % 7 == 0);
      taken += size - (open.back() ? 1 : 0);
    }
    if (sizes.empty()) break;
    const MtRecorder::BatchOrder order{batch / 3, static_cast<std::uint32_t>(batch % 3 / 2)};
    const RemovalId first = recorder.beginBatch(order, sizes);
    std::vector<RecorderId> added;
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < sizes.size(); ++i) {
      Removal removal{.id = after(first, i),
                      .vertex = vertices[done + i],
                      .batch = batch,
                      .inBatch = i,
                      .order = order,
                      .isOpen = open[i],
                      .link = {},
                      .ceiling = {},
                      .creators = {},
                      .codes = {},
                      .positions = {},
                      .firstFloor = recorder.firstFloorTriangle(after(first, i)),
                      .saturated = 0};
      for (int k = 0; k < sizes[i]; ++k) removal.link.push_back(vertices[random() % vertices.size()]);
      for (int k = 0; k < sizes[i] - (open[i] ? 1 : 0); ++k, ++at) {
        removal.ceiling.push_back(alive[at]);
        removal.creators.push_back(creator[alive[at]]);
      }
      for (std::size_t k = 0; k + 2 < sizes[i]; ++k) {
        removal.codes.push_back({anyCode(random), anyCode(random), anyCode(random)});
        added.push_back(after(removal.firstFloor, k));
        creator.resize(std::max<std::size_t>(creator.size(), added.back().index() + 1));
        creator[added.back()] = removal.id;
      }
      for (int k = 0; k <= sizes[i]; ++k)
        removal.positions.push_back({double(random() % 999), double(random() % 999), double(random() % 99)});
      for (const FloorCodes& c : removal.codes) removal.saturated = std::max(removal.saturated, c.error);
      for (const RemovalId c : removal.creators)
        if (c.isValid()) removal.saturated = std::max(removal.saturated, r.removals[c].saturated);
      r.removals.push_back(removal);
    }
    const auto write = [&](std::uint32_t i) {
      const Removal& removal = r.removals[after(first, i)];
      const VertexRemoval what{.vertex = removal.vertex,
                               .link = removal.link,
                               .isOpen = removal.isOpen,
                               .metricPositions = removal.positions,
                               .ceiling = removal.ceiling,
                               .ceilingCreator = removal.creators,
                               .floor = removal.codes};
      recorder.record(removal.id, what);
      recorder.saturate(removal.id, what);
    };
    for (std::uint32_t i = 0; i < sizes.size(); ++i)
      write(reversed ? static_cast<std::uint32_t>(sizes.size()) - 1 - i : i);
    alive.erase(alive.begin(), alive.begin() + static_cast<std::ptrdiff_t>(taken));
    alive.insert(alive.end(), added.begin(), added.end());
    done += static_cast<std::uint32_t>(sizes.size());
  }
  r.rootVertices.assign(vertices.begin() + done, vertices.end());
  for (const RecorderId t : alive)
    r.surviving.push_back(
        {t, {vertices[random() % r.vertices], vertices[random() % r.vertices], VertexId(0)}});
  UninitializedVector<std::uint32_t> order;
  r.mt = recorder.finish(r.rootVertices, r.surviving, r.vertices, order);
  for (const std::uint32_t v : order) r.vertexOrder.push_back(VertexId(v));
  return r;
}

/// Removals by falling band, within one by falling order of batches, the later announced first.
std::vector<RemovalId> nodesInOrder(const Recording& r) {
  std::vector<RemovalId> nodes;
  for (const Removal& removal : r.removals) nodes.push_back(removal.id);
  const auto key = [&](RemovalId id) {
    const Removal& x = r.removals[id];
    return std::tuple(MultiTriangulation::bandOf(x.saturated), x.order, x.batch, x.inBatch);
  };
  std::ranges::sort(nodes, [&](RemovalId a, RemovalId b) { return key(a) > key(b); });
  return nodes;
}

TEST(MtRecorder, FinishesIntoTheArraysByTheirDefinitions) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Recording r = record(seed);
    const MtArrays& a = r.mt.arrays();
    const std::vector<RemovalId> nodes = nodesInOrder(r);
    ASSERT_EQ(r.mt.nodeCount(), nodes.size());
    ASSERT_EQ(r.mt.rootTriangleCount(), r.surviving.size());
    const auto roots = static_cast<std::uint32_t>(r.rootVertices.size());
    ASSERT_EQ(r.mt.rootVertexCount(), roots);

    std::vector<VertexId> order = r.rootVertices;
    for (const RemovalId removal : nodes) order.push_back(r.removals[removal].vertex);
    ASSERT_EQ(r.vertexOrder, order);
    IdArray<VertexId, std::vector<std::uint32_t>> newVertex(r.vertices, VertexId::kInvalid);
    for (std::uint32_t i = 0; i < order.size(); ++i) newVertex[order[i]] = i;

    // Recorder ids of all MT triangles, in order; invalid in the last slot of an open star.
    std::vector<RecorderId> recorded;
    std::vector<NodeId> ownerOfSlot;
    for (const SurvivingTriangle& t : r.surviving) recorded.push_back(t.id);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const Removal& removal = r.removals[nodes[n]];
      EXPECT_EQ(a.slotBegin[n], recorded.size() - r.surviving.size());
      EXPECT_EQ(a.saturatedError[n], removal.saturated);
      EXPECT_EQ(r.mt.isOpen(NodeId(n)), removal.isOpen);
      for (std::size_t i = 0; i < removal.link.size(); ++i) {
        EXPECT_EQ(a.link[a.slotBegin[n] + i], newVertex[removal.link[i]]);
        recorded.push_back(i < removal.ceiling.size() ? removal.ceiling[i] : RecorderId());
        ownerOfSlot.push_back(NodeId(n));
      }
    }
    ASSERT_EQ(a.remover.size(), recorded.size());
    std::map<RecorderId, std::uint32_t> newId;
    std::map<RecorderId, NodeId> remover;
    std::map<RecorderId, FloorCodes> codes;
    for (std::uint32_t t = 0; t < recorded.size(); ++t)
      if (recorded[t].isValid()) newId[recorded[t]] = t;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const Removal& removal = r.removals[nodes[n]];
      for (std::uint32_t i = 0; i < removal.codes.size(); ++i) {
        const RecorderId added = after(removal.firstFloor, i);
        remover[added] = NodeId(n);
        codes[added] = removal.codes[i];
        EXPECT_EQ(r.mt.floor(NodeId(n))[i], newId.at(added));
      }
    }
    for (std::uint32_t t = 0; t < recorded.size(); ++t) {
      const FloorCodes expected = codes.contains(recorded[t]) ? codes[recorded[t]] : FloorCodes{};
      EXPECT_EQ(a.error[t], expected.error);
      EXPECT_EQ(a.columns.of(kBelow)[t], expected.below);
      EXPECT_EQ(a.columns.of(kAbove)[t], expected.above);
      const NodeId owner = t < r.surviving.size() ? NodeId() : ownerOfSlot[t - r.surviving.size()];
      EXPECT_EQ(NodeId(a.remover[t]), !recorded[t].isValid()          ? owner
                                      : remover.contains(recorded[t]) ? remover[recorded[t]]
                                                                      : NodeId());
      EXPECT_EQ(r.mt.creator(TriangleId(t)), owner);
    }
    for (std::size_t t = 0; t < r.surviving.size(); ++t)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(a.rootTriangles[t][k], newVertex[r.surviving[t].corners[k]]);
  }
}

TEST(MtRecorder, SaturatesSpheresAroundStarsAndChildren) {
  const Recording r = record(99);
  const std::vector<RemovalId> nodes = nodesInOrder(r);
  IdArray<RemovalId, std::vector<std::uint32_t>> nodeOf(nodes.size());
  for (std::uint32_t n = 0; n < nodes.size(); ++n) nodeOf[nodes[n]] = n;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const Removal& removal = r.removals[nodes[n]];
    const Sphere& ball = r.mt.arrays().sphere[n];
    const auto distance = [&](double x, double y, double z) {
      return norm(Vec3{x - ball.x, y - ball.y, z - ball.z});
    };
    for (const Vec3& p : removal.positions) EXPECT_LE(distance(p.x, p.y, p.z), ball.radius);
    for (const RemovalId child : removal.creators) {
      if (!child.isValid()) continue;
      const Sphere& inner = r.mt.arrays().sphere[nodeOf[child]];
      EXPECT_LE(distance(inner.x, inner.y, inner.z) + inner.radius, ball.radius);
      EXPECT_GT(nodeOf[child], n) << "parents come first";
    }
  }
}

TEST(MtRecorder, DoesNotDependOnTheOrderInWhichABatchIsRecorded) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    const Recording a = record(seed), b = record(seed, true);
    const MtArrays &x = a.mt.arrays(), &y = b.mt.arrays();
    EXPECT_EQ(a.vertexOrder, b.vertexOrder);
    EXPECT_TRUE(std::ranges::equal(x.link, y.link));
    EXPECT_TRUE(std::ranges::equal(x.remover, y.remover));
    EXPECT_TRUE(std::ranges::equal(x.floor, y.floor));
    EXPECT_TRUE(std::ranges::equal(x.error, y.error));
    EXPECT_TRUE(std::ranges::equal(x.saturatedError, y.saturatedError));
  }
}

TEST(MtRecorder, KnowsTheCodesOfEarlierBatchesAndZerosOfTheFinestTriangles) {
  MtRecorder recorder(10, 1, OutwardScale(1), {});
  const std::uint8_t size = 4;
  const RemovalId first = recorder.beginBatch({}, {&size, 1});
  const std::vector<VertexId> link = idsOf<VertexId>({0, 1, 2, 3});
  const std::vector<RecorderId> ceiling = idsOf<RecorderId>({0, 1, 2, 3});
  const std::vector<RemovalId> creators(4);
  const std::vector<Vec3> positions(5);
  const std::vector<FloorCodes> codes = {{7, 8, 9}, {10, 11, 12}};
  recorder.record(first, {.vertex = VertexId(4),
                          .link = link,
                          .metricPositions = positions,
                          .ceiling = ceiling,
                          .ceilingCreator = creators,
                          .floor = codes});
  EXPECT_EQ(recorder.firstFloorTriangle(first), RecorderId(10));
  EXPECT_EQ(recorder.codes(RecorderId(9)).error, 0);
  EXPECT_EQ(recorder.codes(RecorderId(10)).error, 7);
  EXPECT_EQ(recorder.codes(RecorderId(11)).above, 12);
  EXPECT_EQ(recorder.firstSlot(after(first, 1)), 4u);
}

TEST(MtRecorder, WithoutRemovalsFinishesIntoTheRootAlone) {
  MtRecorder recorder(2, 0, OutwardScale(1), {});
  const VertexId a(0), b(1), c(2), d(3);
  const std::vector<VertexId> vertices = {c, a, b, d};
  const std::vector<SurvivingTriangle> surviving = {{RecorderId(0), {a, b, c}}, {RecorderId(1), {c, b, d}}};
  UninitializedVector<std::uint32_t> order;
  const MultiTriangulation mt = recorder.finish(vertices, surviving, 4, order);
  EXPECT_EQ(mt.nodeCount(), 0u);
  EXPECT_EQ(mt.rootTriangleCount(), 2u);
  EXPECT_EQ(mt.corners(TriangleId(1)), (std::array<std::uint32_t, 3>{0, 2, 3}));
}

}  // namespace
}  // namespace arete
