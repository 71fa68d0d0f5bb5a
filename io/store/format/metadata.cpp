// SPDX-License-Identifier: GPL-3.0-or-later
//
// visitMetadata() declares the fields once; a writer and a reader visit them (io/store/format/json_fields.h).
// Doubles are written with the fewest digits that read back to the same double (nlohmann-json does both),
// negative zeros included.
#include "io/store/format/metadata.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/mt/hole_limit.h"
#include "io/files/text/address_text.h"
#include "io/files/text/json_tree.h"
#include "io/store/format/json_fields.h"
#include "terrain/model/build_options.h"

namespace arete {
namespace {

using json_fields::Choice;

constexpr std::uint64_t kMaxCount = 0xFFFFFFFEu;  // 0xFFFFFFFF is the invalid id
constexpr std::uint32_t kMaxMetricTerm = 1u << 16;

constexpr std::array<Choice<HeightEncoding::Type>, 3> kHeightTypes = {
    {{HeightEncoding::Type::int16, "int16"},
     {HeightEncoding::Type::float32, "float32"},
     {HeightEncoding::Type::float64, "float64"}}};

/// Values that the file holds and a model has no member for.
struct Stored {
  std::uint32_t scaleBase = 0;
  double thresholdRatio = 0;
  std::string nodataWord = {};  ///< a stated NODATA value that JSON has no number for: nan, inf or -inf
  StoredSummary summary = {};
};

/// Visits the fields of the metadata, in the order of the file.
template <class Visitor, class Metadata, class OtherValues>
void visitMetadata(Visitor& top, Metadata& m, OtherValues& stored) {
  auto& model = m.model;
  visitSourceFields(top, m);
  top.field("isRaster", model.isRaster);
  top.field("columns", model.columns);
  top.field("rows", model.rows);
  top.object("counts", [&](auto& counts) {
    visitMtCounts(counts, m.counts);
    counts.field("isolated", m.counts.isolated);
    counts.field("fixedVertices", m.counts.fixedVertices);
  });
  top.object("heights", [&](auto& heights) {
    heights.choice("type", m.encoding.type, kHeightTypes);
    heights.field("scale", m.encoding.scale);
    heights.field("offset", m.encoding.offset);
  });
  visitFrameFields(top, m, stored.scaleBase);
  top.object("georeference", [&](auto& georeference) {
    auto& g = model.georeference;
    georeference.field("geoTransform", g.geoTransform);
    georeference.field("hasGeoTransform", g.hasGeoTransform);
    georeference.flag("repeatsFirstColumn", g.repeatsFirstColumn);
    georeference.field("crsWkt", g.crsWkt);
    georeference.field("isGeographic", g.isGeographic);
    georeference.field("angularUnitRadians", g.angularUnitRadians);
    georeference.field("linearUnitMetres", g.linearUnitMetres);
    georeference.optional("mapScale", g.mapScale);
    georeference.field("semiMajorAxisMetres", g.semiMajorAxisMetres);
    georeference.field("inverseFlattening", g.inverseFlattening);
    georeference.field("verticalUnit", g.verticalUnit);
    georeference.field("verticalUnitMetres", g.verticalUnitMetres);
    georeference.field("verticalDatum", g.verticalDatum);
  });
  top.object("build", [&](auto& build) {
    const std::array<Choice<HoleShape>, 2> shapes = {
        {{HoleShape::delaunay, toString(HoleShape::delaunay)},
         {HoleShape::dataDependent, toString(HoleShape::dataDependent)}}};
    auto& o = model.options;
    build.choice("shape", o.shape, shapes);
    build.field("maxDegree", o.maxDegree);
    build.field("thresholdRatio", stored.thresholdRatio);
    build.field("minimumAspect", o.minimumAspect);
    build.field("rimTolerance", o.rimTolerance);
    build.field("metricP", model.metricP);
    build.field("metricQ", model.metricQ);
    build.field("levels", model.levels);
  });
  visitSummary(top, m.summary, stored.summary);
  // Absent from the files of earlier writers.
  top.optionalObject("reading", [&](auto& reading) {
    auto& r = model.reading;
    reading.optional("band", r.band);
    reading.optional("layer", r.layer);
    reading.optional("zField", r.zField);
    reading.optional("samePlace", r.samePlace);
    reading.optional("crs", r.crs);
    reading.optional("nodata", r.nodata);
    reading.optional("nodataWord", stored.nodataWord);
    reading.optional("verticalUnit", r.verticalUnit);
    reading.optional("isDepth", r.isDepth);
    reading.optional("otherFiles", r.otherFiles);
  });
}

std::optional<std::string> findNumberProblem(const AmtMetadata& m) {
  const Georeference& g = m.model.georeference;
  const auto ofFinite = [](const char* what,
                           std::initializer_list<double> values) -> std::optional<std::string> {
    for (const double value : values)
      if (!std::isfinite(value)) return fmt::format("the {} holds {}, which is not finite", what, value);
    return std::nullopt;
  };
  const auto& t = g.geoTransform;
  if (auto problem = ofFinite("geotransform", {t[0], t[1], t[2], t[3], t[4], t[5]})) return problem;
  if (auto problem = ofFinite("height encoding", {m.encoding.scale, m.encoding.offset})) return problem;
  const Vec3 &o = m.metric.origin, &s = m.metric.scale;
  if (auto problem = ofFinite("metric frame", {o.x, o.y, o.z, s.x, s.y, s.z})) return problem;
  if (s.x < 0 || s.y < 0 || s.z < 0) return "the metric frame has a negative scale";
  for (const auto& [what, value] :
       {std::pair{"angular unit", g.angularUnitRadians}, std::pair{"linear unit", g.linearUnitMetres},
        std::pair{"semi-major axis", g.semiMajorAxisMetres}, std::pair{"vertical unit", g.verticalUnitMetres},
        std::pair{"scale of the map", g.mapScale ? (*g.mapScale)[0] : 1},
        std::pair{"scale of the map", g.mapScale ? (*g.mapScale)[1] : 1}})
    if (!(value > 0 && std::isfinite(value)))
      return fmt::format("the {} is {}, not a positive number", what, value);
  if (!(g.inverseFlattening == 0 || (g.inverseFlattening > 1 && std::isfinite(g.inverseFlattening))))
    return fmt::format("the inverse flattening is {}, which no ellipsoid has", g.inverseFlattening);
  if (auto problem = findScaleProblem(m.scale)) return problem;
  for (const std::uint32_t term : {m.model.metricP, m.model.metricQ})
    if (term < 1 || term > kMaxMetricTerm)
      return fmt::format("the Delaunay metric has the term {}, not 1 to {}", term, kMaxMetricTerm);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> findCountProblem(const AmtCounts& c) {
  const auto limit = [](const char* what, std::uint64_t count) -> std::optional<std::string> {
    if (count <= kMaxCount) return std::nullopt;
    return fmt::format("{} {} are more than 32-bit ids can name", count, what);
  };
  for (const auto& [what, count] :
       {std::pair{"root vertices", c.rootVertices}, std::pair{"root triangles", c.rootTriangles},
        std::pair{"nodes", c.nodes}, std::pair{"slots", c.slots}, std::pair{"isolated samples", c.isolated},
        std::pair{"fixed vertices", c.fixedVertices}})
    if (auto problem = limit(what, count)) return problem;
  // Sums and products of 32-bit counts do not overflow 64 bits.
  if (auto problem = limit("vertices", c.rootVertices + c.nodes)) return problem;
  if (auto problem = limit("triangles", c.rootTriangles + c.slots)) return problem;
  if (c.rootTriangles == 0 || c.rootVertices < 3) return "there is no root triangle";
  if (c.slots < 3 * c.nodes || c.slots > std::uint64_t{kMaxHoleCorners} * c.nodes)
    return fmt::format("{} slots do not make the stars of {} nodes, 3 to {} slots each", c.slots, c.nodes,
                       kMaxHoleCorners);
  return std::nullopt;
}

std::optional<std::string> findScaleProblem(const OutwardScale& scale) {
  // A greater base would decode its largest code to more than the largest float.
  constexpr std::uint32_t kMaxBase = (0x7F800000u >> 12) - 1 - OutwardScale::kMaxCode;
  if (scale.base() <= kMaxBase) return std::nullopt;
  return fmt::format("the error scale's base is {}, more than {}", scale.base(), kMaxBase);
}

/// Fixed vertices are a chunk of their own, so the options in the metadata are without them. The source is
/// named without the query of its address, which may hold what is secret.
AmtMetadata amtMetadataOf(const TerrainModel& model, std::string writer) {
  AmtMetadata m;
  static_cast<AmtHead&>(m) = amtHeadOf(model.mt, std::move(writer));
  m.encoding = model.mt.vertices().encoding;
  m.counts.isolated = model.isolated.size();
  m.counts.fixedVertices = model.options.fixedVertices.size();
  m.model.georeference = model.georeference;
  m.model.isRaster = model.isRaster;
  m.model.columns = model.columns;
  m.model.rows = model.rows;
  m.model.source = nameWithoutQuery(model.source);
  m.model.sourceChecksum = model.sourceChecksum;
  m.model.reading = model.reading;
  m.model.options = model.options;
  m.model.options.fixedVertices.clear();
  m.model.metricP = model.metricP;
  m.model.metricQ = model.metricQ;
  m.model.levels = model.levels;
  return m;
}

/// The numbers come from a file: later code relies on counts that fit 32 bits, on a grid that has the
/// vertices, and on a geotransform that can be inverted.
std::optional<std::string> findAmtProblem(const AmtMetadata& m) {
  if (auto problem = findCountProblem(m.counts)) return problem;
  const TerrainModel& model = m.model;
  const std::uint64_t samples = std::uint64_t{model.columns} * model.rows;
  if (model.isRaster) {
    if (samples == 0 || samples > 0xFFFFFFFFu)
      return fmt::format("a grid of {} columns and {} rows has no samples or too many", model.columns,
                         model.rows);
    if (m.counts.rootVertices + m.counts.nodes > samples || m.counts.isolated > samples)
      return fmt::format("{} vertices and {} isolated samples are more than the grid has",
                         m.counts.rootVertices + m.counts.nodes, m.counts.isolated);
    if (const double determinant = model.georeference.determinant();
        determinant == 0 || !std::isfinite(determinant))
      return "the geotransform is not invertible";
  } else if (samples != 0 || model.columns != 0 || model.rows != 0 || m.counts.isolated != 0) {
    return "scattered points come with a grid size or isolated samples";
  }
  if (auto problem = findNumberProblem(m)) return problem;
  if (const Status options = checkOptions(model.options, 0); !options)
    return fmt::format("the build options are wrong: {}", options.error().message);
  return std::nullopt;
}

// What JSON cannot hold as a number, such as a NODATA value of NaN, is stored as text.
std::string toAmtJson(const AmtMetadata& metadata) {
  JsonTree object(nlohmann::ordered_json::object());
  json_fields::Writer writer(*object);
  const std::optional<double> nodata = metadata.model.reading.nodata;
  Stored stored{metadata.scale.base(), metadata.model.options.thresholdRatioOrDefault(),
                nodata && !std::isfinite(*nodata) ? fmt::format("{}", *nodata) : "",
                StoredSummary::of(metadata.summary)};
  visitMetadata(writer, metadata, stored);
  return (*object).dump(1) + "\n";
}

Result<AmtMetadata> fromAmtJson(std::string_view text) {
  const JsonTree object(nlohmann::json::parse(text, nullptr, false));
  if (!(*object).is_object()) return failure(ErrorCode::corrupt, "the metadata is not a JSON object");
  AmtMetadata m;
  std::string problem;
  json_fields::Reader reader(*object, problem);
  Stored stored;
  visitMetadata(reader, m, stored);
  m.model.source = nameWithoutQuery(m.model.source);  // older files may have one
  m.scale = OutwardScale::fromBase(stored.scaleBase);
  m.model.options.thresholdRatio = stored.thresholdRatio;
  stored.summary.giveTo(m.summary);
  if (stored.nodataWord == "nan") m.model.reading.nodata = std::numeric_limits<double>::quiet_NaN();
  if (stored.nodataWord == "inf") m.model.reading.nodata = std::numeric_limits<double>::infinity();
  if (stored.nodataWord == "-inf") m.model.reading.nodata = -std::numeric_limits<double>::infinity();
  if (problem.empty()) problem = findAmtProblem(m).value_or("");
  if (!problem.empty()) return failure(ErrorCode::corrupt, fmt::format("the metadata is wrong: {}", problem));
  return m;
}

AmtFacts amtFactsOf(const AmtMetadata& metadata) {
  AmtFacts facts;
  facts.counts = metadata.counts;
  facts.isLattice = metadata.model.isRaster;
  facts.heights = metadata.encoding.type;
  return facts;
}

}  // namespace arete
