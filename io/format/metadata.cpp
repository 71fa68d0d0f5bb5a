// SPDX-License-Identifier: GPL-3.0-or-later
//
// One function per direction, in the same order of fields. Doubles are written with the fewest digits that
// read back to the same double (nlohmann-json does both), negative zeros included. Reading collects the first
// problem and goes on with defaults, so that no field needs a test of its own.
#include "io/format/metadata.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "engine/mt/hole_limit.h"
#include "engine/mt/node_blocks.h"
#include "terrain/build/checks.h"

namespace arete {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uint64_t kMaxCount = 0xFFFFFFFEu;  // 0xFFFFFFFF names nothing
constexpr std::uint32_t kMaxMetricTerm = 1u << 16;
constexpr const char* kHex = "hex";

struct TypeName {
  HeightEncoding::Type type;
  const char* name;
  AmtScalar scalar;
};
constexpr TypeName kTypes[] = {{HeightEncoding::Type::int16, "int16", AmtScalar::i16},
                               {HeightEncoding::Type::float32, "float32", AmtScalar::f32},
                               {HeightEncoding::Type::float64, "float64", AmtScalar::f64}};

const TypeName& nameOf(HeightEncoding::Type type) {
  for (const TypeName& t : kTypes)
    if (t.type == type) return t;
  return kTypes[2];
}

ordered_json exactText(const std::string& text) {
  try {
    static_cast<void>(json(text).dump());
    return text;
  } catch (const json::type_error&) {
    std::string hex;
    for (const char c : text) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
    return ordered_json{{kHex, hex}};
  }
}

std::optional<std::string> fromHex(const std::string& hex) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (hex.size() % 2 != 0) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const int high = digit(hex[i]), low = digit(hex[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    text += static_cast<char>(high * 16 + low);
  }
  return text;
}

/// Only what was told. An infinity, which JSON cannot say, is not.
ordered_json readingJson(const SourceReading& reading) {
  ordered_json j = ordered_json::object();
  if (reading.band) j["band"] = *reading.band;
  for (const auto& [key, text] :
       {std::pair{"layer", &reading.layer}, {"zField", &reading.zField}, {"crs", &reading.crs}})
    if (!text->empty()) j[key] = exactText(*text);
  if (reading.nodata && std::isfinite(*reading.nodata)) j["nodata"] = *reading.nodata;
  return j;
}

ordered_json triple(const Vec3& v) {
  return ordered_json::array({v.x, v.y, v.z});
}

/// The fields of one JSON object. The first problem of all objects is kept in `problem`.
class Fields {
 public:
  Fields(const json& object, std::string prefix, std::string& problem)
      : object_(object), prefix_(std::move(prefix)), problem_(problem) {}

  Fields child(const char* key) const {
    const json* field = find(key, "an object", [](const json& j) { return j.is_object(); });
    static const json empty = json::object();
    return {field != nullptr ? *field : empty, prefix_ + key + ".", problem_};
  }
  bool has(const char* key) const { return object_.contains(key); }
  void read(const char* key, bool& to) const {
    if (const json* field = find(key, "true or false", [](const json& j) { return j.is_boolean(); }))
      to = field->get<bool>();
  }
  void read(const char* key, double& to) const {
    if (const json* field = find(key, "a number", [](const json& j) { return j.is_number(); }))
      to = field->get<double>();
  }
  void read(const char* key, std::uint64_t& to) const {
    if (const json* field = find(key, "a whole number", [](const json& j) { return j.is_number_unsigned(); }))
      to = field->get<std::uint64_t>();
  }
  void read(const char* key, std::uint32_t& to) const {
    std::uint64_t wide = to;
    read(key, wide);
    if (wide > 0xFFFFFFFFu)
      note(fmt::format("{}{} is {}, beyond 32 bits", prefix_, key, wide));
    else
      to = static_cast<std::uint32_t>(wide);
  }
  void read(const char* key, std::string& to) const {
    const auto isText = [](const json& j) {
      return j.is_string() || (j.is_object() && j.contains(kHex) && j[kHex].is_string());
    };
    const json* field = find(key, "a text", isText);
    if (field == nullptr) return;
    if (field->is_string()) {
      to = field->get<std::string>();
    } else if (std::optional<std::string> text = fromHex((*field)[kHex].get<std::string>())) {
      to = std::move(*text);
    } else {
      note(fmt::format("{}{} is no hexadecimal text", prefix_, key));
    }
  }
  void read(const char* key, std::span<double> to) const {
    const auto isRow = [&](const json& j) {
      if (!j.is_array() || j.size() != to.size()) return false;
      for (const json& number : j)
        if (!number.is_number()) return false;
      return true;
    };
    const json* field = find(key, fmt::format("an array of {} numbers", to.size()), isRow);
    if (field == nullptr) return;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = (*field)[i].get<double>();
  }
  void read(const char* key, Vec3& to) const {
    std::array<double, 3> row{};
    read(key, row);
    to = {row[0], row[1], row[2]};
  }
  void note(std::string problem) const {
    if (problem_.empty()) problem_ = std::move(problem);
  }

