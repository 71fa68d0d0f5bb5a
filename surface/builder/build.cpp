// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh is prepared, its faces are sorted along a space-filling curve, so that neighbours are near each
// other in memory, and simplified level by level (surface/simplify/simplify.h). The recorder makes the
// multitriangulation; what else triangles have is put in its order.
#include "surface/builder/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/morton.h"
#include "engine/memory/pages.h"
#include "engine/memory/required_memory.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/hole_limit.h"
#include "engine/parallel/with_threads.h"
#include "surface/builder/crease_lines.h"
#include "surface/builder/prepare.h"
#include "surface/error/attribute_field.h"
#include "surface/error/original.h"
#include "surface/error/samples.h"
#include "surface/model/face_successors.h"
#include "surface/simplify/simplify.h"

namespace arete {
namespace {

Status checkOptions(const SurfaceBuildOptions& options) {
  if (options.maxDegree < 3 || options.maxDegree > kMaxHoleCorners - 1)
    return failure(ErrorCode::usage,
                   fmt::format("a degree of {} is not from 3 to {}", options.maxDegree, kMaxHoleCorners - 1));
  if (!(options.thresholdRatio > 1) || !(options.thresholdRatio <= 16))
    return failure(ErrorCode::usage,
                   fmt::format("a growth of {} is not above 1 and at most 16", options.thresholdRatio));
  if (const auto& angle = options.creaseAngleDegrees; angle && !(*angle >= 0 && *angle <= 180))
    return failure(ErrorCode::usage, "must be an angle of 0 to 180 degrees",
                   fmt::format("creaseAngleDegrees {}", *angle));
  return {};
}

/// The triangles along a space-filling curve.
std::vector<std::uint32_t> orderAlongCurve(const TriangleMesh& mesh, const Vec3& low, const Vec3& high) {
  const Vec3 span = high - low;
  const double side = std::max({span.x, span.y, span.z});
  const auto cell = [&](double sum, double least) {
    return static_cast<std::uint32_t>(std::clamp((sum / 3 - least) / side, 0.0, 1.0) * 0x1FFFFF);
  };
  std::vector<std::uint64_t> codes;
  codes.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 sum = mesh.positions[i] + mesh.positions[j] + mesh.positions[k];
    codes.push_back(mortonCode(cell(sum.x, low.x), cell(sum.y, low.y), cell(sum.z, low.z)));
  }
  std::vector<std::uint32_t> order(codes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return codes[a] != codes[b] ? codes[a] < codes[b] : a < b;
  });
  return order;
}

