// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "io/store/format/columns.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The schemas: of each kind of model, all columns of its files in the order in which they are written. The
/// writer, the reader, the packer, the copy of a part and the checks walk over them, so that a new column is
/// a row here and what makes and uses it.

namespace amt_rows {

template <>
struct ElementOf<SurfaceModel::LeftOutFace> : Element<AmtScalar::u32, 2> {};

template <class Model>
inline constexpr std::array kTopologyRows = {
    made<Model, std::byte>(amt_tag::kMetadata, AmtPer::any, AmtCoding::raw),
    ofMt<Model, &MtArrays::rootTriangles>(amt_tag::kRootTriangles, AmtPer::rootTriangle, AmtCoding::walked),
    ofMt<Model, &MtArrays::slotBegin>(amt_tag::kSlotBegin, AmtPer::nodeOrEnd, AmtCoding::walked),
    ofMt<Model, &MtArrays::link>(amt_tag::kLink, AmtPer::slot, AmtCoding::walked),
    ofMt<Model, &MtArrays::remover>(amt_tag::kRemover, AmtPer::triangle, AmtCoding::walked),
    ofMt<Model, &MtArrays::error>(amt_tag::kError, AmtPer::triangle, AmtCoding::outward),
};
template <class Model>
inline constexpr std::array kNodeRows = {
    ofMt<Model, &MtArrays::floor>(amt_tag::kFloor, AmtPer::floorTriangle, AmtCoding::walked),
    ofMt<Model, &MtArrays::saturatedError>(amt_tag::kSaturatedError, AmtPer::node, AmtCoding::derived),
    ofMt<Model, &MtArrays::sphere>(amt_tag::kSphere, AmtPer::node, AmtCoding::derived),
    ofMt<Model, &MtArrays::blockError>(amt_tag::kBlockError, AmtPer::block, AmtCoding::derived),
    ofMt<Model, &MtArrays::blockSphere>(amt_tag::kBlockSphere, AmtPer::block, AmtCoding::derived),
    ofMt<Model, &MtArrays::creatorHint>(amt_tag::kCreatorHint, AmtPer::hint, AmtCoding::derived),
};
inline constexpr bool isPaged(const AmtFacts& f) {
  return f.isPaged;
}
inline constexpr bool isUnpaged(const AmtFacts& f) {
  return !f.isPaged;
}
/// The root of the directory of pages follows the metadata, so that it lies at the beginning of the file.
template <class Model>
inline constexpr std::array kPackedRows = {
    made<Model, std::byte>(amt_tag::kPageRoot, AmtPer::any, AmtCoding::packed,
                           {.since = 3, .flags = kAmtRequired, .when = isPaged}),
    made<Model, std::byte>(amt_tag::kPackedDirectory, AmtPer::any, AmtCoding::packed, {.when = isUnpaged}),
    made<Model, std::byte>(amt_tag::kPackedTables, AmtPer::any, AmtCoding::packed),
    made<Model, std::byte>(amt_tag::kPackedNodes, AmtPer::any, AmtCoding::packed, {.when = isUnpaged}),
};
/// What is read in part lies behind what is read whole.
template <class Model>
inline constexpr std::array kPageRows = {
    made<Model, std::byte>(amt_tag::kPageBlocks, AmtPer::any, AmtCoding::packed,
                           {.since = 3, .flags = kAmtRequired, .when = isPaged}),
    made<Model, std::byte>(amt_tag::kPackedNodes, AmtPer::any, AmtCoding::packed,
                           {.since = 3, .when = isPaged}),
};
/// Files written by early builds of Arete lack it.
template <class Model>
inline constexpr std::array kSegmentRows = {
    made<Model, std::uint64_t>(amt_tag::kSegmentChecksums, AmtPer::segment, AmtCoding::raw,
                               {.when = [](const AmtFacts& f) { return f.segments.has_value(); }}),
};

inline constexpr bool isLattice(const AmtFacts& f) {
  return f.isLattice;
}
inline constexpr bool isScattered(const AmtFacts& f) {
  return !f.isLattice;
}
template <HeightEncoding::Type kType>
constexpr bool hasHeights(const AmtFacts& f) {
  return f.heights == kType;
}
inline constexpr bool hasFloats(const AmtFacts& f) {
  return !f.hasDoubles;
}
inline constexpr bool hasDoubles(const AmtFacts& f) {
  return f.hasDoubles;
}
inline constexpr bool hasAllFaces(const AmtFacts& f) {
  return f.hasAllFaces;
}
inline constexpr bool hasFinestFaces(const AmtFacts& f) {
  return !f.hasAllFaces;
}
inline constexpr bool hasWedges(const AmtFacts& f) {
  return f.hasWedges;
}
inline constexpr bool hasDisplacement(const AmtFacts& f) {
  return f.hasDisplacement;
}

/// Heights are bytes in memory, and numbers of a type that the metadata names in a file.
template <HeightEncoding::Type kType>
constexpr AmtRow<TerrainModel> heights(AmtScalar scalar) {
  AmtRow<TerrainModel> row = ofMt<TerrainModel, &MtArrays::vertices, &VertexArrays::rawHeights>(
      amt_tag::kHeights, AmtPer::vertex, AmtCoding::delta, {.when = hasHeights<kType>});
  row.scalar = scalar;
  return row;
}

inline constexpr std::array kBoundRows = {
    ofColumn<TerrainModel, kBelow>(amt_tag::kBelow, AmtPer::triangle, AmtCoding::outward),
    ofColumn<TerrainModel, kAbove>(amt_tag::kAbove, AmtPer::triangle, AmtCoding::outward),
};
inline constexpr std::array kPlanRows = {
    ofMt<TerrainModel, &MtArrays::vertices, &VertexArrays::samples>(amt_tag::kSamples, AmtPer::vertex,
                                                                    AmtCoding::delta, {.when = isLattice}),
    ofMt<TerrainModel, &MtArrays::vertices, &VertexArrays::plan>(amt_tag::kPlan, AmtPer::vertex,
                                                                 AmtCoding::delta, {.when = isScattered}),
    heights<HeightEncoding::Type::int16>(AmtScalar::i16),
    heights<HeightEncoding::Type::float32>(AmtScalar::f32),
    heights<HeightEncoding::Type::float64>(AmtScalar::f64),
};
inline constexpr std::array kSampleRows = {
    made<TerrainModel, std::uint32_t>(amt_tag::kIsolatedSamples, AmtPer::isolated, AmtCoding::raw),
    made<TerrainModel, double>(amt_tag::kIsolatedHeights, AmtPer::isolated, AmtCoding::raw),
    ofModel<TerrainModel, &TerrainModel::options, &BuildOptions::fixedVertices>(
        amt_tag::kFixedVertices, AmtPer::fixedVertex, AmtCoding::raw),
};

inline constexpr std::array kRmsRows = {
    ofColumn<SurfaceModel, kRms>(amt_tag::kRms, AmtPer::triangle, AmtCoding::outward, {.since = 3}),
};
inline constexpr std::array kSourceRows = {
    ofMt<SurfaceModel, &MtArrays::vertices, &VertexArrays::places32>(
        amt_tag::kPlaces, AmtPer::vertex, AmtCoding::delta,
        {.since = 3, .flags = kAmtRequired, .when = hasFloats}),
    ofMt<SurfaceModel, &MtArrays::vertices, &VertexArrays::places64>(
        amt_tag::kPlaces, AmtPer::vertex, AmtCoding::delta,
        {.since = 3, .flags = kAmtRequired, .when = hasDoubles}),
    ofModel<SurfaceModel, &SurfaceModel::vertexOf>(amt_tag::kVertexNumbers, AmtPer::vertex,
                                                   AmtCoding::numbers, {.since = 3}),
    ofModel<SurfaceModel, &SurfaceModel::faceOf>(amt_tag::kFaceNumbers, AmtPer::triangle, AmtCoding::numbers,
                                                 {.since = 3, .when = hasAllFaces}),
    made<SurfaceModel, std::uint32_t>(amt_tag::kFaceNumbers, AmtPer::finestTriangle, AmtCoding::numbers,
                                      {.since = 3, .when = hasFinestFaces}),
    ofModel<SurfaceModel, &SurfaceModel::wedgesOf>(amt_tag::kWedges, AmtPer::triangle, AmtCoding::numbers,
                                                   {.since = 3, .when = hasWedges}),
    ofModel<SurfaceModel, &SurfaceModel::displacement, &SurfaceDisplacement::directions>(
        amt_tag::kDirections, AmtPer::vertex, AmtCoding::displacement, {.since = 3, .when = hasDisplacement}),
    ofModel<SurfaceModel, &SurfaceModel::displacement, &SurfaceDisplacement::reaches>(
        amt_tag::kReaches, AmtPer::triangle, AmtCoding::displacement, {.since = 3, .when = hasDisplacement}),
};
inline constexpr std::array kLookRows = {
    made<SurfaceModel, std::byte>(amt_tag::kPackedNumbers, AmtPer::any, AmtCoding::packed,
                                  {.since = 3, .flags = kAmtRequired}),
    made<SurfaceModel, std::byte>(amt_tag::kPackedDisplacement, AmtPer::any, AmtCoding::packed,
                                  {.need = AmtNeed::whereFound, .since = 3}),
    made<SurfaceModel, std::byte>(amt_tag::kLooks, AmtPer::any, AmtCoding::raw, {.since = 3}),
    made<SurfaceModel, std::byte>(amt_tag::kAttributes, AmtPer::any, AmtCoding::raw, {.since = 3}),
    made<SurfaceModel, std::byte>(amt_tag::kPictures, AmtPer::any, AmtCoding::raw, {.since = 3}),
    made<SurfaceModel, std::uint16_t>(amt_tag::kAttributeErrors, AmtPer::any, AmtCoding::raw,
                                      {.need = AmtNeed::whereFound, .since = 3}),
    ofModel<SurfaceModel, &SurfaceModel::leftOutFaces>(amt_tag::kLeftOutFaces, AmtPer::any, AmtCoding::raw,
                                                       {.need = AmtNeed::whereFound, .since = 3}),
};

/// One after the other.
template <class Row, std::size_t... kSizes>
constexpr auto joined(const std::array<Row, kSizes>&... parts) {
  std::array<Row, (kSizes + ...)> all{};
  auto to = all.begin();
  ((to = std::copy(parts.begin(), parts.end(), to)), ...);
  return all;
}

}  // namespace amt_rows

