// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/multitriangulation.h"
#include "engine/node_blocks.h"
#include "io/amt_metadata.h"
#include "io/packed_layout.h"
#include "io/packed_symbols.h"

namespace arete::packed {

/// Zeros from the system, in large pages where it has them; nullptr when there is not enough memory.
void* takeZeros(std::size_t bytes);
void giveZerosBack(void* zeros, std::size_t bytes);

/// An array of zeros, whose memory comes page by page as they are touched. There are some more behind its
/// end, so that looking ahead needs no test.
template <class T>
class ZeroArray {
  static constexpr std::size_t kSpare = 8;

 public:
  ZeroArray() = default;
  /// Not there when there is not enough memory.
  explicit ZeroArray(std::size_t size)
      : data_(static_cast<T*>(takeZeros((size + kSpare) * sizeof(T))), Free{size}) {}
  T* get() const { return data_.get(); }
  T& operator[](std::size_t i) const { return data_.get()[i]; }
  std::size_t size() const { return isThere() ? data_.get_deleter().size : 0; }
  std::span<const T> view() const { return {data_.get(), size()}; }
  bool isThere() const { return data_ != nullptr; }

 private:
  struct Free {
    std::size_t size = 0;
    void operator()(T* p) const { giveZerosBack(p, (size + kSpare) * sizeof(T)); }
  };
  std::unique_ptr<T, Free> data_;
};

/// A triangle: the node that created it and its slot, or kNone and a triangle of the root. All ones: there is
/// no triangle.
struct Handle {
  std::uint32_t node = MultiTriangulation::kNone;
  std::uint32_t slot = MultiTriangulation::kNone;
  bool isNothing() const { return slot == MultiTriangulation::kNone; }
  bool isRoot() const { return node == MultiTriangulation::kNone; }
};

/// Plan coordinates and raw height of a vertex. w is 0.
template <class Real>
struct alignas(4 * sizeof(Real)) Place {
  Real x, y, z, w;
};

/// The MT that grows while a packed file is read, or while one is written: the arrays of MtArrays, and what
/// is needed only on the way.
struct Arrays {
  std::uint32_t rootVertices = 0, roots = 0, nodes = 0, slots = 0;
  bool isLattice = true;
  bool hasFills = false;  ///< rims may reach over NODATA
  std::uint32_t columns = 0, rows = 0;
  HeightEncoding encoding;
  OutwardScale scale;
  MetricFrame metric;

  ZeroArray<std::array<std::uint32_t, 3>> rootTriangles;
  ZeroArray<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  ZeroArray<std::uint16_t> error, below, above, saturatedError;
  ZeroArray<Sphere> sphere;
  NodeBlocks blocks;
  ZeroArray<std::uint32_t> samples;
  ZeroArray<Vec2> plan;
  ZeroArray<std::byte> rawHeights;

  /// Places of the vertices, in float where that holds them exactly (holdsFloats()), else in double.
  ZeroArray<Place<float>> floatPlaces;
  ZeroArray<Place<double>> doublePlaces;
  /// Codes of errors of whole-numbered heights: by doubled area, up to kLatticeErrorArea, and error * area.
  std::vector<std::uint16_t> wholeErrors;
  ZeroArray<std::uint8_t> star;       ///< slots of a node, + kOpen; 0 = not there yet
  ZeroArray<std::uint8_t> shownArea;  ///< per triangle id, see packed::shownArea()
  ZeroArray<Handle> outer;            ///< per slot left by its chunk: what was across the link's edge
  std::vector<Handle> rootOuter;      ///< 3 per root triangle: across each edge
  static constexpr std::uint8_t kOpen = 128;

  /// All arrays, of the sizes stated in MtArrays. False when there is not enough memory.
  bool allocate(const AmtCounts& counts);
  /// Fills rootOuter from rootTriangles.
  void joinRoot();
  /// creatorHint and the end of slotBegin. Precondition: slotBegin is complete.
  void finishHints();
  /// What stays of them.
  static MultiTriangulation model(std::shared_ptr<Arrays> arrays);

  bool holdsFloats() const {
    constexpr std::uint32_t kMost = 1u << 22;
    return isLattice && columns <= kMost && rows <= kMost && encoding.type != HeightEncoding::Type::float64;
  }
  template <class Real>
  Place<Real>* places() const {
    if constexpr (std::is_same_v<Real, float>)
      return floatPlaces.get();
    else
      return doublePlaces.get();
  }
  double height(std::uint32_t vertex) const { return rawHeight(encoding.type, rawHeights.get(), vertex); }
  std::uint32_t idOf(Handle h) const { return h.isRoot() ? h.slot : roots + h.slot; }
  std::uint32_t starSize(std::uint32_t node) const { return star[node] & (kOpen - 1u); }
  bool isOpen(std::uint32_t node) const { return (star[node] & kOpen) != 0; }
};

/// Saturated errors and spheres of the nodes of a chunk, from those of their children, which are complete:
/// see engine/mt_recorder.h. A node's sphere holds its star when this is called. Nothing, or what is wrong: a
/// saturated error outside of its band. A node's saturated error is the largest of its floor when this is
/// called. Of a part of an MT (`isPart`) some children are missing; its
/// saturated errors are at least the lowest of their band.
std::optional<std::string> saturate(Arrays& arrays, const Chunk& chunk, bool isPart);

}  // namespace arete::packed
