// SPDX-License-Identifier: GPL-3.0-or-later
//
// The writer walks over the nodes as the reader will (node_coder.h) and records every symbol with its table.
// When all packets have been walked, the tables follow from how often each symbol occurs, and every packet is
// encoded. Packets are walked in parallel, each after those that it depends on, as they are read.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/per_thread.h"
#include "engine/parallel/with_threads.h"
#include "io/store/format/checksum.h"
#include "io/store/packed/forms.h"
#include "io/store/packed/nodes/node_coder.h"
#include "io/store/packed/nodes/order.h"
#include "io/store/packed/nodes/plan.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/pages/directory_blocks.h"
#include "io/store/packed/pages/page_header.h"
#include "io/store/packed/surface/rounded_surface.h"
#include "io/store/packed/writer_io.h"
#include "terrain/model/terrain_model.h"

namespace arete {
namespace packed {
namespace {

class Packer {
 public:
  /// @param wantsOrder whether takeOrder() is needed: not where nothing beside the MT is in its order
  Packer(const MultiTriangulation& mt, const MtKind& kind, bool isPaged, bool wantsOrder,
         const RunContext& context)
      : context_(context),
        isPaged_(isPaged),
        wantsOrder_(wantsOrder),
        plan_(planPackets(mt, kind, isPaged ? kPageRule : PlanRule())),
        walk_{mt, plan_, arrays_, {}, {}, {}, {}, {}} {
    static_cast<MtKind&>(arrays_) = kind;
  }

  Result<PackedMt> run() {
    if (walk_.mt.rootTriangleCount() + plan_.directory.borders() > kMostBorders)
      return failure(ErrorCode::invalidData, "has more triangles in its root than can be packed");
    if (!prepare()) return failure(ErrorCode::outOfMemory, "needs more memory to be packed than there is");
    const auto& packets = plan_.directory.packets;
    std::vector<std::vector<Streams>> streams(packets.size());
    std::uint64_t done = 0;
    const auto problem = forPackets(
        packets, Direction::forwards, context_, [&](std::size_t i) { return walkPacket(i, streams[i]); },
        [&](std::size_t i) {
          done += packets[i].nodes;
          context_.report("pack",
                          0.7 * static_cast<double>(done) / (static_cast<double>(walk_.mt.nodeCount()) + 1));
        });
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "packing was interrupted");
    if (problem)
      return failure(ErrorCode::invalidData,
                     fmt::format("packet {} of its nodes {}", problem->packet, problem->what));
    if (wantsOrder_) order_ = orderOf();
    giveWalkBack();
    const std::vector<RansTable> tables = tablesFor(streams);
    std::vector<std::vector<std::byte>> bytes(packets.size());
    parallelFor(std::size_t{0}, packets.size(), [&](std::size_t i) {
      if (!context_.cancelled()) bytes[i] = encode(plan_.directory.packets[i], streams[i], tables, i == 0);
    });
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "packing was interrupted");
    plan_.directory.number();
    PackedMt packed;
    if (isPaged_) {
      PageDirectoryBytes pages = pageDirectoryBytes(plan_.directory);
      packed.directory = std::move(pages.root);
      packed.blocks = std::move(pages.blocks);
    } else {
      packed.directory = toBytes(plan_.directory);
    }
    packed.tables = toBytes(tables);
    for (auto& b : bytes) {
      packed.nodes.insert(packed.nodes.end(), b.begin(), b.end());
      b = {};
    }
    context_.report("pack", 1);
    return packed;
  }

  /// Puts what the nodes of each segment carry behind its streams. @param packed what run() made
  void attach(const CarriedPages& carried, PackedMt& packed) {
    std::vector<std::byte> all;
    for (std::size_t p = 0; p < plan_.directory.packets.size(); ++p) {
      Packet& page = plan_.directory.packets[p];
      std::size_t firstRun = 0;
      for (std::size_t i = 0; i < page.segments.size(); ++i) {
        Segment& segment = page.segments[i];
        const auto streams =
            std::span(packed.nodes).subspan(segment.offset, segment.bytes() - segment.headerBytes);
        const std::vector<std::byte>& more = carried[p][i];
        segment.carriedBytes = static_cast<std::uint32_t>(more.size());
        const auto header =
            segmentHeader(segment, std::span(page.runs).subspan(firstRun, segment.runs), true);
        segment.headerBytes = static_cast<std::uint32_t>(header.size());
        firstRun += segment.runs;
        const std::size_t begin = all.size();
        all.insert(all.end(), header.begin(), header.end());
        all.insert(all.end(), streams.begin(), streams.end());
        all.insert(all.end(), more.begin(), more.end());
        segment.checksum = amtChecksum(std::span(all).subspan(begin));
      }
    }
    packed.nodes = std::move(all);
    plan_.directory.number();
    PageDirectoryBytes pages = pageDirectoryBytes(plan_.directory);
    packed.directory = std::move(pages.root);
    packed.blocks = std::move(pages.blocks);
  }

