// SPDX-License-Identifier: GPL-3.0-or-later
//
// First all primitives that the scene shows are read (scene.h, primitive.h). Those that share their accessors
// and stand at the same place share vertices (vertex_group.h), also those of several meshes: a mesh that is
// written with several materials or objects comes back as it was. When all are known, the vertices that are
// used are numbered, group by group, and the triangles follow in the order of the scene. A mesh that several
// nodes use is repeated; the memory of the machine bounds the total.
//
// Positions are moved by morph targets, put into place by the node and, in a file with Arete's frame, brought
// from the local frame to source coordinates.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/file_bytes.h"
#include "io/formats/glb/document.h"
#include "io/formats/glb/frame.h"
#include "io/formats/glb/glb.h"
#include "io/formats/glb/reader/materials.h"
#include "io/formats/glb/reader/primitive.h"
#include "io/formats/glb/reader/scene.h"
#include "io/formats/glb/reader/vertex_attributes.h"
#include "io/formats/glb/reader/vertex_group.h"
#include "io/geo/crs/local_origin.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kRecordsPerCancelCheck = 1 << 16;
/// Upper bound on steps that make neither vertices nor triangles, and on places: so many per byte of the file
/// and of what it holds compressed, but at least so many.
constexpr std::uint64_t kMostPerByte = 1, kMostAtLeast = 1'000'000;
constexpr std::uint64_t kMostPlacesAtLeast = 100'000;
/// Upper bound on the bytes of attributes: so many per byte of the file or of the positions.
constexpr std::uint64_t kMostAttributesPerByte = 32, kMostAttributesAtLeast = 64 << 20;
/// What the mesh takes in memory: of a triangle its corners, object and material, the corners of what is read
/// and what a list takes while it grows; of a vertex its position likewise.
constexpr std::uint64_t kBytesPerTriangle = 60, kBytesPerVertex = 72;
constexpr std::uint32_t kNone = MeshAttributes::kNone;
/// What Arete calls the one node and the one material of a terrain.
constexpr const char *kTerrainNode = "terrain", *kTerrainMaterial = "ground";

class GlbReader {
 public:
  GlbReader(const GltfDocument& document, const RunContext& context)
      : document_(document), context_(context), primitives_(document, leftOut_, context) {}

  Result<MeshFile> read() {
    ARETE_CHECK(readFrame());
    ARETE_TRY(const auto placements, placedMeshes(document_, mostPlaces(), leftOut_));
    for (const GltfPlacement& placement : placements) ARETE_CHECK(plan(placement));
    ARETE_CHECK(useVertices());
    GltfVertexAttributes attributes(frame_.has_value());
    for (VertexGroup& group : groups_) ARETE_CHECK(addVertices(group, attributes));
    for (const Part& part : parts_) ARETE_CHECK(addTriangles(part));
    leftOut_.shownMeshes = meshesShown_.size();
    for (std::string& sentence : leftOut_.sentences(document_.json()))
      result_.warnings.push_back({WarningCode::omitted, std::move(sentence)});
    if (result_.mesh.triangles.empty() && !frame_) return noTriangle();
    SurfaceMesh& mesh = result_.mesh;
    mesh.vertexAttributes = attributes.finish(mesh.positions.size(), result_.warnings);
    addMaterials();
    forgetDefaults();
    setRounding();
    return std::move(result_);
  }

 private:
  /// The triangles of a primitive at a place.
  struct Part {
    const GltfPrimitive* primitive;
    std::size_t group;
    std::uint32_t object;
    std::uint64_t mesh, number;  ///< the primitive, in the file
  };

  Result<MeshFile> noTriangle() const {
    std::string why;
    for (const std::string& sentence : result_.warnings)
      if (why.size() < 200) why += "; " + sentence;
    return failure(ErrorCode::unsupported, "holds no triangle" + why);
  }

