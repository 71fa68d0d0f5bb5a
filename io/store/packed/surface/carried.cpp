// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writer and reader run the same code over the segments, in the order of the pages: those that a page depends
// on come before it. The writer numbers wedges as this walk names them first, so that nearly every new wedge
// is the next one. What several pages make known, each a face or a wedge of its own neighbourhood, is joined
// by its number when all have been read.
#include "io/store/packed/surface/carried.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>

#include "engine/memory/required_memory.h"
#include "io/store/entropy/number_bytes.h"
#include "io/store/packed/surface/carried_coder.h"
#include "io/store/packed/surface/carried_io.h"
#include "surface/model/face_successors.h"
#include "surface/model/renumbered.h"

namespace arete::packed {
namespace {

constexpr std::uint8_t kByLargest = 1, kDisplaced = 2;

/// Calls visit(triangle) for all triangles in the order of the pages, the root's first.
template <class Visit>
void forTrianglesOfPages(const MultiTriangulation& mt, const Directory& pages, const Visit& visit) {
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) visit(t);
  for (const Packet& page : pages.packets)
    for (const Run& run : page.runs)
      for (std::uint32_t n = run.firstNode; n < run.firstNode + run.nodes; ++n)
        for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i)
          visit(mt.slotTriangle(NodeId(n), i).index());
}

/// Numbers the wedges as the pages name them first, those of no corner last. @return how many have a corner
std::uint32_t numberWedges(SurfaceModel& model, const Directory& pages) {
  WedgeNumbering numbering(model.attributes.wedgeCount);
  forTrianglesOfPages(model.mt, pages, [&](std::uint32_t t) { numbering.number(model.wedgesOf[t]); });
  const std::uint32_t named = numbering.named();
  std::move(numbering).reorder(model.attributes.wedgeAttributes);
  return named;
}

/// Whether the faces of the source follow their vertices' largest numbers rather than their least.
bool followsLargest(const SurfaceModel& model, double facesPerVertex) {
  std::uint64_t least = 0, largest = 0;  // bits
  const auto bitsOf = [&](std::uint32_t vertex, std::uint32_t face) {
    const std::int64_t by = std::int64_t{face} - std::llround(facesPerVertex * vertex);
    return static_cast<unsigned>(std::bit_width(zigzag(by)));
  };
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    if (model.mt.remover(TriangleId(t)).isValid()) continue;
    const auto corners = model.mt.corners(TriangleId(t));
    const std::uint32_t a = model.vertexOf[corners[0]], b = model.vertexOf[corners[1]],
                        c = model.vertexOf[corners[2]];
    least += bitsOf(std::min({a, b, c}), model.faceOf[t]);
    largest += bitsOf(std::max({a, b, c}), model.faceOf[t]);
  }
  return largest < least;
}

double facesPerVertexOf(const SurfaceModel& model) {
  return double(model.sourceFaces) / double(std::max<std::uint64_t>(model.sourceVertices, 1));
}

bool carryValues(const MeshAttributes& a) {
  return faceValueBytes(a) > 0;
}

