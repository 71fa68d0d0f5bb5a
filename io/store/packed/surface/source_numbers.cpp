// SPDX-License-Identifier: GPL-3.0-or-later
//
// A vertex is predicted to have the middle one of its link's numbers: vertices that are near have near
// numbers in most files, and in a grid exactly this one. How far the link's numbers are from each other
// selects the table.
//
// Faces of the finest triangles are coded in the order of the least (or the largest) of their corners'
// numbers in the source, whichever takes fewer bits, as differences from the face before: files list faces by
// their vertices, or vertices by their faces. The last difference selects the table, because such lists have
// patterns. Where coarse triangles have faces of their own, these follow from the finest ones to the
// coarsest: that of the triangle that follows (successorSlotOf()), that of another one of the same star, or
// any.
//
// A corner has the wedge that its vertex had last, or one of those that it had before, or the next new wedge,
// or any.
//
// Writer and reader run the same code, as the coder of nodes does (io/store/packed/nodes/node_coder.h).
#include "io/store/packed/surface/source_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"
#include "io/store/packed/surface/vertex_numbers.h"
#include "surface/model/face_successors.h"

namespace arete::packed {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;

constexpr unsigned kSpreads = kVertexSpreads, kLastSymbols = 24, kWedgeCounts = 3;
enum NumberTable : unsigned {
  kVertexTable = 0,                        // by the spread of the link's numbers
  kFaceTable = kVertexTable + kSpreads,    // by the symbol before
  kHeirTable = kFaceTable + kLastSymbols,  // which triangle of the star has the face
  kOtherFaceTable,                         // any face
  kWedgeTable,                             // by how many wedges the vertex had
  kOtherWedgeTable = kWedgeTable + kWedgeCounts,
  kNumberTables
};

/// Symbols of a corner's wedge: below kOtherWedge, how many of the vertex's wedges were in use after it.
constexpr unsigned kOtherWedge = 254, kNewWedge = 255;

/// Calls visit(triangle, creator) for all triangles, from the first to the last or back.
template <class Visit>
void forTriangles(const MultiTriangulation& mt, bool isBack, const Visit& visit) {
  const auto ofNode = [&](std::uint32_t n) {
    const std::uint32_t count = mt.ceilingSize(NodeId(n));
    for (std::uint32_t i = 0; i < count; ++i)
      visit(mt.slotTriangle(NodeId(n), isBack ? count - 1 - i : i).index(), NodeId(n));
  };
  const std::uint32_t nodes = mt.nodeCount(), roots = mt.rootTriangleCount();
  if (isBack)
    for (std::uint32_t n = nodes; n-- > 0;) ofNode(n);
  for (std::uint32_t t = 0; t < roots; ++t) visit(isBack ? roots - 1 - t : t, NodeId());
  if (!isBack)
    for (std::uint32_t n = 0; n < nodes; ++n) ofNode(n);
}

template <class Io>
void codeVertices(SurfaceModel& model, Io& io) {
  const MultiTriangulation& mt = model.mt;
  std::vector<std::uint32_t>& numbers = model.vertexOf;
  std::uint32_t before = 0;
  for (std::uint32_t v = 0; v < mt.rootVertexCount(); ++v)
    before = numbers[v] =
        moved(before, codeSigned(io, kSymbols, kVertexTable + kSpreads - 1, behind(numbers[v], before)));
  std::vector<std::uint32_t> space;
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    codeVertexNumber(numbers, mt.link(NodeId(n)), mt.apex(NodeId(n)).index(), kVertexTable, io, space);
}

/// The finest triangles, by the numbers of their corners in the source, the least (or the largest) first.
std::vector<std::uint32_t> finestInOrder(const SurfaceModel& model, bool byLargest) {
  std::vector<std::array<std::uint32_t, 4>> entries;  // numbers of the corners, triangle
  forTriangles(model.mt, false, [&](std::uint32_t t, NodeId creator) {
    if (model.mt.remover(TriangleId(t)).isValid()) return;
    std::array<std::uint32_t, 3> numbers = model.mt.corners(TriangleId(t), creator);
    for (std::uint32_t& v : numbers) v = model.vertexOf[v];
    std::ranges::sort(numbers);
    if (byLargest) std::ranges::reverse(numbers);
    entries.push_back({numbers[0], numbers[1], numbers[2], t});
  });
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> order;
  for (const auto& entry : entries) order.push_back(entry[3]);
  return order;
}

/// About how many bits the differences of the faces take in an order.
std::uint64_t bitsOf(const SurfaceModel& model, std::span<const std::uint32_t> order) {
  std::uint64_t bits = 0;
  std::uint32_t before = 0;
  for (const std::uint32_t t : order) {
    bits += static_cast<std::uint64_t>(std::bit_width(zigzag(behind(model.faceOf[t], before))));
    before = model.faceOf[t];
  }
  return bits;
}

template <class Io>
void codeFinestFaces(SurfaceModel& model, bool byLargest, Io& io) {
  std::uint32_t before = 0, last = 0;
  for (const std::uint32_t t : finestInOrder(model, byLargest)) {
    const std::int64_t by = codeSigned(io, kSymbols, kFaceTable + last, behind(model.faceOf[t], before));
    before = model.faceOf[t] = moved(before, by);
    last = std::min(bucketOf(zigzag(by)).symbol, kLastSymbols - 1);
  }
}

/// Faces of the triangles that nodes remove, from the last one to the first: those of a star come before
/// those that it replaces.
template <class Io>
void codeCoarseFaces(SurfaceModel& model, Io& io) {
  const MultiTriangulation& mt = model.mt;
  forTriangles(mt, true, [&](std::uint32_t t, NodeId creator) {
    const NodeId node = mt.remover(TriangleId(t));
    if (!node.isValid()) return;
    std::uint32_t& face = model.faceOf[t];
    const std::uint32_t size = mt.ceilingSize(node), heir = successorSlotOf(mt, TriangleId(t), creator, node);
    const auto faceOfSlot = [&](unsigned i) {
      return model.faceOf[mt.slotTriangle(node, (heir + i) % size).index()];
    };
    const unsigned symbol = io.code(kSymbols, kHeirTable, [&] {
      unsigned i = 0;
      while (i < size && faceOfSlot(i) != face) ++i;
      return i;
    });
    face = symbol < size ? faceOfSlot(symbol)
                         : moved(0, codeSigned(io, kSymbols, kOtherFaceTable, behind(face, 0)));
  });
}

/// @return false where a wedge is not one of the model
template <class Io>
bool codeWedges(SurfaceModel& model, Io& io) {
  const std::uint32_t count = model.attributes.wedgeCount;
  // By vertex, its wedges from the one in use last; by wedge, the one of its vertex that was in use before
  // it.
  std::vector<std::uint32_t> last(model.mt.vertexCount(), kNone), before;
  std::uint32_t next = 0;
  bool isSound = true;
  forTriangles(model.mt, false, [&](std::uint32_t t, NodeId creator) {
    if (!isSound) return;
    const auto corners = model.mt.corners(TriangleId(t), creator);
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t& first = last[corners[c]];
      std::uint32_t& wedge = model.wedgesOf[t][c];
      const unsigned known = first == kNone ? 0 : before[first] == kNone ? 1 : 2;
      const unsigned symbol = io.code(kSymbols, kWedgeTable + known, [&] {
        unsigned i = 0;
        for (std::uint32_t w = first; w != kNone; w = before[w], ++i)
          if (w == wedge) return std::min(i, kOtherWedge);
        return wedge == next ? kNewWedge : kOtherWedge;
      });
      if (symbol == kOtherWedge) {
        wedge = moved(0, codeSigned(io, kSymbols, kOtherWedgeTable, behind(wedge, 0)));
        isSound = isSound && wedge < count;
        continue;
      }
      if (symbol == kNewWedge) {
        if (next == count) return static_cast<void>(isSound = false);
        wedge = next++;
        before.push_back(first);
      } else {
        std::uint32_t after = kNone, found = first;
        for (unsigned i = 0; i < symbol && found != kNone; ++i) after = std::exchange(found, before[found]);
        if (found == kNone) return static_cast<void>(isSound = false);
        wedge = found;
        if (after == kNone) continue;
        before[after] = before[found];
        before[found] = first;
      }
      first = wedge;
    }
  });
  return isSound;
}

