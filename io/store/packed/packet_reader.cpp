// SPDX-License-Identifier: GPL-3.0-or-later
//
// A packet is decoded after those that it depends on; then saturated errors and spheres are computed in the
// opposite order (order.h). The walk checks every index before it writes it, so the indices need no check
// afterwards. A sphere's radius is negative until it is final, which shows if a damaged file makes a parent
// depend on a child that is not.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <optional>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/per_thread.h"
#include "engine/parallel/with_threads.h"
#include "io/store/format/checksum.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/forms.h"
#include "io/store/packed/nodes/node_coder.h"
#include "io/store/packed/nodes/order.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/pages/page_choice.h"
#include "io/store/packed/pages/page_header.h"
#include "io/store/packed/reader_io.h"

namespace arete {
namespace packed {
namespace {

/// Drops from each packet the bands that are not required, by it or by a packet that depends on it. (Parents
/// are of no lower band than their children.)
/// @return whether the lowest required band is the same in all packets
bool keepRequired(Directory& directory, const RequiredError& wanted, const OutwardScale& scale) {
  constexpr std::uint32_t kNone = MultiTriangulation::kBands;
  std::vector<Packet>& packets = directory.packets;
  std::vector<std::uint32_t> lowest(packets.size());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const Packet& c = packets[i];
    Box3 box;
    box.low = {c.xMin, c.yMin, directory.isOfSurface ? c.zMin : box.low.z};
    box.high = {c.xMax, c.yMax, directory.isOfSurface ? c.zMax : box.high.z};
    const double error = wanted(box);
    lowest[i] = error == std::numeric_limits<double>::infinity() ? kNone
                : error > 0 ? MultiTriangulation::bandOf(scale.floorCode(error))
                            : 0;
  }
  for (std::size_t i = packets.size(); i-- > 1;) {
    lowest[0] = std::min(lowest[0], lowest[i]);
    for (const std::uint32_t other : packets[i].dependsOn) lowest[other] = std::min(lowest[other], lowest[i]);
  }
  for (std::size_t i = 0; i < packets.size(); ++i) {
    Packet& c = packets[i];
    c.isCut = std::erase_if(c.runs, [&](const Run& run) { return run.band < lowest[i]; }) > 0;
    if (i > 0 && c.runs.empty()) c.borders = 0;
  }
  directory.number();
  return std::ranges::all_of(lowest, [&](std::uint32_t band) { return band == lowest[0]; });
}

class Unpacker {
 public:
  /// @param isPaged the segments were checked, and each page has its number
  Unpacker(Directory directory, std::span<const RansTable> tables, std::span<const std::byte> bytes,
           const RunContext& context, bool isPart, bool isPaged, LoadParts load)
      : directory_(std::move(directory)),
        bytes_(bytes),
        context_(context),
        isPart_(isPart),
        isPaged_(isPaged),
        load_(std::move(load)) {
    tables_.resize(kTables * RansTable::kEntries);
    for (std::size_t t = 0; t < kTables; ++t) tables[t].writeEntries(&tables_[t * RansTable::kEntries]);
  }

  Directory takeDirectory() { return std::move(directory_); }

  Result<MultiTriangulation> run(const MtKind& kind, AmtCounts counts) {
    ARETE_CHECK(load());
    const auto arrays = std::make_shared<Arrays>();
    static_cast<MtKind&>(*arrays) = kind;
    const std::uint64_t allNodes = counts.nodes;
    counts.nodes = directory_.nodes();
    counts.slots = directory_.slots();
    if (!arrays->allocate(counts, directory_.borders()))
      return failure(ErrorCode::outOfMemory, "needs more memory to be unpacked than there is");
    arrays_ = arrays.get();

    auto problem = overPackets(Direction::forwards, [this](std::size_t i) { return decode(i); });
    if (!problem && !context_.cancelled())
      problem = overPackets(Direction::backwards, [this](std::size_t i) {
        return saturate(*arrays_, directory_.packets[i], isPart_);
      });
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "unpacking was interrupted");
    if (problem)
      return failure(ErrorCode::corrupt, fmt::format("{}: {}", nameOf(problem->packet), problem->what));
    arrays->finish(counts.nodes < allNodes);
    context_.report("unpack", 1);
    return Arrays::model(arrays);
  }