  Status readFrame() {
    result_.frame.coordinates = "float32";
    result_.up = MeshUp::y;
    const Json::json_pointer generator("/asset/generator"), place("/asset/extras/arete");
    if (document_.json().contains(generator) && document_.json().at(generator) == "Arete") isOurs_ = true;
    if (!document_.json().contains(place)) return {};
    ARETE_TRY(GlbFrame stated, glbFrameFromJson(document_.json().at(place)));
    const Result<LocalFrame> frame = LocalFrame::create(stated.local);
    if (!frame) return failure(ErrorCode::corrupt, frame.error().message);
    frame_ = *frame;
    isOurs_ = true;
    result_.up = MeshUp::z;
    result_.crsWkt = std::move(stated.crsWkt);
    result_.verticalUnit = std::move(stated.verticalUnit);
    result_.frame.coordinates = stated.local.isGeographic
                                    ? "float32, metres east, north and up of the origin"
                                    : "float32, metres along the axes of the map from the origin";
    result_.frame.origin = stated.local.origin;
    result_.frame.isLocalMetres = stated.local.isGeographic;
    return {};
  }

  std::uint64_t most() const {
    return std::max(kMostAtLeast, kMostPerByte * document_.views().sourceBytes());
  }

  std::uint64_t mostPlaces() const { return std::max(kMostPlacesAtLeast, document_.views().sourceBytes()); }