  /// The order of the packed MT, after run(). Leaves the packer without it.
  PackedOrder takeOrder() { return std::move(order_); }

 private:
  bool prepare() {
    const MultiTriangulation& mt = walk_.mt;
    if (!arrays_.allocate(
            {mt.rootVertexCount(), mt.rootTriangleCount(), mt.nodeCount(), mt.slotTotal(), 0, 0},
            plan_.directory.borders()))
      return false;
    std::ranges::copy(mt.rootTriangles(), arrays_.rootTriangles.get());
    withForm(arrays_, [&](auto form) { form.prepare(arrays_, mt); });
    walk_.oldNode.resize(mt.nodeCount());
    walk_.newNode.assign(mt.nodeCount(), MultiTriangulation::kNone);
    walk_.oldTriangle.resize(mt.slotTotal());
    walk_.turn.resize(mt.nodeCount());
    walk_.ownParentsLeft = std::move(plan_.ownParents);
    return true;
  }
  PackedOrder orderOf() const {
    PackedOrder order;
    const std::uint32_t rootVertices = walk_.mt.rootVertexCount(), roots = walk_.mt.rootTriangleCount();
    order.vertexOf.resize(walk_.mt.vertexCount());
    order.triangleOf.resize(walk_.mt.triangleIdCount());
    std::iota(order.vertexOf.begin(), order.vertexOf.begin() + rootVertices, 0u);
    std::iota(order.triangleOf.begin(), order.triangleOf.begin() + roots, 0u);
    for (std::uint32_t n = 0; n < walk_.mt.nodeCount(); ++n)
      order.vertexOf[rootVertices + n] = rootVertices + walk_.oldNode[n];
    std::ranges::copy(walk_.oldTriangle, order.triangleOf.begin() + roots);
    return order;
  }

  /// Frees the memory that only the walk needs.
  void giveWalkBack() {
    arrays_ = {};
    walk_.oldNode = {};
    walk_.newNode = {};
    walk_.oldTriangle = {};
    walk_.turn = {};
    walk_.ownParentsLeft = {};
    spaces_.clear();
  }

  std::optional<std::string> walkPacket(std::size_t i, std::vector<Streams>& segments) {
    WriterIo io(walk_, static_cast<std::uint32_t>(i), spaces_.local().streams, segments);
    std::optional<std::string> bad =
        withForm(arrays_, [&](auto form) { return walkNodes<decltype(form)>(i, io); });
    io.finish();
    return bad;
  }

  template <class Form>
  std::optional<std::string> walkNodes(std::size_t i, WriterIo& io) {
    if (i == 0 && !codeRoot<Form>(arrays_, io)) return "come after an invalid root";
    NodeCoder<Form, WriterIo> coder(arrays_, plan_.directory, plan_.directory.packets[i], io,
                                    spaces_.local().coder);
    if (!coder.run()) return coder.problem();
    return std::nullopt;
  }

  static std::vector<RansTable> tablesFor(const std::vector<std::vector<Streams>>& streams) {
    std::vector<std::array<std::uint64_t, RansTable::kAlphabet>> counts(kTables);
    for (const auto& segments : streams)
      for (const Streams& s : segments)
        for (const auto& symbols : s.symbols)
          for (const RansSymbol symbol : symbols) ++counts[symbol.table][symbol.symbol];
    std::vector<RansTable> tables;
    for (const auto& c : counts) tables.push_back(RansTable::ofCounts(c));
    return tables;
  }

  /// The bytes of a packet: its segments, one after the other.
  std::vector<std::byte> encode(Packet& packet, std::vector<Streams>& streams,
                                std::span<const RansTable> tables, bool isFirst) const {
    std::vector<std::byte> bytes;
    std::size_t firstRun = 0;
    for (std::size_t i = 0; i < packet.segments.size(); ++i) {
      Segment& segment = packet.segments[i];
      std::vector<std::byte> coded = encode(segment, streams[i], tables, isFirst && i == 0);
      streams[i] = {};
      if (isPaged_) {
        const auto header = segmentHeader(segment, std::span(packet.runs).subspan(firstRun, segment.runs),
                                          plan_.directory.isOfSurface);
        segment.headerBytes = static_cast<std::uint32_t>(header.size());
        coded.insert(coded.begin(), header.begin(), header.end());
      }
      segment.checksum = amtChecksum(coded);
      bytes.insert(bytes.end(), coded.begin(), coded.end());
      firstRun += segment.runs;
    }
    return bytes;
  }