/// What was declared, by rising number, each once: the index of its values.
std::vector<std::size_t> inOrder(const Declared& declared) {
  std::vector<std::size_t> order(declared.numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto& numbers = declared.numbers;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  const auto same = std::ranges::unique(order, {}, [&](std::size_t i) { return numbers[i]; });
  order.erase(same.begin(), same.end());
  return order;
}

void resizeRows(std::vector<Attribute>& attributes, std::size_t rows) {
  for (Attribute& attribute : attributes) attribute.values.assign(rows * attribute.elementBytes(), {});
}

/// Reads what the segments carry.
class Unpacking {
 public:
  Unpacking(const CarriedChunks& chunks, std::span<const std::byte> nodes, const Directory& pages,
            bool isPart, SurfaceModel& model)
      : chunks_(chunks), nodes_(nodes), pages_(pages), isPart_(isPart), model_(model) {}

  Status run() {
    if (!readTables()) return damaged("the tables are");
    if (leastCarried() > carriedBytes()) return damaged("the looks, or the pages, are");
    allocate();
    for (const Packet& page : pages_.packets)
      if (!readPage(page))
        return failure(ErrorCode::corrupt,
                       fmt::format("page {}: what its triangles carry is damaged", page.number));
    ARETE_CHECK(takeWedges());
    ARETE_CHECK(takeFaces());
    if (!rest_.empty()) return damaged("the chunk ATTR is");
    return {};
  }

 private:
  static tl::unexpected<Error> damaged(const char* what) {
    return failure(ErrorCode::corrupt,
                   fmt::format("{} damaged: what the triangles of its pages carry", what));
  }

  bool readTables() {
    NumberReader in(chunks_.tables);
    const auto flags = in.plain<std::uint8_t>();
    if (in.isBad() || flags > (kByLargest | kDisplaced)) return false;
    rule_.ordersByLargest = (flags & kByLargest) != 0;
    rule_.hasDisplacement = (flags & kDisplaced) != 0;
    rule_.hasCoarseFaces = model_.hasFaceAttributes();
    rule_.facesPerVertex = facesPerVertexOf(model_);
    const auto read = tablesOf(chunks_.tables.subspan(1), kCarriedTables);
    if (!read) return false;
    tables_.resize(kCarriedTables * RansTable::kEntries);
    for (std::size_t t = 0; t < kCarriedTables; ++t)
      (*read)[t].writeEntries(&tables_[t * RansTable::kEntries]);
    return true;
  }

  /// The plain values that vertices and triangles have at least, so that memory is held against the bytes.
  std::uint64_t leastCarried() const {
    std::uint64_t triangles = model_.mt.rootTriangleCount(), ofVertex = 0;
    for (std::uint32_t n = 0; n < model_.mt.nodeCount(); ++n) triangles += model_.mt.ceilingSize(NodeId(n));
    for (const Attribute& attribute : model_.attributes.vertexAttributes)
      ofVertex += attribute.elementBytes();
    const std::uint64_t ofTriangle =
        sizeof(std::uint16_t) * model_.attributeErrors.size() * (1 + model_.attributeDistances.size());
    return triangles * ofTriangle + model_.mt.vertexCount() * ofVertex;
  }
  std::uint64_t carriedBytes() const {
    std::uint64_t sum = 0;
    for (const Packet& page : pages_.packets)
      for (const Segment& segment : page.segments) sum += segment.carriedBytes;
    return sum;
  }

  void allocate() {
    const std::size_t vertices = model_.mt.vertexCount(), ids = model_.mt.triangleIdCount();
    // The numbers, and what is plain in the pages once more.
    requireMemory(vertices * sizeof(std::uint32_t) +
                      ids * (sizeof(std::uint32_t) + (model_.attributes.wedgeCount > 0 ? 12 : 0)) +
                      2 * carriedBytes(),
                  "ask for less of the surface");
    model_.vertexOf.assign(vertices, 0);
    model_.faceOf.assign(ids, 0);
    model_.wedgesOf.assign(model_.attributes.wedgeCount > 0 ? ids : 0, {0, 0, 0});
    if (rule_.hasDisplacement) {
      model_.displacement.directions.assign(vertices, {});
      model_.displacement.reaches.assign(ids, 0);
    }
    for (AttributeErrors& errors : model_.attributeErrors)
      errors.codes.assign((1 + model_.attributeDistances.size()) * ids, 0);
    resizeRows(model_.attributes.vertexAttributes, vertices);
    faces_.valueBytes = faceValueBytes(model_.attributes);
    wedges_.valueBytes = wedgeValueBytes(model_.attributes);
    rest_ = chunks_.rest;
  }

  bool readPage(const Packet& page) {
    std::size_t next = 0;
    for (const Segment& segment : page.segments) {
      const auto bytes =
          nodes_.subspan(segment.begin() + segment.bytes() - segment.carriedBytes, segment.carriedBytes);
      auto io = CarriedReaderIo::of(bytes, tables_, faces_, wedges_);
      if (!io) return false;
      CarriedCoder<CarriedReaderIo> coder(model_, rule_, *io);
      if (page.number == 0 && &segment == &page.segments.front() && !coder.root()) return false;
      const std::size_t end = next + segment.runs;
      for (; next < std::min(end, page.runs.size()); ++next)
        if (!coder.run(page.runs[next])) return false;
      if (next < end) return !io->isShort();  // the last runs of the last segment are not wanted
      if (!io->isAtEnd()) return false;
    }
    return true;
  }

  /// The next values of what no triangle has.
  std::span<const std::byte> fromRest(std::size_t bytes) {
    if (bytes > rest_.size()) return {};
    const auto values = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return values;
  }

  Status takeWedges() {
    MeshAttributes& a = model_.attributes;
    if (!model_.hasWedges() || wedges_.valueBytes == 0) return {};
    const std::vector<std::size_t> order = inOrder(wedges_);
    const auto valuesOf = [&](std::size_t i) {
      return std::span(std::as_const(wedges_.values)).subspan(i * wedges_.valueBytes, wedges_.valueBytes);
    };
    if (isPart_) {
      std::vector<std::uint32_t> numbers;
      for (const std::size_t i : order) numbers.push_back(wedges_.numbers[i]);
      resizeRows(a.wedgeAttributes, order.size());
      for (std::size_t row = 0; row < order.size(); ++row) setWedgeValues(a, row, valuesOf(order[row]));
      forTrianglesOfPages(model_.mt, pages_, [&](std::uint32_t t) {
        for (std::uint32_t& w : model_.wedgesOf[t])
          w = static_cast<std::uint32_t>(std::ranges::lower_bound(numbers, w) - numbers.begin());
      });
      a.wedgeCount = static_cast<std::uint32_t>(numbers.size());
      return {};
    }
    // The numbers of those that have corners come first.
    const std::uint64_t missing = a.wedgeCount - std::min<std::uint64_t>(a.wedgeCount, order.size());
    if (missing > rest_.size() / wedges_.valueBytes) return damaged("the wedges are");
    resizeRows(a.wedgeAttributes, a.wedgeCount);
    for (std::size_t row = 0; row < order.size(); ++row) {
      if (wedges_.numbers[order[row]] != row) return damaged("the wedges are");
      setWedgeValues(a, row, valuesOf(order[row]));
    }
    for (std::size_t row = order.size(); row < a.wedgeCount; ++row)
      setWedgeValues(a, row, fromRest(wedges_.valueBytes));
    return {};
  }

  Status takeFaces() {
    MeshAttributes& a = model_.attributes;
    if (isPart_) rest_ = {};
    if (!carryValues(a)) return {};
    const std::vector<std::size_t> order = inOrder(faces_);
    const auto valuesOf = [&](std::size_t i) {
      return std::span(std::as_const(faces_.values)).subspan(i * faces_.valueBytes, faces_.valueBytes);
    };
    const std::uint64_t rows = isPart_ ? order.size() : model_.sourceFaces;
    if (!isPart_ && (rows < order.size() || rows - order.size() != rest_.size() / faces_.valueBytes))
      return damaged("the faces are");
    resizeRows(a.triangleAttributes, rows);
    for (auto* list : faceListsOf(a))
      if (!list->empty()) list->assign(rows, 0);
    if (!isPart_) {
      std::size_t next = 0;
      for (std::uint64_t face = 0; face < rows; ++face) {
        const bool isThere = next < order.size() && faces_.numbers[order[next]] == face;
        setFaceValues(a, face, isThere ? valuesOf(order[next]) : fromRest(faces_.valueBytes));
        next += isThere ? 1 : 0;
      }
      return {};
    }
    for (const std::size_t i : order) {
      setFaceValues(a, model_.partFaces.size(), valuesOf(i));
      model_.partFaces.push_back(faces_.numbers[i]);
    }
    forTrianglesOfPages(model_.mt, pages_, [&](std::uint32_t t) {
      std::uint32_t& face = model_.faceOf[t];
      face = static_cast<std::uint32_t>(std::ranges::lower_bound(model_.partFaces, face) -
                                        model_.partFaces.begin());
    });
    return {};
  }

  CarriedChunks chunks_;
  std::span<const std::byte> nodes_;
  const Directory& pages_;
  bool isPart_;
  SurfaceModel& model_;
  CarriedRule rule_;
  std::vector<std::uint32_t> tables_;
  Declared faces_, wedges_;
  std::span<const std::byte> rest_;
};

}  // namespace

