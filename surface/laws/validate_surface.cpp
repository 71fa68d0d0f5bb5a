// SPDX-License-Identifier: GPL-3.0-or-later
//
// A front is examined by diagnose(), which knows nothing of multitriangulations. A component of a front has
// vertices of one component of the finest front, because every modification replaces triangles by others
// between the same vertices and one more.
#include "surface/laws/validate_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "engine/laws/validate.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/laws/errors_law.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

tl::unexpected<Error> broken(const std::string& what) {
  return failure(ErrorCode::brokenPromise, "law 5: " + what);
}

struct ExaminedFront {
  TriangleMesh mesh;
  MeshDiagnosis diagnosis;
};

/// The front as a mesh, an oriented manifold without double triangles.
Result<ExaminedFront> examine(const MultiTriangulation& mt, const Cut& cut, const RunContext& context) {
  ExaminedFront front;
  for (const std::uint32_t v : cut.vertices) front.mesh.positions.push_back(mt.position(VertexId(v)));
  front.mesh.triangles = cut.triangles;
  ARETE_TRY(MeshDiagnosis diagnosis, diagnose(front.mesh, {.selfIntersections = false}, context));
  front.diagnosis = std::move(diagnosis);
  const MeshDiagnosis& d = front.diagnosis;
  const auto refuse = [&](const MeshFindings& found, const char* what) {
    std::string vertices;
    for (const std::uint32_t v : found.places[0].elements)
      vertices += fmt::format(
          " {}", &found == &d.duplicateTriangles || &found == &d.doubleSided ? cut.ids[v] : cut.vertices[v]);
    return broken(fmt::format("a front of {} triangles has {} {}, the first at{}", cut.triangles.size(),
                              found.count, what, vertices));
  };
  if (d.nonManifoldEdges.count > 0) return refuse(d.nonManifoldEdges, "edges of more than two triangles");
  if (d.nonManifoldVertices.count > 0) return refuse(d.nonManifoldVertices, "vertices with several fans");
  if (d.turnedEdges.count > 0) return refuse(d.turnedEdges, "edges whose triangles turn against each other");
  if (d.duplicateTriangles.count > 0) return refuse(d.duplicateTriangles, "duplicate triangles");
  return front;
}

/// Law 8: every face that is not left out is there, as many times as it was split.
Status checkFaces(const SurfaceModel& model) {
  const MultiTriangulation& mt = model.mt;
  const SurfaceRepairs& m = model.mending;
  const std::uint64_t leftOut = m.duplicateFaces + m.degenerateFaces,
                      expected = model.sourceFaces + m.splitFaces - leftOut;
  if (mt.finestTriangleCount() != expected)
    return failure(
        ErrorCode::brokenPromise,
        fmt::format("law 8: the finest front has {} triangles; the source has {} faces, of which {} "
                    "are left out and {} are added by splits",
                    mt.finestTriangleCount(), model.sourceFaces, leftOut, m.splitFaces));
  std::vector<std::uint32_t> faces;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) faces.push_back(model.faceOf[t]);
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  if (faces.size() + leftOut >= model.sourceFaces) return {};
  return failure(
      ErrorCode::brokenPromise,
      fmt::format("law 8: the finest front has triangles of {} faces of {}, of which {} are left out",
                  faces.size(), model.sourceFaces, leftOut));
}

}  // namespace

// The finest front is examined once; every other front is compared with it.
Result<SurfaceTopology> SurfaceTopology::of(const MultiTriangulation& mt, const RunContext& context) {
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  ARETE_TRY(const ExaminedFront front, examine(mt, finest, context));
  SurfaceTopology topology;
  topology.mt_ = mt;
  topology.componentOf_.assign(mt.vertexCount(), kNone);
  const MeshDiagnosis& d = front.diagnosis;
  topology.doubleSided_ = d.doubleSided.count;
  for (const ComponentDiagnosis& c : d.components) topology.components_.push_back({c.eulerNumber, c.borders});
  for (std::size_t t = 0; t < finest.triangles.size(); ++t)
    for (const std::uint32_t v : finest.triangles[t])
      topology.componentOf_[finest.vertices[v]] = d.componentOf[t];
  return topology;
}

/// Components of a front and of the finest one are matched by their vertices, one to one, and each must have
/// kept its Euler number and its borders.
Status SurfaceTopology::check(const Cut& cut, const RunContext& context) const {
  ARETE_TRY(const ExaminedFront front, examine(mt_, cut, context));
  const MeshDiagnosis& d = front.diagnosis;
  if (d.doubleSided.count > doubleSided_)
    return broken(fmt::format(
        "{} on others, {} of the finest one",
        counted(d.doubleSided.count, "triangle of a front lies", "triangles of a front lie"), doubleSided_));
  std::vector<std::uint32_t> finestOf(d.components.size(), kNone), countOf(components_.size(), 0);
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t v : cut.triangles[t]) {
      const std::uint32_t finest = componentOf_[cut.vertices[v]];
      std::uint32_t& known = finestOf[d.componentOf[t]];
      if (known == kNone) {
        known = finest;
        ++countOf[finest];
      }
      if (known != finest)
        return broken(fmt::format("triangle {} joins two components of the surface", cut.ids[t]));
    }
  // A component that has fallen into parts is counted more often than once, and one that is gone not at all.
  for (std::size_t c = 0; c < countOf.size(); ++c)
    if (countOf[c] != 1)
      return broken(fmt::format("component {} of the surface has become {}", c, countOf[c]));
  for (std::size_t c = 0; c < finestOf.size(); ++c) {
    const Component own{d.components[c].eulerNumber, d.components[c].borders};
    const Component& finest = components_[finestOf[c]];
    if (own != finest)
      return broken(
          fmt::format("component {} of a front has the Euler number {} and {} borders, that of the "
                      "finest one {} and {}",
                      c, own.eulerNumber, own.borders, finest.eulerNumber, finest.borders));
  }
  return {};
}

// Fronts after shares of the nodes, from the root on, are a sample: any prefix of the nodes is a front.
Status validateSurface(const SurfaceModel& model, const SurfaceLawOptions& options,
                       const RunContext& context) {
  ARETE_CHECK(model.validate());
  const MultiTriangulation& mt = model.mt;
  ARETE_CHECK(validate(mt, {}, context));
  ARETE_CHECK(checkFaces(model));
  ARETE_TRY(const SurfaceTopology topology, SurfaceTopology::of(mt, context));
  const SourceSamples samples = samplesOfSource(model, options.everySample);
  constexpr std::uint64_t kFronts = 16;
  for (std::uint64_t i = 0; i < kFronts; ++i) {
    const auto nodes = static_cast<std::uint32_t>(mt.nodeCount() * i / kFronts);
    const Cut front = frontOfPrefix(mt, nodes);
    ARETE_CHECK(topology.check(front, context));
    ARETE_CHECK(checkErrors(mt, front, samples, context));
    if (model.displacement.isEmpty()) continue;
    ARETE_CHECK(checkDisplacedErrors(model, front, samples, context));
  }
  return {};
}

}  // namespace arete