 private:
  bool isRequired(std::size_t packet) const {
    return packet == 0 || !directory_.packets[packet].runs.empty();
  }
  /// Loads the packets that are required; of pages they are.
  Status load() const {
    if (!load_ || isPaged_) return {};
    std::vector<std::span<const std::byte>> parts;
    for (std::size_t i = 0; i < directory_.packets.size(); ++i)
      if (const Packet& packet = directory_.packets[i]; isRequired(i))
        parts.push_back(bytes_.subspan(packet.segments[0].begin(), packet.bytes()));
    return load_(parts);
  }

  /// Calls body(i) for the packets that are required.
  template <class Body>
  std::optional<PacketProblem> overPackets(Direction direction, const Body& body) {
    return forPackets(
        directory_.packets, direction, context_,
        [&](std::size_t i) -> std::optional<std::string> {
          if (!isRequired(i)) return std::nullopt;
          return body(i);
        },
        [&](std::size_t i) {
          done_ += directory_.packets[i].nodes;
          context_.report("unpack",
                          static_cast<double>(done_) / (2 * static_cast<double>(arrays_->nodes) + 1));
        });
  }

  std::string nameOf(std::size_t packet) const {
    return isPaged_ ? fmt::format("page {}", directory_.packets[packet].number)
                    : fmt::format("packet {} of the packed nodes", packet);
  }

  std::optional<std::string> decode(std::size_t index) {
    const Segment& first = directory_.packets[index].segments[0];
    if (!isPaged_) {
      const auto bytes = bytes_.subspan(first.begin(), first.bytes());
      if (amtChecksum(bytes) != first.checksum) return "has been altered: its checksum does not match";
    }
    ReaderIo io(*arrays_, directory_, index, tables_.data(), bytes_);
    return withForm(*arrays_, [&](auto form) { return decode<decltype(form)>(index, io); });
  }
  template <class Form>
  std::optional<std::string> decode(std::size_t index, ReaderIo& io) {
    if (index == 0 && !codeRoot<Form>(*arrays_, io)) return "has an invalid root";
    NodeCoder<Form, ReaderIo> coder(*arrays_, directory_, directory_.packets[index], io, spaces_.local());
    if (!coder.run()) return coder.problem();
    if (!directory_.packets[index].isCut && !io.isAtEnd())
      return "has symbols that do not end where they should";
    return std::nullopt;
  }

  Directory directory_;
  std::span<const std::byte> bytes_;
  const RunContext& context_;
  bool isPart_, isPaged_;
  LoadParts load_;
  std::vector<std::uint32_t> tables_;  ///< entries of all tables
  Arrays* arrays_ = nullptr;
  PerThread<CoderSpace> spaces_;
  std::uint64_t done_ = 0;
};

}  // namespace
}  // namespace packed