/// @param byLargest  the order of the faces; the reader's argument is ignored
template <class Io>
bool codeNumbers(SurfaceModel& model, bool hasCoarseFaces, bool byLargest, Io& io) {
  codeVertices(model, io);
  byLargest = io.raw(1, byLargest ? 1 : 0) != 0;
  codeFinestFaces(model, byLargest, io);
  if (hasCoarseFaces) codeCoarseFaces(model, io);
  return !model.hasWedges() || codeWedges(model, io);
}

}  // namespace

std::vector<std::byte> packSourceNumbers(const SurfaceModel& model) {
  // The numbers are written to the copy as the reader writes them.
  SurfaceModel numbers;
  numbers.mt = model.mt;
  numbers.vertexOf = model.vertexOf;
  numbers.faceOf = model.faceOf;
  numbers.wedgesOf = model.wedgesOf;
  numbers.attributes.wedgeCount = model.attributes.wedgeCount;
  const std::uint64_t byLeast = bitsOf(model, finestInOrder(model, false)),
                      byLargest = bitsOf(model, finestInOrder(model, true));
  SymbolWriter io(kNumberTables);
  codeNumbers(numbers, model.hasFaceAttributes(), byLargest < byLeast, io);
  return io.take();
}

Status unpackSourceNumbers(std::span<const std::byte> bytes, SurfaceModel& model) {
  std::optional<SymbolReader> io = SymbolReader::of(bytes, kNumberTables);
  if (!io) return failure(ErrorCode::corrupt, "the packed numbers of its source are cut short or damaged");
  model.vertexOf.assign(model.mt.vertexCount(), 0);
  model.faceOf.assign(model.mt.triangleIdCount(), 0);
  model.wedgesOf.assign(model.attributes.wedgeCount > 0 ? model.mt.triangleIdCount() : 0, {0, 0, 0});
  if (!codeNumbers(model, model.hasFaceAttributes(), false, *io) || !io->isAtEnd())
    return failure(ErrorCode::corrupt, "the packed numbers of its source do not end where they should");
  if (!model.hasFaceAttributes()) inheritFaces(model.mt, model.faceOf);
  return {};
}

}  // namespace arete::packed
