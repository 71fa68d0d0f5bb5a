// SPDX-License-Identifier: GPL-3.0-or-later
//
// A floor of k triangles takes 3 + 2 (k - 1) bits, and a walk ends by itself. So the list tries every number
// of the bits of kListedTriangles triangles: it is the number of the walk whose bits it begins with if only
// zeros follow.
#include "io/store/packed/nodes/shapes.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <vector>

namespace arete::packed {
namespace {

constexpr int bitsOf(unsigned triangles) {
  return static_cast<int>(1 + 2 * triangles);
}

struct List {
  std::vector<Shape> shapes;
  std::vector<std::uint16_t> codes;  ///< of each

  List() {
    struct Entry {
      Shape shape;
      std::uint16_t code;
    };
    std::vector<Entry> entries;
    for (std::uint32_t code = 0; code < 1u << bitsOf(kListedTriangles); ++code) {
      std::uint32_t left = code;
      const auto shape = walkedShape([&](const Shape&, int, int count) {
        const unsigned bits = left & ((1u << count) - 1);
        left >>= count;
        return bits;
      });
      if (shape && left == 0 && shape->triangles <= kListedTriangles)
        entries.push_back({*shape, static_cast<std::uint16_t>(code)});
    }
    assert(entries.size() == kListedShapes);
    std::ranges::stable_sort(entries, {}, [](const Entry& e) { return e.shape.triangles; });
    for (const Entry& e : entries) {
      shapes.push_back(e.shape);
      codes.push_back(e.code);
    }
  }
};

const List& list() {
  static const List all;
  return all;
}

}  // namespace

std::span<const Shape, kListedShapes> listedShapes() {
  return std::span<const Shape, kListedShapes>(list().shapes.data(), kListedShapes);
}

unsigned shapeSymbol(std::uint64_t bits, unsigned triangles) {
  if (triangles > kListedTriangles) return kWalkedShape;
  const auto& codes = list().codes;
  return static_cast<unsigned>(std::ranges::find(codes, bits) - codes.begin());
}

}  // namespace arete::packed