  /// The streams of a segment.
  std::vector<std::byte> encode(Segment& segment, Streams& streams, std::span<const RansTable> tables,
                                bool hasRoot) const {
    std::vector<std::byte> bytes;
    for (unsigned s = 0; s < kStreams; ++s) {
      const auto coded = ransEncode(streams.symbols[s], tables);
      segment.streamBytes[s] = static_cast<std::uint32_t>(coded.size());
      bytes.insert(bytes.end(), coded.begin(), coded.end());
      streams.symbols[s] = {};
    }
    segment.streamBytes[kBoundBytes] = static_cast<std::uint32_t>(streams.boundBytes.size());
    bytes.insert(bytes.end(), streams.boundBytes.begin(), streams.boundBytes.end());
    const MultiTriangulation& mt = walk_.mt;
    const std::uint64_t roots = std::uint64_t{mt.rootVertexCount()} + mt.rootTriangleCount();
    const std::uint64_t least = leastBytes(segment.nodes + (hasRoot ? roots : 0));
    if (bytes.size() + streams.rawBits.size() < least) streams.rawBits.resize(least - bytes.size());
    segment.streamBytes[kRawBits] = static_cast<std::uint32_t>(streams.rawBits.size());
    bytes.insert(bytes.end(), streams.rawBits.begin(), streams.rawBits.end());
    return bytes;
  }

  /// Memory of a thread, reused from packet to packet.
  struct Space {
    Streams streams;
    CoderSpace coder;
  };

  const RunContext& context_;
  bool isPaged_, wantsOrder_;
  Plan plan_;
  Arrays arrays_;
  Walk walk_;
  PackedOrder order_;
  PerThread<Space> spaces_;
};

/// Whether all triangles that stay have the same error and RMS, of which a packed file says one.
bool hasOneFinestError(const MultiTriangulation& mt) {
  const std::span<const std::uint16_t> rms = mt.column(kRms);
  TriangleId first;
  for (std::uint32_t i = 0; i < mt.triangleIdCount(); ++i) {
    const TriangleId t(i);
    if (mt.remover(t).isValid()) continue;
    if (!first.isValid()) first = t;
    if (mt.errorCode(t) != mt.errorCode(first) || rms[i] != rms[first.index()]) return false;
  }
  return true;
}

Result<PackedSurfaceMt> packSurface(const MultiTriangulation& mt, const SurfacePackOptions& options,
                                    const RunContext& context, const CarryInPages& carry) {
  ARETE_TRY(RoundedSurface rounded, roundedSurface(mt, options.positionBits));
  if (!hasOneFinestError(rounded.mt))
    return failure(ErrorCode::invalidData, "has triangles that stay with different errors");
  MtKind kind;
  kind.model = ModelKind::surface;
  kind.hasDoubles = !rounded.mt.vertices().places64.empty();
  kind.step = rounded.step;
  kind.scale = rounded.mt.scale();
  kind.metric = rounded.mt.metric();
  Packer packer(rounded.mt, kind, options.isPaged, true, context);
  ARETE_TRY(PackedMt bytes, packer.run());
  PackedSurfaceMt packed{std::move(bytes), packer.takeOrder(), kind.hasDoubles,
                         kind.step,        rounded.moved,      kind.scale};
  if (!carry) return packed;
  ARETE_TRY(const CarriedPages carried, carry(packed));
  packer.attach(carried, packed.bytes);
  return packed;
}

}  // namespace
}  // namespace packed

namespace {
/// About what packing takes beside the model.
constexpr std::uint64_t kBytesOfPackedNode = 150;
}  // namespace

Result<PackedMt> packMt(const TerrainModel& model, const PackOptions& options,
                        const RunContext& context) try {
  requireMemory(kBytesOfPackedNode * model.mt.nodeCount(), "write the plain form");
  return withThreads(context, [&] {
    return packed::Packer(model.mt, packed::kindOf(model), options.isPaged, false, context).run();
  });
} catch (...) {
  return caughtFailure();
}

Result<PackedSurfaceMt> packSurfaceMt(const MultiTriangulation& mt, const SurfacePackOptions& options,
                                      const RunContext& context, const CarryInPages& carry) try {
  requireMemory(kBytesOfPackedNode * mt.nodeCount(), "write the plain form");
  return withThreads(context, [&] { return packed::packSurface(mt, options, context, carry); });
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