 private:
  template <class IsRight>
  const json* find(const char* key, std::string_view what, const IsRight& isRight) const {
    const auto field = object_.find(key);
    if (field == object_.end()) {
      note(fmt::format("{}{} is missing", prefix_, key));
      return nullptr;
    }
    if (!isRight(*field)) {
      note(fmt::format("{}{} is not {}", prefix_, key, what));
      return nullptr;
    }
    return &*field;
  }

  const json& object_;
  std::string prefix_;
  std::string& problem_;
};

/// All of it may be missing: earlier writers did not say it.
SourceReading readingOf(const Fields& top) {
  SourceReading reading;
  if (!top.has("reading")) return reading;
  const Fields fields = top.child("reading");
  if (fields.has("band")) fields.read("band", reading.band.emplace(0));
  for (const auto& [key, text] :
       {std::pair{"layer", &reading.layer}, {"zField", &reading.zField}, {"crs", &reading.crs}})
    if (fields.has(key)) fields.read(key, *text);
  if (fields.has("nodata")) fields.read("nodata", reading.nodata.emplace(0));
  return reading;
}

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
        std::pair{"semi-major axis", g.semiMajorAxisMetres},
        std::pair{"vertical unit", g.verticalUnitMetres}})
    if (!(value > 0 && std::isfinite(value)))
      return fmt::format("the {} is {}, not a positive number", what, value);
  if (!(g.inverseFlattening == 0 || (g.inverseFlattening > 1 && std::isfinite(g.inverseFlattening))))
    return fmt::format("the inverse flattening is {}, which no ellipsoid has", g.inverseFlattening);
  // A greater base would decode its largest code to more than the largest float.
  constexpr std::uint32_t kMaxBase = (0x7F800000u >> 12) - 1 - OutwardScale::kMaxCode;
  if (m.scale.base() > kMaxBase)
    return fmt::format("the error scale's base is {}, more than {}", m.scale.base(), kMaxBase);
  for (const std::uint32_t term : {m.model.metricP, m.model.metricQ})
    if (term < 1 || term > kMaxMetricTerm)
      return fmt::format("the Delaunay metric has the term {}, not 1 to {}", term, kMaxMetricTerm);
  return std::nullopt;
}

}  // namespace

AmtMetadata amtMetadataOf(const TerrainModel& model, std::string writer) {
  const MtArrays& a = model.mt.arrays();
  AmtMetadata m;
  m.writer = std::move(writer);
  m.counts = {a.rootVertices, a.rootTriangles.size(), a.saturatedError.size(),
              a.link.size(),  model.isolated.size(),  model.options.fixedVertices.size()};
  m.model.georeference = model.georeference;
  m.model.isRaster = model.isRaster;
  m.model.columns = model.columns;
  m.model.rows = model.rows;
  m.model.source = model.source;
  m.model.sourceChecksum = model.sourceChecksum;
  m.model.reading = model.reading;
  m.model.options = model.options;
  m.model.options.fixedVertices.clear();
  m.model.metricP = model.metricP;
  m.model.metricQ = model.metricQ;
  m.model.levels = model.levels;
  m.encoding = a.vertices.encoding;
  m.scale = a.scale;
  m.metric = a.metric;
  return m;
}