CarriedBytes packCarried(SurfaceModel& model, const Directory& pages) {
  CarriedRule rule;
  rule.hasCoarseFaces = model.hasFaceAttributes();
  rule.hasDisplacement = !model.displacement.isEmpty();
  rule.facesPerVertex = facesPerVertexOf(model);
  rule.ordersByLargest = followsLargest(model, rule.facesPerVertex);
  // Which triangle follows another depends on where a star begins, which packing changes.
  if (!rule.hasCoarseFaces) inheritFaces(model.mt, model.faceOf);
  const std::uint32_t named = model.hasWedges() ? numberWedges(model, pages) : 0;

  std::vector<std::vector<CarriedWriterIo>> written(pages.packets.size());
  std::uint32_t nextWedge = 0;
  std::vector<std::array<std::uint64_t, RansTable::kAlphabet>> counts(kCarriedTables);
  for (std::size_t p = 0; p < pages.packets.size(); ++p) {
    const Packet& page = pages.packets[p];
    std::size_t next = 0;
    for (const Segment& segment : page.segments) {
      CarriedWriterIo& io = written[p].emplace_back(model.attributes, nextWedge);
      CarriedCoder<CarriedWriterIo> coder(model, rule, io);
      if (p == 0 && written[p].size() == 1) coder.root();
      for (std::uint32_t r = 0; r < segment.runs; ++r) coder.run(page.runs[next++]);
      nextWedge = io.nextWedge();
      for (const RansSymbol symbol : io.symbols()) ++counts[symbol.table][symbol.symbol];
    }
  }
  std::vector<RansTable> tables;
  for (const auto& c : counts) tables.push_back(RansTable::ofCounts(c));

  CarriedBytes bytes;
  bytes.tables.push_back(static_cast<std::byte>((rule.ordersByLargest ? kByLargest : 0) |
                                                (rule.hasDisplacement ? kDisplaced : 0)));
  const std::vector<std::byte> coded = toBytes(tables);
  bytes.tables.insert(bytes.tables.end(), coded.begin(), coded.end());
  bytes.ofPage.resize(written.size());
  for (std::size_t p = 0; p < written.size(); ++p)
    for (CarriedWriterIo& io : written[p]) bytes.ofPage[p].push_back(io.encoded(tables));

  const MeshAttributes& a = model.attributes;
  for (std::uint32_t w = named; w < a.wedgeCount; ++w) addWedgeValues(a, w, bytes.rest);
  if (!carryValues(a)) return bytes;
  std::vector<bool> isThere(model.sourceFaces);
  forTrianglesOfPages(model.mt, pages, [&](std::uint32_t t) { isThere[model.faceOf[t]] = true; });
  for (std::uint32_t f = 0; f < model.sourceFaces; ++f)
    if (!isThere[f]) addFaceValues(a, f, bytes.rest);
  return bytes;
}

Status unpackCarried(const CarriedChunks& chunks, std::span<const std::byte> nodes, const Directory& pages,
                     bool isPart, SurfaceModel& model) {
  return Unpacking(chunks, nodes, pages, isPart, model).run();
}

}  // namespace arete::packed