namespace {

/// Refuses what does not fit into the memory budget, before packed nodes are read.
/// @param bytes  of the packed nodes, which are in memory meanwhile
Status checkUnpacking(const packed::MtKind& kind, AmtCounts counts, std::uint64_t nodes, std::uint64_t slots,
                      std::uint64_t borders, std::uint64_t bytes) {
  counts.nodes = nodes;
  counts.slots = slots;
  return checkBudget(packed::Arrays::bytesOf(kind, counts, borders) + bytes,
                     "ask for a smaller part or a larger tolerance of a model in pages (`paged`)");
}

Result<MultiTriangulation> unpack(const packed::MtKind& kind, const AmtCounts& counts,
                                  std::span<const std::byte> directoryBytes,
                                  std::span<const std::byte> tableBytes, std::span<const std::byte> nodes,
                                  const RequiredError& wanted, const RunContext& context,
                                  const LoadParts& load = {}) {
  std::string problem;
  auto directory = packed::directoryOf(directoryBytes, problem, !kind.hasPlan());
  if (!directory) return failure(ErrorCode::corrupt, "the directory of the packed nodes " + problem);
  if (directory->nodes() != counts.nodes || directory->slots() != counts.slots)
    return failure(ErrorCode::corrupt, "the packed nodes are not as many as the metadata says");
  std::uint64_t bytes = 0, things = counts.rootVertices + counts.rootTriangles;
  for (const packed::Packet& packet : directory->packets) {
    bytes += packet.bytes();
    things += packet.nodes;
    if (packet.bytes() < packed::leastBytes(things))
      return failure(ErrorCode::corrupt, "the packed nodes are more than their bytes can hold");
    things = 0;
  }
  if (bytes != nodes.size())
    return failure(
        ErrorCode::corrupt,
        fmt::format("the packed nodes have {} bytes where their directory states {}", nodes.size(), bytes));
  if (counts.rootTriangles + directory->borders() > packed::kMostBorders)
    return failure(ErrorCode::corrupt,
                   "the packed nodes leave more triangles to others than can be numbered");
  const auto tables = tablesOf(tableBytes, packed::kTables);
  if (!tables) return failure(ErrorCode::corrupt, "the tables of the packed nodes are damaged");
  const bool isPart = wanted && !packed::keepRequired(*directory, wanted, kind.scale);
  ARETE_CHECK(
      checkUnpacking(kind, counts, directory->nodes(), directory->slots(), directory->borders(), bytes));
  return withThreads(context, [&] {
    return packed::Unpacker(std::move(*directory), *tables, nodes, context, isPart, false, load)
        .run(kind, counts);
  });
}

/// All segments of a page that was chosen; nothing of a page without one. Errors: corrupt.
Result<std::span<const std::byte>> bytesOf(const packed::PagedMt& paged, const packed::Packet& page) {
  if (page.segments.empty()) return std::span<const std::byte>();
  const packed::Segment& last = page.segments.back();
  const std::uint64_t begin = page.segments[0].begin(), end = last.begin() + last.bytes();
  // The offset may be any 64-bit number, so that the end wraps around.
  if (begin > end || end > paged.nodes.size())
    return failure(ErrorCode::corrupt, fmt::format("page {}: lies behind the end", page.number));
  return paged.nodes.subspan(begin, end - begin);
}

/// Checks what was loaded of a page, and reads its headers.
/// @return what is wrong with it
std::optional<std::string> openPage(const packed::PagedMt& paged, std::uint32_t lowest, std::uint64_t roots,
                                    bool isOfSurface, packed::Packet& page) {
  for (const packed::Segment& segment : page.segments)
    if (amtChecksum(paged.nodes.subspan(segment.begin(), segment.bytes())) != segment.checksum)
      return "has been altered: its checksum does not match";
  if (!page.segments.empty() && page.number == 0 &&
      page.segments[0].bytes() < packed::leastBytes(page.segments[0].nodes + roots))
    return "has a root that its bytes cannot hold";
  if (!packed::readHeaders(paged.nodes, isOfSurface, page))
    return "has runs that its directory does not state";
  page.isCut |= std::erase_if(page.runs, [&](const packed::Run& run) { return run.band < lowest; }) > 0;
  return std::nullopt;
}

Result<UnpackedPages> unpack(const packed::MtKind& kind, const AmtCounts& counts,
                             const packed::PagedMt& paged, const RequiredError& wanted,
                             const RunContext& context, const LoadParts& load) {
  std::string problem;
  const auto root = packed::pageRootOf(paged.root, problem);
  if (!root) return failure(ErrorCode::corrupt, "the directory of its pages " + problem);
  if (root->nodes() != counts.nodes || root->slots != counts.slots)
    return failure(ErrorCode::corrupt, "its pages have not as many nodes as the metadata says");
  ARETE_TRY(auto choice, packed::choosePages(*root, paged.blocks, wanted, kind.scale, load));
  packed::Directory& directory = choice.directory;
  directory.isOfSurface = !kind.hasPlan();
  std::vector<std::span<const std::byte>> parts;
  // A fault maps 64 KiB of a file, so that small pages far apart take more than their bytes. Pages lie in the
  // order of their numbers.
  constexpr std::uint64_t kAround = std::uint64_t{1} << 16;
  std::uint64_t stated = 0, windows = 1, behind = 0, left = 0;
  for (const packed::Packet& page : directory.packets) {
    for (const packed::Segment& segment : page.segments) stated += segment.nodes;
    left += page.borders;
    ARETE_TRY(const auto part, bytesOf(paged, page));
    if (part.empty()) continue;
    parts.push_back(part);
    const auto begin = static_cast<std::uint64_t>(part.data() - paged.nodes.data()),
               end = begin + part.size();
    windows += std::max(behind, end / kAround + 1) - std::max(behind, begin / kAround);
    behind = std::max(behind, end / kAround + 1);
  }
  // How many slots the nodes of a page have is in its headers, which are not read yet: about as many as all.
  const double slotsOfNode =
      static_cast<double>(root->slots) / std::max(1.0, static_cast<double>(counts.nodes));
  ARETE_CHECK(checkUnpacking(kind, counts, stated,
                             static_cast<std::uint64_t>(static_cast<double>(stated) * slotsOfNode), left,
                             std::min<std::uint64_t>(windows * kAround, paged.nodes.size())));
  if (load) ARETE_CHECK(load(parts));
  const std::uint64_t roots = counts.rootVertices + counts.rootTriangles;
  return withThreads(context, [&]() -> Result<UnpackedPages> {
    std::vector<std::optional<std::string>> problems(directory.packets.size());
    parallelFor(std::size_t{0}, directory.packets.size(), [&](std::size_t i) {
      problems[i] = openPage(paged, choice.lowest[i], roots, directory.isOfSurface, directory.packets[i]);
    });
    std::uint64_t nodes = 0, slots = 0, borders = counts.rootTriangles;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      packed::Packet& page = directory.packets[i];
      if (problems[i])
        return failure(ErrorCode::corrupt, fmt::format("page {}: {}", page.number, *problems[i]));
      if (i > 0 && page.runs.empty()) page.borders = 0;
      for (const packed::Run& run : page.runs) {
        nodes += run.nodes;
        slots += run.slots;
      }
      borders += page.borders;
    }
    if (slots + roots >= MultiTriangulation::kNone - 1 || borders > packed::kMostBorders)
      return failure(
          ErrorCode::invalidData,
          fmt::format("a part of {} nodes is more than can be numbered: ask for less of it", nodes));
    directory.numberNodes();
    const auto tables = tablesOf(paged.tables, packed::kTables);
    if (!tables) return failure(ErrorCode::corrupt, "the tables of the packed nodes are damaged");
    packed::Unpacker unpacker(std::move(directory), *tables, paged.nodes, context, wanted && !choice.isEvenly,
                              true, {});
    ARETE_TRY(MultiTriangulation mt, unpacker.run(kind, counts));
    return UnpackedPages{std::move(mt), unpacker.takeDirectory()};
  });
}