std::vector<std::uint8_t> fixedVertices(const LiveMesh& live, std::size_t vertexCount, bool keepsBorders,
                                        std::span<const VertexId> pinched,
                                        std::span<const std::uint32_t> ofCreases) {
  std::vector<std::uint8_t> isFixed(vertexCount, 0);
  for (const VertexId v : pinched) isFixed[v.index()] = 1;
  for (const std::uint32_t v : ofCreases) isFixed[v] = 1;
  if (!keepsBorders) return isFixed;
  for (const LiveMesh::Triangle& t : live.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (!t.twin[i].isValid()) isFixed[t.corners[i].index()] = isFixed[t.corners[(i + 1) % 3].index()] = 1;
  return isFixed;
}

/// Places in the type of the source: floats where every coordinate is one.
VertexArrays placesOf(std::span<const Vec3> positions, std::span<const std::uint32_t> order,
                      std::shared_ptr<const void>& owner) {
  const auto isFloat = [](double x) { return double(static_cast<float>(x)) == x; };
  VertexArrays vertices;
  if (std::ranges::all_of(positions,
                          [&](const Vec3& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); })) {
    auto places = std::make_shared<std::vector<std::array<float, 3>>>();
    for (const std::uint32_t v : order) {
      const Vec3& p = positions[v];
      places->push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    vertices.places32 = *places;
    owner = places;
  } else {
    auto places = std::make_shared<std::vector<Vec3>>();
    for (const std::uint32_t v : order) places->push_back(positions[v]);
    vertices.places64 = *places;
    owner = places;
  }
  return vertices;
}

/// An error beyond what two values are apart is not one of this attribute.
OutwardScale::Code codeOf(float error, const OutwardScale& scale) {
  if (!(error < scale.decode(AttributeErrors::kUnbounded - 1))) return AttributeErrors::kUnbounded;
  return scale.encode(error);
}

/// The order of the faces and of everything that is by face.
void sortFaces(PreparedSurface& prepared, std::span<const std::uint32_t> order) {
  const auto sorted = [&](auto& array) {
    // An array that the mesh does not have stays empty.
    if (array.empty()) return;
    auto copy = array;
    for (std::size_t i = 0; i < order.size(); ++i) copy[i] = array[order[i]];
    array.swap(copy);
  };
  sorted(prepared.mesh.triangles);
  sorted(prepared.mesh.wedges);
  sorted(prepared.faceOf);
  sorted(prepared.partOf);
}

/// The parts of the diagonal that attributes are bounded within. A millionth less than what tolerances are
/// stated as, so that rounding keeps none of them from its distance.
constexpr std::array<double, 4> kAttributeDistances = {0.000999999, 0.0024999975, 0.004999995, 0.00999999};

class SurfaceBuild {
 public:
  SurfaceBuild(const SurfaceBuildOptions& options, const RunContext& context, std::size_t fewEnough,
               std::span<const AttributeWeight> weights)
      : options_(options), context_(context), fewEnough_(fewEnough), weights_(weights) {}

  Result<SurfaceModel> run(SurfaceMesh source) {
    ARETE_CHECK(checkOptions(options_));
    ARETE_TRY(PreparedSurface prepared, prepareSurface(std::move(source), context_));
    prepared_ = std::move(prepared);
    const TriangleMesh& mesh = prepared_.mesh;
    if (mesh.triangles.size() > LiveMesh::kMostTriangles / 2)
      return failure(ErrorCode::unsupported,
                     fmt::format("{} faces are more than 32-bit half-edges can name", mesh.triangles.size()));
    if (const double diagonal = prepared_.diagonal; !(diagonal < 1e30) || !(diagonal > 1e-30))
      return failure(ErrorCode::invalidData,
                     fmt::format("a diagonal of {} is not between 1e-30 and 1e30", diagonal));
    if (options_.creaseAngleDegrees)
      creases_ = makeCreasesLines(prepared_.mesh, *options_.creaseAngleDegrees);
    sortFaces(prepared_, orderAlongCurve(mesh, prepared_.boxLow, prepared_.boxHigh));
    giveFreeHeapBack();
    ARETE_CHECK(simplify());
    return std::move(model_);
  }

 private:
  AttributeField fieldOf() const {
    const bool areWeighed =
        std::ranges::any_of(weights_, [](const AttributeWeight& w) { return w.weight > 0; });
    if (!options_.boundsAttributes && !areWeighed) return {};
    AttributeField field(prepared_.mesh, prepared_.diagonal);
    if (!weights_.empty()) field.weigh(weights_, prepared_.diagonal);
    return field;
  }
  Status simplify() {
    const TriangleMesh& mesh = prepared_.mesh;
    const auto vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
    const auto faceCount = static_cast<std::uint32_t>(mesh.triangles.size());
    const Vec3 &low = prepared_.boxLow, &high = prepared_.boxHigh;
    // The largest coordinate bounds what rounding does to distances from the original surface.
    const double largest = std::max({std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x),
                                     std::abs(high.y), std::abs(high.z)});
    const OriginalSurface original{mesh.positions, mesh.triangles, largest};
    std::optional<SurfaceSamples> samples(original);
    std::vector<VertexId> pinched;
    LiveMesh live = LiveMesh::fromTriangles(mesh.triangles, vertexCount, pinched);
    const std::vector<std::uint8_t> isFixed =
        fixedVertices(live, vertexCount, options_.keepsBorders, pinched, creases_.fixed);
    MetricFrame metric;
    metric.origin = low / 2 + high / 2;
    MtRecorder recorder(faceCount, vertexCount, OutwardScale(prepared_.diagonal), metric);
    const AttributeField field = fieldOf();
    if (options_.boundsAttributes && !field.isEmpty())
      for (const double part : kAttributeDistances)
        model_.attributeDistances.push_back(part * prepared_.diagonal);
    SurfaceState state{.mesh = live,
                       .original = original,
                       .samples = *samples,
                       .recorder = recorder,
                       .metric = metric,
                       .maxDegree = options_.maxDegree,
                       .thresholdRatio = options_.thresholdRatio,
                       .fewEnough = fewEnough_,
                       .unit = std::ldexp(1.0, -std::ilogb(prepared_.diagonal)),
                       .parts = {prepared_.mesh.hasWedges(), prepared_.partOf},
                       .field = field,
                       .boundsAttributes = options_.boundsAttributes,
                       .attributeDistances = model_.attributeDistances};
    model_.boundsLines = state.parts.hasLines();
    // A label is what a triangle inherits: a face of the source, and the wedges of its corners.
    state.labels.resize(faceCount);
    for (std::uint32_t f = 0; f < faceCount; ++f)
      state.labels.set(
          f, {f, prepared_.mesh.hasWedges() ? prepared_.mesh.wedges[f] : std::array<std::uint32_t, 3>{}});
    ARETE_TRY(const SurfaceRoot root, simplifySurface(state, isFixed, context_));
    // What only the simplification needs goes before the model is put together, which lowers the peak of
    // memory.
    state.pieces = {};
    live = {};
    state.records = {};
    state.labels = LabelArray(false);
    samples.reset();
    prepared_.mesh.triangles = {};
    giveFreeHeapBack();
    context_.report("finish", 0);
    finish(root, recorder, state);
    context_.report("finish", 1);
    return {};
  }

  void finish(const SurfaceRoot& root, MtRecorder& recorder, const SurfaceState& state) {
    const SurfaceMesh& mesh = prepared_.mesh;
    UninitializedVector<std::uint32_t> order;
    const MultiTriangulation bare =
        recorder.finish(root.vertices, root.triangles, static_cast<std::uint32_t>(mesh.positions.size()),
                        order, context_.clock);
    std::shared_ptr<const void> owner;
    const VertexArrays vertices = placesOf(mesh.positions, order, owner);
    MtArrays arrays = bare.arrays();
    // What the recorder calls `below` is the root mean square here (SurfaceRemover).
    const std::span<const std::uint16_t> rms = arrays.columns.of(kBelow);
    arrays.columns.drop(kBelow);
    arrays.columns.drop(kAbove);
    arrays.columns.set(kRms, rms);
    model_.mt = withVertices(MultiTriangulation(arrays, std::make_shared<MultiTriangulation>(bare)), vertices,
                             std::move(owner));
    const MultiTriangulation& mt = model_.mt;

    model_.faceOf.resize(mt.triangleIdCount());
    if (mesh.hasWedges()) model_.wedgesOf.resize(mt.triangleIdCount());
    const auto put = [&](std::uint32_t t, const TriangleLabels& labels) {
      model_.faceOf[t] = prepared_.faceOf[labels.face];
      if (mesh.hasWedges()) model_.wedgesOf[t] = labels.wedges;
    };
    const auto entries =
        std::span(state.field.entries()).first(options_.boundsAttributes ? state.field.entries().size() : 0);
    const std::size_t levels = 1 + model_.attributeDistances.size();
    for (const AttributeField::Entry& e : entries)
      model_.attributeErrors.push_back({e.name, e.inFile, e.ofWedges, e.length,
                                        OutwardScale(1.01 * e.largest),
                                        std::vector<std::uint16_t>(levels * mt.triangleIdCount(), 0)});
    const auto putErrors = [&](std::uint32_t t, const auto& errorOf) {
      for (std::size_t level = 0; level < levels; ++level)
        for (std::size_t a = 0; a < entries.size(); ++a)
          model_.attributeErrors[a].codes[level * mt.triangleIdCount() + t] =
              codeOf(errorOf(level * entries.size() + a), model_.attributeErrors[a].scale);
    };
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
      put(t, root.labels[t]);
      putErrors(t, [&](std::size_t a) { return root.attributeErrors[levels * entries.size() * t + a]; });
    }
    // Stars were labelled as vertices were removed; nodes have another order, so the vertex finds its labels.
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      const VertexId removed(order[mt.apex(NodeId(n)).index()]);
      const std::uint32_t from = state.firstStarLabel[removed];
      for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i) {
        const std::uint32_t t = mt.slotTriangle(NodeId(n), i).index();
        put(t, state.starLabels[from + i]);
        putErrors(t, [&](std::size_t a) { return state.starAttributeErrors.get(from + i, a); });
      }
    }
    model_.levels = root.levels;
    describe(order);
    if (!model_.hasFaceAttributes()) inheritFaces(mt, model_.faceOf);
  }

  void describe(std::span<const std::uint32_t> order) {
    SurfaceMesh& mesh = prepared_.mesh;

    model_.options = options_;
    model_.mending = prepared_.mending;
    model_.creaseEdges = creases_.edges;
    model_.leftOutFaces = std::move(prepared_.leftOutFaces);
    model_.diagonal = prepared_.diagonal;
    model_.sourceVertices = prepared_.sourceVertices;
    model_.sourceFaces = model_.fileFaces = prepared_.sourceFaces;
    for (const std::uint32_t v : order) model_.vertexOf.push_back(prepared_.vertexOf[v]);
    MeshAttributes& a = model_.attributes;
    // Attributes of vertices take the order of the model; all others keep the source's order and are numbered
    // by it.
    for (const Attribute& attribute : mesh.vertexAttributes) {
      Attribute& sorted = a.vertexAttributes.emplace_back(emptyLike(attribute));
      for (const std::uint32_t v : order) sorted.append(attribute.element(v));
    }
    a.wedgeAttributes = std::move(mesh.wedgeAttributes);
    a.wedgeCount = mesh.wedgeCount;
    MeshAttributes& ofSource = prepared_.ofSource;
    a.triangleAttributes = std::move(ofSource.triangleAttributes);
    a.faceOf = std::move(ofSource.faceOf);
    a.objects = std::move(ofSource.objects);
    a.groups = std::move(ofSource.groups);
    a.objectOf = std::move(ofSource.objectOf);
    a.groupOf = std::move(ofSource.groupOf);
    a.materials = std::move(ofSource.materials);
    a.materialOf = std::move(ofSource.materialOf);
    a.pictures = std::move(ofSource.pictures);
  }

  const SurfaceBuildOptions& options_;
  const RunContext& context_;
  std::size_t fewEnough_;
  std::span<const AttributeWeight> weights_;
  PreparedSurface prepared_;
  CreaseLines creases_;
  SurfaceModel model_;
};

}  // namespace

Result<SurfaceModel> buildSurface(SurfaceMesh source, const SurfaceBuildOptions& options,
                                  const RunContext& context, std::size_t fewEnough,
                                  std::span<const AttributeWeight> weights) try {
  // What a build takes at the most for each vertex.
  constexpr std::uint64_t kBytesOfVertex = 450;
  requireMemory(kBytesOfVertex * source.positions.size(), "take a part of the mesh, or a decimated one");
  return withThreads(
      context, [&] { return SurfaceBuild(options, context, fewEnough, weights).run(std::move(source)); });
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