/// The columns of a kind of model.
template <class Model>
inline constexpr std::array<AmtRow<Model>, 0> kAmtSchema{};
template <>
inline constexpr auto kAmtSchema<TerrainModel> = amt_rows::joined(
    amt_rows::kTopologyRows<TerrainModel>, amt_rows::kBoundRows, amt_rows::kNodeRows<TerrainModel>,
    amt_rows::kPlanRows, amt_rows::kPackedRows<TerrainModel>, amt_rows::kSampleRows,
    amt_rows::kPageRows<TerrainModel>, amt_rows::kSegmentRows<TerrainModel>);
template <>
inline constexpr auto kAmtSchema<SurfaceModel> = amt_rows::joined(
    amt_rows::kTopologyRows<SurfaceModel>, amt_rows::kRmsRows, amt_rows::kNodeRows<SurfaceModel>,
    amt_rows::kSourceRows, amt_rows::kPackedRows<SurfaceModel>, amt_rows::kLookRows,
    amt_rows::kPageRows<SurfaceModel>, amt_rows::kSegmentRows<SurfaceModel>);

/// The nodes of a packed file are in another order, so that no column of the MT is as in a plain one.
template <class Model>
inline constexpr bool kIsPackable = std::ranges::none_of(kAmtSchema<Model>, [](const AmtRow<Model>& row) {
  return row.mt && row.coding == AmtCoding::raw;
});
static_assert(kIsPackable<TerrainModel> && kIsPackable<SurfaceModel>);