packed::MtKind kindOf(const AmtMetadata& metadata) {
  packed::MtKind kind;
  kind.isLattice = metadata.model.isRaster;
  kind.hasFills = metadata.model.options.rimTolerance > 0;
  kind.columns = metadata.model.columns;
  kind.rows = metadata.model.rows;
  kind.encoding = metadata.encoding;
  kind.scale = metadata.scale;
  kind.metric = metadata.metric;
  return kind;
}

packed::MtKind kindOf(const SurfaceMetadata& metadata) {
  packed::MtKind kind;
  kind.model = ModelKind::surface;
  kind.hasDoubles = metadata.hasDoubles;
  kind.step = metadata.positionStep;
  kind.moved = metadata.model.positionError;
  kind.scale = metadata.scale;
  kind.metric = metadata.metric;
  return kind;
}

}  // namespace

Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, std::span<const std::byte> directory,
                                    std::span<const std::byte> tables, std::span<const std::byte> nodes,
                                    const RequiredError& wanted, const RunContext& context,
                                    const LoadParts& load) try {
  return unpack(kindOf(metadata), metadata.counts, directory, tables, nodes, wanted, context, load);
} catch (...) {
  return caughtFailure();
}

Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, const packed::PagedMt& paged,
                                    const RequiredError& wanted, const RunContext& context,
                                    const LoadParts& load) try {
  ARETE_TRY(UnpackedPages unpacked, unpack(kindOf(metadata), metadata.counts, paged, wanted, context, load));
  return std::move(unpacked.mt);
} catch (...) {
  return caughtFailure();
}

