// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/remote/directory_info.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "cli/arguments/columns_json.h"
#include "engine/base/counted.h"
#include "io/files/text/grouped.h"
#include "io/geo/crs/names.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"

namespace arete {
namespace {

/// A head and a table of facts.
class FactLines {
 public:
  FactLines(const AmtContainer& file, const char* kind)
      : text_(fmt::format("{}: {}, {}{}\n", file.path(), byteCount(file.bytes().size()), kind,
                          file.isPacked() ? ", packed" : "")) {}
  void add(const char* what, const std::string& value) {
    if (!value.empty()) text_ += fmt::format("  {:<14} {}\n", what, value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// What a model of either kind has. Each node of a multitriangulation replaces its floor by two triangles
/// more, or by one at a border, which the nodes alone tell.
Json commonFacts(const AmtContainer& file, const AmtHead& head, const std::string& source,
                 const std::string& crsWkt, FactLines& lines) {
  const AmtCounts& n = head.counts;
  const std::uint64_t vertices = n.rootVertices + n.nodes, finest = n.rootTriangles + 2 * n.nodes;
  lines.add("written by", head.writer);
  lines.add("source", source);
  if (!crsWkt.empty()) lines.add("CRS", crsName(crsWkt));
  lines.add("vertices", grouped(vertices));
  lines.add("triangles", fmt::format("at most {} at the finest", grouped(finest)));
  lines.add("root", fmt::format("{}, {}", grouped(n.rootTriangles, "triangle", "triangles"),
                                grouped(n.rootVertices, "vertex", "vertices")));
  return {{"file", file.path()},
          {"bytes", file.bytes().size()},
          {"isPacked", file.isPacked()},
          {"writer", head.writer},
          {"crs", crsName(crsWkt)},
          {"crsWkt", crsWkt},
          {"vertices", vertices},
          {"triangles", nullptr},
          {"finestTriangles", nullptr},
          {"rootTriangles", n.rootTriangles},
          {"rootVertices", n.rootVertices},
          {"rootError", nullptr},
          {"curve", nullptr}};
}

Result<Json> terrainFacts(const AmtContainer& file, std::string& text) {
  const Result<AmtMetadata> read = fromAmtJson(file.metadata());
  if (!read) return file.corrupt(fmt::format("chunk META: {}", read.error().message));
  const TerrainModel& model = read->model;
  const Georeference& g = model.georeference;
  FactLines lines(file, "terrain");
  Json facts = commonFacts(file, *read, model.source, g.crsWkt, lines);
  if (model.isRaster)
    lines.add("grid", fmt::format("{} columns x {} rows", grouped(model.columns), grouped(model.rows)));
  lines.add("heights", g.verticalUnit);
  const std::uint64_t isolated = read->counts.isolated;
  facts["source"] = {{"path", model.source}, {"checksum", model.sourceChecksum}};
  facts["kind"] = model.isRaster ? "raster" : "points";
  facts["grid"] = nullptr;
  if (model.isRaster)
    facts["grid"] = {{"columns", model.columns},
                     {"rows", model.rows},
                     {"geoTransform", g.hasGeoTransform ? Json(g.geoTransform) : Json()}};
  facts["verticalUnit"] = g.verticalUnit;
  facts["verticalDatum"] = g.verticalDatum;
  facts["relief"] = nullptr;
  facts["isolated"] = isolated;
  facts["samples"] = facts["vertices"].get<std::uint64_t>() + isolated;
  facts["fixedVertices"] = read->counts.fixedVertices;
  facts["levels"] = model.levels;
  text = lines.text();
  return facts;
}

Result<Json> surfaceFacts(const AmtContainer& file, std::string& text) {
  const Result<SurfaceMetadata> read = fromSurfaceJson(file.metadata());
  if (!read) return file.corrupt(fmt::format("chunk META: {}", read.error().message));
  const SurfaceModel& model = read->model;
  FactLines lines(file, "a surface");
  Json facts = commonFacts(file, *read, model.source, model.crsWkt, lines);
  lines.add("diagonal", fmt::format("{:.9g}", model.diagonal));
  facts["kind"] = "surface";
  facts["source"] = model.source;
  facts["diagonal"] = model.diagonal;
  facts["sourceFaces"] = model.fileFaces;
  facts["sourceVertices"] = model.sourceVertices;
  facts["finestTriangles"] = read->finestTriangles;
  facts["levels"] = model.levels;
  text = lines.text();
  return facts;
}

}  // namespace

Status sayOfDirectory(const AmtContainer& file, Session& session) {
  std::string text;
  ARETE_TRY(Json facts, file.isOfSurface() ? surfaceFacts(file, text) : terrainFacts(file, text));
  ARETE_TRY(facts["columns"], columnsJson(file));
  session.say(text);
  session.note(
      fmt::format("the curve of triangles against error needs the whole file, {}: --curve 12 fetches it",
                  byteCount(file.bytes().size())));
  session.answer(facts);
  return {};
}

}  // namespace arete
