// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/columns_json.h"
#include "cli/mesh/tolerance.h"
#include "cli/surface/mending.h"
#include "engine/base/counted.h"
#include "engine/cut/error_curve.h"
#include "io/geo/crs/names.h"
#include "io/query/surface/surface_part.h"
#include "io/store/amt/surface_file.h"
#include "surface/attributes/attribute_names.h"

namespace arete {
namespace {

/// The errors that are stated, or round shares of the diagonal below that of the root, the largest of them.
Result<std::vector<double>> errorsOf(const std::string& at, std::size_t mostPoints,
                                     const SurfaceModel& model) {
  std::vector<double> errors;
  if (!at.empty()) {
    ARETE_TRY(const auto stated, parseSurfaceTolerances("--at", at, model.diagonal, spaceUnitOf(model)));
    for (const SurfaceTolerance& tolerance : stated) errors.push_back(tolerance.distance);
    return errors;
  }
  errors = sharesOfDiagonal(model);
  if (errors.size() > mostPoints) errors.erase(errors.begin(), errors.end() - std::ptrdiff_t(mostPoints));
  return errors;
}

/// What a file says of itself, or what is found of its model.
struct SaidOfSurface {
  SurfaceModel model;  ///< its root at least
  std::uint64_t vertices = 0;
  AmtSummary summary;
};

Result<SaidOfSurface> factsOf(const AmtContainer& file, const std::string& at, std::size_t mostPoints,
                              const RunContext& context) {
  ARETE_TRY(SurfaceFacts facts, surfaceFacts(file));
  SaidOfSurface said{{}, facts.vertices, std::move(facts.summary)};
  if (said.summary.isThere() && at.empty()) {
    ARETE_TRY(said.model, readOutline(file, context));
    auto& curve = said.summary.curve;
    if (curve.size() > mostPoints) curve.erase(curve.begin(), curve.end() - std::ptrdiff_t(mostPoints));
    return said;
  }
  ARETE_TRY(said.model, loadSurfaceAmt(file, {}, context));
  const MultiTriangulation& mt = said.model.mt;
  said.summary = {mt.triangleCount(), mt.finestTriangleCount(), 0, mt.largestError(), {}};
  ARETE_TRY(const std::vector<double> errors, errorsOf(at, mostPoints, said.model));
  ARETE_TRY(const std::vector<CurvePoint> curve, errorCurve(mt, errors, context));
  for (const CurvePoint& p : curve)
    said.summary.curve.push_back({p.maxError, double(p.minimalTriangles), double(p.saturatedTriangles)});
  return said;
}

}  // namespace

Status sayAboutSurface(const AmtContainer& file, const std::string& at, std::size_t mostPoints,
                       Session& session) {
  ARETE_TRY(const SaidOfSurface said, factsOf(file, at, mostPoints, session.context()));
  ARETE_TRY(Json columns, columnsJson(file));
  const SurfaceModel& model = said.model;
  const MultiTriangulation& mt = model.mt;
  const std::uint64_t bytes = file.bytes().size();
  const MeshAttributes& a = model.attributes;
  const bool isPacked = file.isPacked();
  std::string text =
      fmt::format("{}: {}, a surface{}\n", file.path(), byteCount(bytes), isPacked ? ", packed" : "");
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<14} {}\n", what, value);
  };
  line("source", fmt::format("{}, {}, {}", model.source, grouped(model.fileFaces, "face", "faces"),
                             grouped(model.sourceVertices, "vertex", "vertices")));
  if (!model.crsWkt.empty()) line("CRS", crsName(model.crsWkt));
  line("diagonal", fmt::format("{:.9g}", model.diagonal));
  line("places", mt.vertices().places64.empty() ? "float32" : "float64");
  if (model.positionError > 0)
    line("rounded", fmt::format("vertices moved by at most {}, which every error includes twice",
                                withShare(model.positionError, model.diagonal)));
  line("triangles", fmt::format("{} at the finest, {} in all", grouped(said.summary.finestTriangles),
                                grouped(said.summary.triangles)));
  line("root",
       fmt::format("{}, {}, error at most {}", grouped(mt.rootTriangleCount(), "triangle", "triangles"),
                   grouped(mt.rootVertexCount(), "vertex", "vertices"),
                   withShare(said.summary.rootError, model.diagonal)));
  if (!model.displacement.isEmpty()) line("displacement", "coarse cuts are drawn nearer to the source");
  // Older files do not bound lines, which is said only of models that may have any.
  if (model.boundsLines)
    line("lines", "seams and edges between parts, within the error of every cut");
  else if (model.mayHaveLines())
    line("lines", "not bounded: an earlier version built the file");
  if (const auto& angle = model.options.creaseAngleDegrees)
    line("creases", fmt::format("lines along {} of more than {} degrees",
                                grouped(model.creaseEdges, "edge", "edges"), *angle));
  line("levels", std::to_string(model.levels));
  text += mendedText(model.mending, fmt::format("  {:<14} ", "mended"));
  line("attributes", fmt::format("{} of vertices, {} of corners, {} of faces", a.vertexAttributes.size(),
                                 a.wedgeAttributes.size(), a.triangleAttributes.size()));
  std::vector<std::string> names, bounded;
  for (const NamedAttribute& one : namedAttributes(a))
    if (std::ranges::find(names, one.name) == names.end()) names.push_back(one.name);
  for (const AttributeErrors& errors : model.attributeErrors) bounded.push_back(errors.name);
  if (!names.empty()) line("names", fmt::format("{}", fmt::join(names, ", ")));
  if (!bounded.empty()) line("bounded", fmt::format("{}", fmt::join(bounded, ", ")));
  if (!a.objects.empty()) line("objects", grouped(a.objects.size()));
  if (!a.materials.empty())
    line("materials",
         fmt::format("{}, {} inside", a.materials.size(), counted(a.pictures.size(), "picture", "pictures")));
  text += fmt::format("\n  {:>12}  {:>9}  {:>13}  {:>13}\n", "error", "diagonal", "minimal", "saturated");
  Json points = Json::array();
  for (const auto& [error, minimalCount, saturatedCount] : said.summary.curve) {
    const auto minimal = static_cast<std::uint64_t>(minimalCount),
               saturated = static_cast<std::uint64_t>(saturatedCount);
    text += fmt::format("  {:>12.4g}  {:>7.3g} %  {:>13}  {:>13}\n", error, 100 * error / model.diagonal,
                        grouped(minimal), grouped(saturated));
    // JSON has no infinity, so an infinite error is null.
    points.push_back({{"maxError", std::isfinite(error) ? Json(error) : Json()},
                      {"maxErrorPercent", std::isfinite(error) ? Json(100 * error / model.diagonal) : Json()},
                      {"minimal", minimal},
                      {"saturated", saturated}});
  }
  session.say(text);
  session.answer({{"file", file.path()},
                  {"kind", "surface"},
                  {"bytes", bytes},
                  {"isPacked", isPacked},
                  {"positionError", model.positionError},
                  {"displacement", !model.displacement.isEmpty()},
                  {"boundsLines", model.boundsLines},
                  {"creaseAngleDegrees",
                   model.options.creaseAngleDegrees ? Json(*model.options.creaseAngleDegrees) : Json()},
                  {"creaseEdges", model.creaseEdges},
                  {"source", model.source},
                  {"crs", crsName(model.crsWkt)},
                  {"sourceFaces", model.fileFaces},
                  {"sourceVertices", model.sourceVertices},
                  {"diagonal", model.diagonal},
                  {"vertices", said.vertices},
                  {"triangles", said.summary.triangles},
                  {"finestTriangles", said.summary.finestTriangles},
                  {"rootTriangles", mt.rootTriangleCount()},
                  {"rootVertices", mt.rootVertexCount()},
                  {"rootError", said.summary.rootError},
                  {"levels", model.levels},
                  {"attributes", names},
                  {"boundedAttributes", bounded},
                  {"mended", mendedJson(model.mending)},
                  {"columns", std::move(columns)},
                  {"curve", std::move(points)}});
  return {};
}

}  // namespace arete