Result<std::vector<PageNeed>> neededPages(const OutwardScale& scale, const packed::PagedMt& paged,
                                          const RequiredError& wanted, const LoadParts& load) try {
  std::string problem;
  const auto root = packed::pageRootOf(paged.root, problem);
  if (!root) return failure(ErrorCode::corrupt, "the directory of its pages " + problem);
  ARETE_TRY(const auto choice, packed::choosePages(*root, paged.blocks, wanted, scale, load));
  std::vector<PageNeed> needs;
  for (std::size_t i = 0; i < choice.directory.packets.size(); ++i) {
    const packed::Packet& page = choice.directory.packets[i];
    ARETE_TRY(const auto bytes, bytesOf(paged, page));
    needs.push_back({page.number, choice.lowest[i], bytes});
  }
  return needs;
} catch (...) {
  return caughtFailure();
}

Result<MultiTriangulation> unpackSurfaceMt(const SurfaceMetadata& metadata,
                                           std::span<const std::byte> directory,
                                           std::span<const std::byte> tables,
                                           std::span<const std::byte> nodes, const RunContext& context) try {
  return unpack(kindOf(metadata), metadata.counts, directory, tables, nodes, {}, context);
} catch (...) {
  return caughtFailure();
}

Result<UnpackedPages> unpackSurfaceMt(const SurfaceMetadata& metadata, const packed::PagedMt& paged,
                                      const RequiredError& wanted, const RunContext& context,
                                      const LoadParts& load) try {
  return unpack(kindOf(metadata), metadata.counts, paged, wanted, context, load);
} catch (...) {
  return caughtFailure();
}

namespace {

using NodesOfBand = std::array<std::uint64_t, MultiTriangulation::kBands>;

double errorBeyond(const NodesOfBand& nodesOfBand, const OutwardScale& scale, std::uint64_t nodes) {
  std::uint64_t sum = 0;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 1;)
    if ((sum += nodesOfBand[band]) >= nodes)
      return scale.decode(static_cast<OutwardScale::Code>(band << MultiTriangulation::kBandShift));
  return 0;
}

}  // namespace

double packedErrorBeyond(std::span<const std::byte> directoryBytes, const OutwardScale& scale,
                         std::uint64_t nodes) {
  std::string problem;
  std::optional<packed::Directory> directory;
  try {
    directory = packed::directoryOf(directoryBytes, problem);
  } catch (const std::bad_alloc&) {
    return 0;
  }
  if (!directory) return 0;
  NodesOfBand nodesOfBand{};
  for (const packed::Packet& packet : directory->packets)
    for (const packed::Run& run : packet.runs) nodesOfBand[run.band] += run.nodes;
  return errorBeyond(nodesOfBand, scale, nodes);
}

double pagedErrorBeyond(std::span<const std::byte> root, const OutwardScale& scale, std::uint64_t nodes) {
  std::string problem;
  const auto directory = packed::pageRootOf(root, problem);
  return directory ? errorBeyond(directory->nodesOfBand, scale, nodes) : 0;
}

}  // namespace arete
