// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/schema.h"

#include "engine/mt/node_blocks.h"

namespace arete {
namespace {

template <class Model>
std::vector<AmtMtColumn> mtColumnsOf(const AmtFacts& facts) {
  std::vector<AmtMtColumn> columns;
  for (const AmtRow<Model>& row : kAmtSchema<Model>)
    if (row.mt && row.isIn(facts)) columns.push_back({row, row.mt});
  return columns;
}

template <class Model>
const AmtColumn* findIn(const AmtTag& tag) {
  const auto found = std::ranges::find(kAmtSchema<Model>, tag, &AmtColumn::tag);
  return found == kAmtSchema<Model>.end() ? nullptr : &*found;
}

}  // namespace

std::uint64_t amtCountOf(AmtPer per, const AmtFacts& facts) {
  const AmtCounts& c = facts.counts;
  switch (per) {
    case AmtPer::rootTriangle:
      return c.rootTriangles;
    case AmtPer::node:
      return c.nodes;
    case AmtPer::nodeOrEnd:
      return c.nodes + 1;
    case AmtPer::slot:
      return c.slots;
    case AmtPer::triangle:
      return c.rootTriangles + c.slots;
    case AmtPer::floorTriangle:
      return c.slots - 2 * c.nodes;
    case AmtPer::block:
      return nodeBlockAndPageCount(c.nodes);
    case AmtPer::hint:
      return (c.slots + MultiTriangulation::kSlotsPerHint - 1) / MultiTriangulation::kSlotsPerHint;
    case AmtPer::vertex:
      return c.rootVertices + c.nodes;
    case AmtPer::finestTriangle:
      return facts.finestTriangles;
    case AmtPer::isolated:
      return c.isolated;
    case AmtPer::fixedVertex:
      return c.fixedVertices;
    case AmtPer::segment:
      return facts.segments.value_or(0);
    default:
      return 0;
  }
}

std::string_view toString(AmtPer per) {
  // The names follow the order of the enumerators.
  constexpr std::array<std::string_view, 14> kNames = {
      "root triangle",   "node",         "node and end", "slot",   "triangle",
      "floor triangle",  "block",        "hint",         "vertex", "finest triangle",
      "isolated sample", "fixed vertex", "segment",      "any"};
  return kNames[static_cast<std::size_t>(per)];
}

std::string_view toString(AmtCoding coding) {
  constexpr std::array<std::string_view, 9> kNames = {
      "raw", "walked", "outward", "delta", "derived", "numbers", "displacement", "dropped", "packed"};
  return kNames[static_cast<std::size_t>(coding)];
}

std::vector<AmtMtColumn> amtMtColumns(const AmtFacts& facts) {
  return facts.kind == ModelKind::terrain ? mtColumnsOf<TerrainModel>(facts)
                                          : mtColumnsOf<SurfaceModel>(facts);
}

std::vector<AmtMtColumn> amtMtColumns(const MtArrays& a) {
  // The vertices show what kind of model the arrays are of.
  AmtFacts facts;
  facts.kind = a.vertices.hasPlan() ? ModelKind::terrain : ModelKind::surface;
  facts.isLattice = a.vertices.isLattice();
  facts.heights = a.vertices.encoding.type;
  facts.hasDoubles = !a.vertices.places64.empty();
  std::vector<AmtMtColumn> columns = amtMtColumns(facts);
  std::erase_if(columns, [&](const AmtMtColumn& column) {
    return column.need == AmtNeed::whereFound && column.mt.bytes(a).empty();
  });
  return columns;
}

const AmtColumn* findAmtColumn(const AmtTag& tag) {
  const AmtColumn* const ofTerrain = findIn<TerrainModel>(tag);
  return ofTerrain != nullptr ? ofTerrain : findIn<SurfaceModel>(tag);
}

}  // namespace arete
