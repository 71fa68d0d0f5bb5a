// SPDX-License-Identifier: GPL-3.0-or-later
//
// A packet is decoded after those that it depends on; then saturated errors and spheres are computed in the
// opposite order (order.h). The walk checks every index before it writes it, so the indices need no check
// afterwards. A sphere's radius is negative until it is final, which shows if a damaged file makes a parent
// depend on a child that is not.
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <optional>

#include "engine/base/caught_failure.h"
#include "engine/parallel/with_threads.h"
#include "io/format/checksum.h"
#include "io/format/metadata.h"
#include "io/packed/bounds.h"
#include "io/packed/node_coder.h"
#include "io/packed/order.h"
#include "io/packed/packed.h"

namespace arete {
namespace packed {
namespace {

/// Reads the bytes of bounds. Reading beyond the end gives some bytes; isAtEnd() detects it.
class BoundReader {
 public:
  /// The bytes behind the end that must be readable.
  static constexpr std::size_t kReadable = 3;

  BoundReader() = default;
  BoundReader(const std::byte* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}

  BoundBytes next() {
    const BoundBytes bytes{static_cast<std::uint8_t>(at_[0]), static_cast<std::uint8_t>(at_[1])};
    at_ += bytes.isFar() ? 2 : 1;
    if (at_ > end_) [[unlikely]]
      at_ = end_ + 1;
    return bytes;
  }
  bool isAtEnd() const { return at_ == end_; }

 private:
  const std::byte *at_ = nullptr, *end_ = nullptr;  // at_ is one beyond end_ if too much was read
};

class ReaderIo {
 public:
  ReaderIo(const Arrays& arrays, const Directory& directory, std::size_t packet, const std::uint32_t* tables,
           std::span<const std::byte> bytes)
      : a_(arrays),
        directory_(directory),
        packet_(packet),
        tables_(tables),
        bytes_(bytes.begin(), bytes.end()) {
    bytes_.resize(bytes.size() + std::max(RansDecoder::kReadable, BoundReader::kReadable));
    std::size_t at = 0;
    for (unsigned s = 0; s < kParts; ++s) {
      const std::size_t size = directory.packets[packet].streamBytes[s];
      if (s < kStreams)
        streams_[s] = RansDecoder(bytes_.data() + at, size);
      else if (s == kBoundBytes)
        bounds_ = BoundReader(bytes_.data() + at, size);
      else
        raw_ = BitReader({bytes_.data() + at, size});
      at += size;
    }
  }

  static constexpr bool kKeepsValues = true;

  template <class Actual>
  unsigned code(Stream stream, unsigned table, const Actual&) {
    return streams_[stream].decode(tables_ + table * RansTable::kEntries);
  }
  std::uint64_t raw(int bits, std::uint64_t) { return raw_.read(bits); }

  /// Reads long runs of errors and bounds: a copy of the streams that stays in registers.
  struct Values {
    RansDecoder error;
    BoundReader boundBytes;
    BitReader rawBits;
    const std::uint32_t* tables;

    template <class Actual>
    unsigned code(Stream, unsigned table, const Actual&) {
      return error.decode(tables + table * RansTable::kEntries);
    }
    std::uint64_t raw(int bits, std::uint64_t) { return rawBits.read(bits); }
    std::uint16_t actualError(std::uint32_t) const { return 0; }
    std::optional<std::uint64_t> wholeError(double, std::uint16_t) const { return 0; }
    BoundBytes bounds(std::uint32_t, std::uint32_t) { return boundBytes.next(); }
  };
  Values values() const { return {streams_[kErrorStream], bounds_, raw_, tables_}; }
  void putBack(const Values& values) {
    streams_[kErrorStream] = values.error;
    bounds_ = values.boundBytes;
    raw_ = values.rawBits;
  }