  /// Reads the primitives of a mesh and finds the groups of their vertices.
  Status plan(const GltfPlacement& placement) {
    ARETE_TRY(const auto node, document_.element("nodes", placement.node));
    ARETE_TRY(const auto mesh, document_.element("meshes", placement.mesh));
    ARETE_TRY(const auto primitives, primitivesOf(placement, *node, *mesh));
    steps_ += primitives->size() + 1;
    if (steps_ > most()) return tooLarge();
    meshesShown_.insert(placement.mesh);
    const std::uint32_t visit = visits_[{placement.mesh, bytesOf(placement.placed)}]++;
    const std::uint32_t object = addObject(placement, *node, *mesh);
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      const auto& primitive = (*primitives)[p];
      if (!primitive) continue;
      steps_ += primitive->attributes.size();
      const auto [group, isNew] =
          groupOf_.try_emplace(keyOf(*primitive, placement.placed, visit), groups_.size());
      if (isNew) groups_.emplace_back(*primitive, placement.placed);
      groups_[group->second].corners += primitive->corners;
      triangles_ += primitive->triangles();
      ARETE_CHECK(checkMemory(0, 0));
      parts_.push_back({&*primitive, group->second, object, placement.mesh, p});
    }
    return {};
  }

  using Primitives = std::vector<std::optional<GltfPrimitive>>;

  /// Those of a mesh, read once for each set of weights.
  Result<const Primitives*> primitivesOf(const GltfPlacement& placement, const Json& node, const Json& mesh) {
    const bool hasWeights = node.contains("weights");
    const std::pair key{placement.mesh, hasWeights ? placement.node : ~std::uint64_t{0}};
    if (const auto known = read_.find(key); known != read_.end()) return &known->second;
    const auto list = mesh.find("primitives");
    if (list == mesh.end() || !list->is_array())
      return failure(ErrorCode::corrupt, fmt::format("mesh {} has no primitives", placement.mesh));
    const auto weights = weightsOf(hasWeights ? node : mesh);
    if (!weights)
      return failure(ErrorCode::corrupt,
                     fmt::format("mesh {} has {}", placement.mesh, weights.error().message));
    Primitives primitives;
    for (std::size_t p = 0; p < list->size(); ++p) {
      ARETE_CHECK(reportAndCheck(p, list->size()));
      auto primitive = primitives_.read((*list)[p], *weights);
      if (!primitive) return named(placement.mesh, p, primitive.error());
      primitives.push_back(std::move(*primitive));
    }
    return &read_.emplace(key, std::move(primitives)).first->second;
  }

  /// The weights of the morph targets of a node or a mesh; empty: all 0.
  static Result<std::vector<double>> weightsOf(const Json& object) {
    std::vector<double> weights;
    const auto list = object.find("weights");
    if (list == object.end()) return weights;
    for (const Json& weight : *list) {
      if (!list->is_array() || !weight.is_number())
        return failure(ErrorCode::corrupt, "\"weights\" that are not a list of numbers");
      weights.push_back(weight.get<double>());
    }
    return weights;
  }

  static std::string bytesOf(const Affine& placed) {
    return std::string(reinterpret_cast<const char*>(&placed.a), sizeof placed.a) +
           std::string(reinterpret_cast<const char*>(&placed.t), sizeof placed.t);
  }

  /// Equal for primitives that share vertices. A mesh that stands twice at one place is two.
  static std::string keyOf(const GltfPrimitive& primitive, const Affine& placed, std::uint32_t visit) {
    std::string key = bytesOf(placed);
    const auto add = [&](const auto& value) {
      key.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(visit);
    for (const GltfAttribute& attribute : primitive.attributes) {
      add(attribute.source);
      key += attribute.name + '\0';
    }
    for (const GltfMorph& morph : primitive.morphs) {
      add(morph.accessor);
      add(morph.weight);
      key += morph.name + '\0';
    }
    return key;
  }

  std::uint32_t addObject(const GltfPlacement& placement, const Json& node, const Json& mesh) {
    if (lastNode_ == placement.node) return static_cast<std::uint32_t>(result_.mesh.objects.size() - 1);
    lastNode_ = placement.node;
    std::string name;
    for (const Json* const named : {&mesh, &node})
      if (const auto found = named->find("name"); found != named->end() && found->is_string()) name = *found;
    result_.mesh.objects.push_back(std::move(name));
    return static_cast<std::uint32_t>(result_.mesh.objects.size() - 1);
  }

  static tl::unexpected<Error> named(std::uint64_t mesh, std::uint64_t primitive, Error error) {
    error.message = fmt::format("mesh {} primitive {}: {}", mesh, primitive, error.message);
    return tl::unexpected(std::move(error));
  }

  static tl::unexpected<Error> tooLarge() {
    return failure(ErrorCode::unsupported, "a mesh is repeated so often that it is far larger than the file");
  }

  /// A small file can show a mesh at many places: what that takes is held against the memory of the machine.
  Status checkMemory(std::uint64_t vertices, std::uint64_t bytesOfAttributes) const {
    const double bytes = double(triangles_) * double(kBytesPerTriangle) +
                         double(vertices) * double(kBytesPerVertex) + 2 * double(bytesOfAttributes);
    const double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
    if (memory <= 0 || bytes <= memory) return {};
    constexpr double kGibibyte = 1 << 30;
    return failure(
        ErrorCode::invalidData,
        fmt::format("shows {} triangles, because meshes are repeated; to read them takes {:.1f} GiB of "
                    "memory, and this machine has {:.1f} GiB",
                    triangles_, bytes / kGibibyte, memory / kGibibyte));
  }

  Status useVertices() {
    for (const Part& part : parts_) {
      const GltfPrimitive& primitive = *part.primitive;
      VertexGroup& group = groups_[part.group];
      const double largest =
          primitive.indices ? GltfElements::largestOf(primitive.indices->type) : double{kNone};
      for (std::uint64_t c = 0; c < primitive.corners; ++c) {
        ARETE_CHECK(reportAndCheck(c, primitive.corners));
        const std::uint32_t vertex = primitive.vertexAt(c);
        // The largest index would begin a new strip where programs draw; glTF has no such index.
        if (primitive.indices && vertex == largest)
          return named(part.mesh, part.number,
                       {ErrorCode::corrupt,
                        fmt::format("corner {} names vertex {}, which no index may", c, vertex),
                        {}});
        if (group.use(vertex)) continue;
        return named(part.mesh, part.number,
                     {ErrorCode::corrupt,
                      fmt::format("{} {} names vertex {} of {}",
                                  primitive.mode == GltfPrimitive::Mode::list ? "triangle" : "corner",
                                  primitive.mode == GltfPrimitive::Mode::list ? c / 3 : c, vertex,
                                  primitive.vertices()),
                      {}});
      }
    }
    return {};
  }

  Status addVertices(VertexGroup& group, GltfVertexAttributes& attributes) {
    TriangleMesh& mesh = result_.mesh;
    const std::uint64_t first = mesh.positions.size();
    // A mesh of ours keeps the vertices that no triangle has.
    const std::uint64_t used = group.number(first, isOurs_);
    if (first + used >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::unsupported, "holds more vertices than an index can name");
    const std::uint64_t bytes = attributes.bytesAfter(group, first, used);
    const std::uint64_t source = std::max(document_.views().sourceBytes(), kBytesPerVertex * (first + used));
    if (bytes > std::max(kMostAttributesAtLeast, kMostAttributesPerByte * source))
      return failure(ErrorCode::unsupported, "has attributes that are far larger than the file");
    ARETE_CHECK(checkMemory(first + used, bytes));
    takeGrid(group);
    for (std::uint64_t i = 0; i < used; ++i) {
      ARETE_CHECK(reportAndCheck(i, used));
      const std::uint32_t v = group.vertex(i);
      const Vec3 inFile = group.positionOf(v), local = frame_ ? gltfToLocal(inFile) : inFile;
      const Vec3 p = frame_ ? frame_->toSource(local) : local;
      if (!isFinite(p))
        return failure(ErrorCode::corrupt, fmt::format("vertex {} of {} has a coordinate that is not finite",
                                                       v, group.primitive.vertices()));
      largest_ = {std::max(largest_.x, std::abs(local.x)), std::max(largest_.y, std::abs(local.y)),
                  std::max(largest_.z, std::abs(local.z))};
      mesh.positions.push_back(p);
    }
    attributes.add(group, first, used);
    return {};
  }

  /// Whole numbers lie on a grid: a position was rounded by up to half of its step.
  void takeGrid(const VertexGroup& group) {
    const GltfElements& positions = group.primitive.attributes.front().elements;
    if (isFloat(positions.type)) return;
    const double half = 0.5 / (positions.isNormalized ? GltfElements::largestOf(positions.type) : 1);
    const std::array<double, 9>& a = group.placed.a;
    const auto reach = [&](std::size_t row) {
      return half * (std::abs(a[3 * row]) + std::abs(a[3 * row + 1]) + std::abs(a[3 * row + 2]));
    };
    // As gltfToLocal() has the axes.
    const Vec3 here{reach(0), reach(frame_ ? 2 : 1), reach(frame_ ? 1 : 2)};
    halfStep_ = {std::max(halfStep_.x, here.x), std::max(halfStep_.y, here.y), std::max(halfStep_.z, here.z)};
  }

  Status addTriangles(const Part& part) {
    const GltfPrimitive& primitive = *part.primitive;
    const VertexGroup& group = groups_[part.group];
    const bool flips = group.placed.mirrors();
    SurfaceMesh& mesh = result_.mesh;
    for (std::uint64_t t = 0; t < primitive.triangles(); ++t) {
      ARETE_CHECK(reportAndCheck(t, primitive.triangles()));
      const std::array<std::uint64_t, 3> corners = primitive.cornersOf(t);
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = group.indexOf(primitive.vertexAt(corners[k]));
      if (flips) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
    }
    mesh.objectOf.resize(mesh.triangles.size(), part.object);
    mesh.materialOf.resize(mesh.triangles.size(), primitive.material);
    return {};
  }

  void addMaterials() {
    GltfMaterials read = readMaterials(document_, result_.warnings);
    result_.mesh.materials = std::move(read.materials);
    result_.mesh.pictures = std::move(read.pictures);
  }

  /// Takes away the names that say nothing: of one object without a name, and those that Arete gives to the
  /// one object and the one material of a terrain.
  void forgetDefaults() {
    SurfaceMesh& mesh = result_.mesh;
    const bool isTerrain = frame_ && mesh.objects.size() <= 1 && mesh.materials.size() <= 1;
    if (mesh.objects.empty() ||
        (mesh.objects.size() == 1 &&
         (mesh.objects[0].empty() || (isTerrain && mesh.objects[0] == kTerrainNode)))) {
      mesh.objects.clear();
      mesh.objectOf = {};
    }
    if (isTerrain && mesh.materials.size() == 1 && mesh.materials[0].name == kTerrainMaterial &&
        mesh.materials[0].textures.empty())
      mesh.materials.clear();
    if (mesh.materials.empty() || std::ranges::all_of(mesh.materialOf, [](auto m) { return m == kNone; }))
      mesh.materialOf = {};
  }

  Status reportAndCheck(std::uint64_t done, std::uint64_t all) const {
    if (done % kRecordsPerCancelCheck > 0) return {};
    context_.report("reading the mesh", static_cast<double>(done) / static_cast<double>(all));
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted");
    return {};
  }

  void setRounding() {
    const Vec3 local{halfStep_.x + float32Rounding(largest_.x, 0),
                     halfStep_.y + float32Rounding(largest_.y, 0),
                     halfStep_.z + float32Rounding(largest_.z, 0)};
    result_.frame.rounding = local;
    const auto& positions = result_.mesh.positions;
    if (!frame_ || positions.empty()) return;
    Vec3 low = positions.front(), high = low;
    for (const Vec3& p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // The transform to the frame and back rounds to some ulp of the coordinates or of the Earth's radius.
    constexpr double kUlps = 8 * 0x1p-52;
    const double slack = frame_->spec().isGeographic ? kUlps * frame_->spec().semiMajorAxisMetres : 0;
    const Vec3 reach = frame_->sourceReach({local.x + slack, local.y + slack, local.z + slack}, low, high);
    const auto ulps = [&](double a, double b) { return kUlps * std::max(std::abs(a), std::abs(b)); };
    result_.frame.rounding = {reach.x + ulps(low.x, high.x), reach.y + ulps(low.y, high.y),
                              reach.z + ulps(low.z, high.z)};
  }

  const GltfDocument& document_;
  const RunContext& context_;
  GltfLeftOut leftOut_;
  GltfPrimitives primitives_;
  std::optional<LocalFrame> frame_;
  bool isOurs_ = false;
  std::uint64_t steps_ = 0, triangles_ = 0;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Primitives> read_;  // by mesh, and node with weights
  std::set<std::uint64_t> meshesShown_;
  std::map<std::pair<std::uint64_t, std::string>, std::uint32_t> visits_;  // by mesh and place
  std::optional<std::uint64_t> lastNode_;
  std::vector<VertexGroup> groups_;
  std::unordered_map<std::string, std::size_t> groupOf_;
  std::vector<Part> parts_;
  Vec3 largest_;   // |local coordinates|
  Vec3 halfStep_;  // of whole numbers, in local axes
  MeshFile result_;
};

/// Where the files are that a glTF names.
std::filesystem::path folderOf(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context) try {
  ARETE_TRY(const FileBytes bytes, FileBytes::read(path));
  const Result<GltfDocument> document = GltfDocument::open(bytes.view(), folderOf(path));
  if (!document) return failure(document.error().code, document.error().message, path.string());
  Result<MeshFile> file = GlbReader(*document, context).read();
  if (!file && file.error().culprit.empty()) file.error().culprit = path.string();
  return file;
} catch (...) {
  return caughtFailure(path.string());
}

Result<MeshFile> readGltf(const std::filesystem::path& path, const RunContext& context) {
  return readGlb(path, context);
}

}  // namespace arete
