// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/surface_metadata.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/mt/hole_limit.h"
#include "io/files/text/address_text.h"
#include "io/files/text/json_tree.h"
#include "io/store/format/json_fields.h"

namespace arete {
namespace {

struct StoredSurface {
  std::uint32_t scaleBase = 0;
  std::optional<double> positionStep, positionError;
  std::optional<std::uint64_t> fileFaces, splitFaces, creaseEdges;
  StoredSummary summary = {};
};

template <class T>
std::optional<T> unlessZero(T x) {
  return x == 0 ? std::nullopt : std::optional(x);
}

/// What a file without the number of splits must have: what its finest front has more than the faces left.
std::uint64_t splitFacesOf(const SurfaceMetadata& m) {
  const SurfaceRepairs& mending = m.model.mending;
  const std::uint64_t leftOut = mending.duplicateFaces + mending.degenerateFaces,
                      kept = m.model.sourceFaces > leftOut ? m.model.sourceFaces - leftOut : 0;
  return m.finestTriangles > kept ? m.finestTriangles - kept : 0;
}

/// Visits the fields of the metadata, in the order of the file.
template <class Visitor, class Metadata, class OtherValues>
void visitSurfaceMetadata(Visitor& top, Metadata& m, OtherValues& stored) {
  auto& model = m.model;
  visitSourceFields(top, m);
  top.object("counts", [&](auto& counts) {
    visitMtCounts(counts, m.counts);
    counts.field("finestTriangles", m.finestTriangles);
    counts.field("wedges", m.wedges);
    counts.field("sourceVertices", model.sourceVertices);
    counts.field("sourceFaces", model.sourceFaces);
  });
  top.flag("hasDoubles", m.hasDoubles);
  top.flag("hasAllFaces", m.hasAllFaces);
  visitFrameFields(top, m, stored.scaleBase);
  top.optional("positionStep", stored.positionStep);
  top.optional("positionError", stored.positionError);
  top.optional("fileFaces", stored.fileFaces);
  top.field("diagonal", model.diagonal);
  top.flag("boundsLines", model.boundsLines);
  top.optional("crsWkt", model.crsWkt);
  top.optional("verticalUnit", model.verticalUnit);
  top.optional("up", model.up);
  top.object("build", [&](auto& build) {
    build.flag("keepsBorders", model.options.keepsBorders);
    build.field("maxDegree", model.options.maxDegree);
    build.field("thresholdRatio", model.options.thresholdRatio);
    build.field("levels", model.levels);
    build.flag("boundsAttributes", model.options.boundsAttributes);
    build.optional("creaseAngleDegrees", model.options.creaseAngleDegrees);
    build.optional("creaseEdges", stored.creaseEdges);
  });
  top.object("mending", [&](auto& mending) {
    mending.field("duplicateFaces", model.mending.duplicateFaces);
    mending.field("degenerateFaces", model.mending.degenerateFaces);
    mending.optional("splitFaces", stored.splitFaces);
    mending.field("joinedVertices", model.mending.joinedVertices);
    mending.field("turnedFaces", model.mending.turnedFaces);
    mending.field("addedVertices", model.mending.addedVertices);
    mending.field("unusedVertices", model.mending.unusedVertices);
    mending.flag("dropsFlatNormals", model.mending.dropsFlatNormals);
  });
  visitSummary(top, m.summary, stored.summary);
}

}  // namespace

SurfaceMetadata amtMetadataOf(const SurfaceModel& model, std::string writer) {
  SurfaceMetadata m;
  static_cast<AmtHead&>(m) = amtHeadOf(model.mt, std::move(writer));
  m.finestTriangles = model.mt.finestTriangleCount();
  m.wedges = model.attributes.wedgeCount;
  m.hasDoubles = !model.mt.vertices().places64.empty();
  m.hasAllFaces = model.hasFaceAttributes();
  SurfaceModel& to = m.model;
  to.sourceVertices = model.sourceVertices;
  to.sourceFaces = model.sourceFaces;
  to.fileFaces = model.fileFaces;
  to.diagonal = model.diagonal;
  to.mending = model.mending;
  to.options = model.options;
  to.levels = model.levels;
  to.creaseEdges = model.creaseEdges;
  to.positionError = model.positionError;
  to.boundsLines = model.boundsLines;
  to.source = nameWithoutQuery(model.source);
  to.sourceChecksum = model.sourceChecksum;
  to.crsWkt = model.crsWkt;
  to.verticalUnit = model.verticalUnit;
  to.up = model.up;
  return m;
}

std::optional<std::string> findAmtProblem(const SurfaceMetadata& m) {
  if (auto problem = findCountProblem(m.counts)) return problem;
  constexpr std::uint64_t kMost = 0xFFFFFFFE;
  if (m.wedges > kMost || m.model.sourceVertices > kMost || m.model.sourceFaces > kMost)
    return "wedges, vertices or faces are more than 32-bit numbers can name";
  // Sums and differences of these do not wrap around, so that no law holds by overflow.
  const SurfaceRepairs& mending = m.model.mending;
  for (const auto& [what, count] :
       {std::pair{"fileFaces", m.model.fileFaces}, std::pair{"duplicateFaces", mending.duplicateFaces},
        std::pair{"degenerateFaces", mending.degenerateFaces}, std::pair{"splitFaces", mending.splitFaces},
        std::pair{"joinedVertices", mending.joinedVertices}, std::pair{"turnedFaces", mending.turnedFaces},
        std::pair{"addedVertices", mending.addedVertices},
        std::pair{"unusedVertices", mending.unusedVertices}})
    if (count > kMost) return fmt::format("{} is {}, more than 32-bit numbers can name", what, count);
  // Each wedge is that of a corner.
  if (const std::uint64_t corners = 3 * (m.counts.rootTriangles + m.counts.slots); m.wedges > corners)
    return fmt::format("{} wedges are more than the {} corners of the triangles", m.wedges, corners);
  if (m.finestTriangles > m.counts.rootTriangles + m.counts.slots)
    return "the finest front has more triangles than there are";
  const Vec3 &o = m.metric.origin, &s = m.metric.scale;
  if (!isFinite(o) || !isFinite(s) || s.x < 0 || s.y < 0 || s.z < 0)
    return "the metric frame is not one of finite numbers";
  if (!(m.model.diagonal > 0 && std::isfinite(m.model.diagonal)))
    return fmt::format("the diagonal is {}, not a positive number", m.model.diagonal);
  int exponent = 0;
  if (m.positionStep != 0 && (!std::isnormal(m.positionStep) || std::frexp(m.positionStep, &exponent) != 0.5))
    return "the step of the positions is no power of two";
  if (!(m.model.positionError >= 0 && std::isfinite(m.model.positionError)))
    return "the error of the positions is not a distance";
  if (auto problem = findScaleProblem(m.scale)) return problem;
  if (m.model.options.maxDegree < 3 || m.model.options.maxDegree > kMaxHoleCorners - 1 ||
      !(m.model.options.thresholdRatio > 1))
    return "the build options are wrong";
  if (const auto& angle = m.model.options.creaseAngleDegrees; angle && !(*angle >= 0 && *angle <= 180))
    return fmt::format("the angle of creases is {}, not one of 0 to 180 degrees", *angle);
  return std::nullopt;
}

/// Numbers that older versions did not have are left out where they are zero, so that such a model's file is
/// as it was.
std::string toAmtJson(const SurfaceMetadata& metadata) {
  JsonTree object(nlohmann::ordered_json::object());
  json_fields::Writer writer(*object);
  const SurfaceModel& model = metadata.model;
  const StoredSurface stored{metadata.scale.base(),           unlessZero(metadata.positionStep),
                             unlessZero(model.positionError), model.fileFaces,
                             model.mending.splitFaces,        unlessZero(model.creaseEdges),
                             StoredSummary::of(metadata.summary)};
  visitSurfaceMetadata(writer, metadata, stored);
  return (*object).dump(1) + "\n";
}

/// A field that an older file lacks gets the value that it had by definition then.
Result<SurfaceMetadata> fromSurfaceJson(std::string_view text) {
  const JsonTree object(nlohmann::json::parse(text, nullptr, false));
  if (!(*object).is_object()) return failure(ErrorCode::corrupt, "the metadata is not a JSON object");
  SurfaceMetadata m;
  std::string problem;
  json_fields::Reader reader(*object, problem);
  StoredSurface stored;
  visitSurfaceMetadata(reader, m, stored);
  m.scale = OutwardScale::fromBase(stored.scaleBase);
  m.positionStep = stored.positionStep.value_or(0);
  m.model.positionError = stored.positionError.value_or(0);
  m.model.fileFaces = stored.fileFaces.value_or(m.model.sourceFaces);
  m.model.creaseEdges = stored.creaseEdges.value_or(0);
  stored.summary.giveTo(m.summary);
  m.model.mending.splitFaces = stored.splitFaces.value_or(splitFacesOf(m));
  if (problem.empty()) problem = findAmtProblem(m).value_or("");
  if (!problem.empty()) return failure(ErrorCode::corrupt, fmt::format("the metadata is wrong: {}", problem));
  return m;
}

AmtFacts amtFactsOf(const SurfaceMetadata& metadata) {
  AmtFacts facts;
  facts.kind = ModelKind::surface;
  facts.counts = metadata.counts;
  facts.hasDoubles = metadata.hasDoubles;
  facts.hasAllFaces = metadata.hasAllFaces;
  facts.hasWedges = metadata.wedges > 0;
  facts.finestTriangles = metadata.finestTriangles;
  return facts;
}

}  // namespace arete