  bool listed(const Run& run, std::vector<std::uint32_t>& seeds) {
    const auto& dependsOn = directory_.packets[packet_].dependsOn;
    seeds.clear();
    std::uint64_t from = 0, place = 0;
    for (std::uint32_t i = 0; i < run.listed; ++i) {
      const std::uint64_t later = codeNumber(*this, kFloorStream, kListPacketTable, [] { return 0; });
      if (later > 0) place = 0;
      from += later;
      place += codeNumber(*this, kFloorStream, kListBorderTable, [] { return 0; });
      if (from > dependsOn.size()) return false;
      const Packet* const other = from > 0 ? &directory_.packets[dependsOn[from - 1]] : nullptr;
      if (place >= (other != nullptr ? other->borders : a_.roots)) return false;
      const std::uint64_t first = other != nullptr ? a_.roots + other->firstBorder : 0;
      seeds.push_back(static_cast<std::uint32_t>(first + place));
    }
    return true;
  }

  bool isAtEnd() const {
    return !raw_.isOver() && bounds_.isAtEnd() &&
           std::ranges::all_of(streams_, [](const RansDecoder& s) { return s.isAtEnd(); });
  }

  // Values that only the writer has.
  void begin(std::uint32_t, std::uint32_t) {}
  void at(std::uint32_t) {}
  unsigned shapeSymbol(const std::uint32_t*) { return 0; }
  unsigned shapeBits(int) { return 0; }
  unsigned openEdge(const Floor&, std::span<const int>) { return 0; }
  bool star(const Floor&, std::uint32_t) { return true; }
  std::uint64_t staying(std::uint32_t, int) const { return 0; }
  Vec2 actualPlace() const { return {0, 0}; }
  std::int64_t actualHeightResidual(double) const { return 0; }
  std::optional<unsigned> seedAt(std::uint32_t, std::uint32_t) { return std::nullopt; }
  bool isLeft(std::uint32_t) const { return false; }