/// The version of a file of such facts: the first one that has all of its columns.
template <class Model>
std::uint32_t amtVersionOf(const AmtFacts& facts) {
  std::uint32_t version = kAmtVersion;
  for (const AmtRow<Model>& row : kAmtSchema<Model>)
    if (row.isIn(facts)) version = std::max(version, row.since);
  return version;
}

/// The arrays of a multitriangulation, of either kind, as columns that copies and checks walk over.
struct AmtMtColumn : AmtColumn {
  AmtPlaceIn<MtArrays> mt;
};
/// Those that the MT of such a file has, in its order; those that an MT in memory has, of which the ones that
/// a file need not have are left out where they are empty. O(rows).
std::vector<AmtMtColumn> amtMtColumns(const AmtFacts& facts);
std::vector<AmtMtColumn> amtMtColumns(const MtArrays& arrays);

/// The shapes of the chunks that a file of such facts has, in their order; chunks of any number of bytes are
/// left out.
template <class Model>
std::vector<AmtShape> amtShapes(const AmtFacts& facts) {
  std::vector<AmtShape> shapes;
  for (const AmtRow<Model>& row : kAmtSchema<Model>)
    if (row.per != AmtPer::any && row.isIn(facts)) shapes.push_back(amtShapeOf(row, facts, 0));
  return shapes;
}

/// A column of this tag, of any kind; null where this program knows none.
const AmtColumn* findAmtColumn(const AmtTag& tag);

}  // namespace arete