std::optional<std::string> findAmtProblem(const AmtMetadata& m) {
  if (auto problem = findCountProblem(m.counts)) return problem;
  const TerrainModel& model = m.model;
  const std::uint64_t samples = std::uint64_t{model.columns} * model.rows;
  if (model.isRaster) {
    if (samples == 0 || samples > 0xFFFFFFFFu)
      return fmt::format("a grid of {} columns and {} rows cannot be", model.columns, model.rows);
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

std::string toAmtJson(const AmtMetadata& m) {
  const Georeference& g = m.model.georeference;
  const BuildOptions& o = m.model.options;
  ordered_json j = {
      {"writer", exactText(m.writer)},
      {"source", exactText(m.model.source)},
      {"sourceChecksum", exactText(m.model.sourceChecksum)},
      {"isRaster", m.model.isRaster},
      {"columns", m.model.columns},
      {"rows", m.model.rows},
      {"counts",
       {{"rootVertices", m.counts.rootVertices},
        {"rootTriangles", m.counts.rootTriangles},
        {"nodes", m.counts.nodes},
        {"slots", m.counts.slots},
        {"isolated", m.counts.isolated},
        {"fixedVertices", m.counts.fixedVertices}}},
      {"heights",
       {{"type", nameOf(m.encoding.type).name}, {"scale", m.encoding.scale}, {"offset", m.encoding.offset}}},
      {"errorScaleBase", m.scale.base()},
      {"metricFrame", {{"origin", triple(m.metric.origin)}, {"scale", triple(m.metric.scale)}}},
      {"georeference",
       {{"geoTransform", g.geoTransform},
        {"hasGeoTransform", g.hasGeoTransform},
        {"crsWkt", exactText(g.crsWkt)},
        {"isGeographic", g.isGeographic},
        {"angularUnitRadians", g.angularUnitRadians},
        {"linearUnitMetres", g.linearUnitMetres},
        {"semiMajorAxisMetres", g.semiMajorAxisMetres},
        {"inverseFlattening", g.inverseFlattening},
        {"verticalUnit", exactText(g.verticalUnit)},
        {"verticalUnitMetres", g.verticalUnitMetres},
        {"verticalDatum", exactText(g.verticalDatum)}}},
      {"build",
       {{"shape", toString(o.shape)},
        {"maxDegree", o.maxDegree},
        {"thresholdRatio", o.thresholdRatioOrDefault()},
        {"minimumAspect", o.minimumAspect},
        {"rimTolerance", o.rimTolerance},
        {"metricP", m.model.metricP},
        {"metricQ", m.model.metricQ},
        {"levels", m.model.levels}}}};
  if (ordered_json reading = readingJson(m.model.reading); !reading.empty())
    j["reading"] = std::move(reading);
  return j.dump(1) + "\n";
}

Result<AmtMetadata> fromAmtJson(std::string_view text) {
  const json j = json::parse(text, nullptr, false);
  if (!j.is_object()) return failure(ErrorCode::corrupt, "the metadata is no JSON object");
  AmtMetadata m;
  std::string problem;
  const Fields top(j, "", problem);
  top.read("writer", m.writer);
  top.read("source", m.model.source);
  top.read("sourceChecksum", m.model.sourceChecksum);
  m.model.reading = readingOf(top);
  top.read("isRaster", m.model.isRaster);
  top.read("columns", m.model.columns);
  top.read("rows", m.model.rows);

  const Fields counts = top.child("counts");
  counts.read("rootVertices", m.counts.rootVertices);
  counts.read("rootTriangles", m.counts.rootTriangles);
  counts.read("nodes", m.counts.nodes);
  counts.read("slots", m.counts.slots);
  counts.read("isolated", m.counts.isolated);
  counts.read("fixedVertices", m.counts.fixedVertices);

  const Fields heights = top.child("heights");
  std::string type;
  heights.read("type", type);
  bool isKnownType = false;
  for (const TypeName& t : kTypes)
    if (type == t.name) {
      m.encoding.type = t.type;
      isKnownType = true;
    }
  if (!isKnownType) heights.note("heights.type is not int16, float32 or float64");
  heights.read("scale", m.encoding.scale);
  heights.read("offset", m.encoding.offset);

  std::uint32_t base = 0;
  top.read("errorScaleBase", base);
  m.scale = OutwardScale::fromBase(base);
  const Fields metric = top.child("metricFrame");
  metric.read("origin", m.metric.origin);
  metric.read("scale", m.metric.scale);

  Georeference& g = m.model.georeference;
  const Fields georeference = top.child("georeference");
  georeference.read("geoTransform", g.geoTransform);
  georeference.read("hasGeoTransform", g.hasGeoTransform);
  georeference.read("crsWkt", g.crsWkt);
  georeference.read("isGeographic", g.isGeographic);
  georeference.read("angularUnitRadians", g.angularUnitRadians);
  georeference.read("linearUnitMetres", g.linearUnitMetres);
  georeference.read("semiMajorAxisMetres", g.semiMajorAxisMetres);
  georeference.read("inverseFlattening", g.inverseFlattening);
  georeference.read("verticalUnit", g.verticalUnit);
  georeference.read("verticalUnitMetres", g.verticalUnitMetres);
  georeference.read("verticalDatum", g.verticalDatum);

  BuildOptions& o = m.model.options;
  const Fields build = top.child("build");
  std::string shape;
  build.read("shape", shape);
  o.shape = shape == toString(HoleShape::dataDependent) ? HoleShape::dataDependent : HoleShape::delaunay;
  if (shape != toString(o.shape)) build.note("build.shape is not delaunay or fidelity");
  build.read("maxDegree", o.maxDegree);
  build.read("thresholdRatio", o.thresholdRatio.emplace());
  build.read("minimumAspect", o.minimumAspect);
  build.read("rimTolerance", o.rimTolerance);
  build.read("metricP", m.model.metricP);
  build.read("metricQ", m.model.metricQ);
  build.read("levels", m.model.levels);

  if (problem.empty()) problem = findAmtProblem(m).value_or("");
  if (!problem.empty()) return failure(ErrorCode::corrupt, fmt::format("the metadata is wrong: {}", problem));
  return m;
}

std::vector<AmtShape> amtShapes(const AmtMetadata& m, bool isPacked) {
  const AmtCounts& c = m.counts;
  const std::uint64_t triangles = c.rootTriangles + c.slots, vertices = c.rootVertices + c.nodes;
  constexpr std::uint64_t kSlotsPerHint = MultiTriangulation::kSlotsPerHint;
  std::vector<AmtShape> extras = {
      {amt_tag::kIsolatedSamples, AmtScalar::u32, 4, c.isolated},
      {amt_tag::kIsolatedHeights, AmtScalar::f64, 8, c.isolated},
      {amt_tag::kFixedVertices, AmtScalar::u32, 4, c.fixedVertices},
  };
  if (isPacked) return extras;
  std::vector<AmtShape> shapes = {
      {amt_tag::kRootTriangles, AmtScalar::u32, 12, c.rootTriangles},
      {amt_tag::kSlotBegin, AmtScalar::u32, 4, c.nodes + 1},
      {amt_tag::kLink, AmtScalar::u32, 4, c.slots},
      {amt_tag::kRemover, AmtScalar::u32, 4, triangles},
      {amt_tag::kError, AmtScalar::u16, 2, triangles},
      {amt_tag::kBelow, AmtScalar::u16, 2, triangles},
      {amt_tag::kAbove, AmtScalar::u16, 2, triangles},
      {amt_tag::kFloor, AmtScalar::u32, 4, c.slots - 2 * c.nodes},
      {amt_tag::kSaturatedError, AmtScalar::u16, 2, c.nodes},
      {amt_tag::kSphere, AmtScalar::f32, 16, c.nodes},
      {amt_tag::kBlockError, AmtScalar::u16, 2, nodeBlockAndPageCount(c.nodes)},
      {amt_tag::kBlockSphere, AmtScalar::f32, 16, nodeBlockAndPageCount(c.nodes)},
      {amt_tag::kCreatorHint, AmtScalar::u32, 4, (c.slots + kSlotsPerHint - 1) / kSlotsPerHint},
      m.model.isRaster ? AmtShape{amt_tag::kSamples, AmtScalar::u32, 4, vertices}
                       : AmtShape{amt_tag::kPlan, AmtScalar::f64, 16, vertices},
      {amt_tag::kHeights, nameOf(m.encoding.type).scalar,
       static_cast<std::uint32_t>(m.encoding.bytesPerHeight()), vertices},
  };
  shapes.insert(shapes.end(), extras.begin(), extras.end());
  return shapes;
}

}  // namespace arete