 private:
  const Arrays& a_;
  const Directory& directory_;
  std::size_t packet_;
  const std::uint32_t* tables_;
  std::vector<std::byte> bytes_;
  std::array<RansDecoder, kStreams> streams_;
  BoundReader bounds_;
  BitReader raw_;
};

/// Drops from each packet the bands that are not required, by it or by a packet that depends on it. (Parents
/// are of no lower band than their children.)
/// @return whether the lowest required band is the same in all packets
bool keepRequired(Directory& directory, const RequiredError& wanted, const OutwardScale& scale) {
  constexpr std::uint32_t kNone = MultiTriangulation::kBands;
  std::vector<Packet>& packets = directory.packets;
  std::vector<std::uint32_t> lowest(packets.size());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const Packet& c = packets[i];
    const double error = wanted({c.xMin, c.yMin, c.xMax, c.yMax});
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
  Unpacker(Directory directory, std::span<const RansTable> tables, std::span<const std::byte> bytes,
           const RunContext& context, bool isPart)
      : directory_(std::move(directory)), bytes_(bytes), context_(context), isPart_(isPart) {
    tables_.resize(kTables * RansTable::kEntries);
    for (std::size_t t = 0; t < kTables; ++t) tables[t].writeEntries(&tables_[t * RansTable::kEntries]);
  }

  Result<MultiTriangulation> run(const AmtMetadata& metadata) {
    const auto arrays = std::make_shared<Arrays>();
    arrays->isLattice = metadata.model.isRaster;
    arrays->hasFills = metadata.model.options.rimTolerance > 0;
    arrays->columns = metadata.model.columns;
    arrays->rows = metadata.model.rows;
    arrays->encoding = metadata.encoding;
    arrays->scale = metadata.scale;
    arrays->metric = metadata.metric;
    AmtCounts counts = metadata.counts;
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
      return failure(ErrorCode::corrupt,
                     fmt::format("packet {} of the packed nodes: {}", problem->packet, problem->what));
    arrays->finish();
    context_.report("unpack", 1);
    return Arrays::model(arrays);
  }

 private:
  /// Calls body(i) for the packets that are required.
  template <class Body>
  std::optional<PacketProblem> overPackets(Direction direction, const Body& body) {
    return forPackets(
        directory_.packets, direction, context_,
        [&](std::size_t i) -> std::optional<std::string> {
          if (directory_.packets[i].runs.empty() && i != 0) return std::nullopt;
          return body(i);
        },
        [&](std::size_t i) {
          done_ += directory_.packets[i].nodes;
          context_.report("unpack",
                          static_cast<double>(done_) / (2 * static_cast<double>(arrays_->nodes) + 1));
        });
  }

  std::optional<std::string> decode(std::size_t index) {
    const Packet& packet = directory_.packets[index];
    const auto bytes = bytes_.subspan(packet.offset, packet.bytes());
    if (amtChecksum(bytes) != packet.checksum) return "has been altered: its checksum does not match";
    ReaderIo io(*arrays_, directory_, index, tables_.data(), bytes);
    return arrays_->holdsFloats() ? decode<float>(index, io) : decode<double>(index, io);
  }
  template <class Real>
  std::optional<std::string> decode(std::size_t index, ReaderIo& io) {
    if (index == 0 && !codeRoot<Real>(*arrays_, io)) return "has an invalid root";
    NodeCoder<Real, ReaderIo> coder(*arrays_, directory_, directory_.packets[index], io, spaces_.local());
    if (!coder.run()) return coder.problem();
    if (!directory_.packets[index].isCut && !io.isAtEnd())
      return "has symbols that do not end where they should";
    return std::nullopt;
  }

  Directory directory_;
  std::span<const std::byte> bytes_;
  const RunContext& context_;
  bool isPart_;
  std::vector<std::uint32_t> tables_;  ///< entries of all tables
  Arrays* arrays_ = nullptr;
  tbb::enumerable_thread_specific<CoderSpace> spaces_;
  std::uint64_t done_ = 0;
};

}  // namespace
}  // namespace packed

namespace {

Result<MultiTriangulation> unpack(const AmtMetadata& metadata, std::span<const std::byte> directoryBytes,
                                  std::span<const std::byte> tableBytes, std::span<const std::byte> nodes,
                                  const RequiredError& wanted, const RunContext& context) {
  std::string problem;
  auto directory = packed::directoryOf(directoryBytes, problem);
  if (!directory) return failure(ErrorCode::corrupt, "the directory of the packed nodes " + problem);
  if (directory->nodes() != metadata.counts.nodes || directory->slots() != metadata.counts.slots)
    return failure(ErrorCode::corrupt, "the packed nodes are not as many as the metadata says");
  std::uint64_t bytes = 0, things = metadata.counts.rootVertices + metadata.counts.rootTriangles;
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
  if (metadata.counts.rootTriangles + directory->borders() > packed::kMostBorders)
    return failure(ErrorCode::corrupt,
                   "the packed nodes leave more triangles to others than can be numbered");
  const auto tables = packed::tablesOf(tableBytes);
  if (!tables) return failure(ErrorCode::corrupt, "the tables of the packed nodes are damaged");
  const bool isPart = wanted && !packed::keepRequired(*directory, wanted, metadata.scale);
  return withThreads(context, [&] {
    return packed::Unpacker(std::move(*directory), *tables, nodes, context, isPart).run(metadata);
  });
}

}  // namespace

Result<MultiTriangulation> unpackMt(const AmtMetadata& metadata, std::span<const std::byte> directory,
                                    std::span<const std::byte> tables, std::span<const std::byte> nodes,
                                    const RequiredError& wanted, const RunContext& context) try {
  return unpack(metadata, directory, tables, nodes, wanted, context);
} catch (...) {
  return caughtFailure();
}

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
  std::array<std::uint64_t, MultiTriangulation::kBands> nodesOfBand{};
  for (const packed::Packet& packet : directory->packets)
    for (const packed::Run& run : packet.runs) nodesOfBand[run.band] += run.nodes;
  std::uint64_t sum = 0;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 1;)
    if ((sum += nodesOfBand[band]) >= nodes)
      return scale.decode(static_cast<OutwardScale::Code>(band << MultiTriangulation::kBandShift));
  return 0;
}

}  // namespace arete
