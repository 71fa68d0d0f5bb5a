// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes of the scene are visited with their transforms, from the roots, without recursion. The format
// allows a node one parent, so a second visit is an error. The positions of a primitive are moved by its
// morph targets, transformed by the node and, in a file that Arete wrote, from the local frame to source
// coordinates. Many primitives may share one accessor and use few of its positions, so the primitives of a
// mesh are grouped by what they share (vertex_group.h), and each group becomes the vertices that it uses.
// Several nodes may use one mesh; the size of the file bounds the total.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "io/crs/local_origin.h"
#include "io/file/file_bytes.h"
#include "io/mesh/glb/document.h"
#include "io/mesh/glb/frame.h"
#include "io/mesh/glb/glb.h"
#include "io/mesh/glb/transform.h"
#include "io/mesh/glb/vertex_group.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kRecordsPerCancelCheck = 1 << 16;
constexpr int kUbyte = 5121, kUshort = 5123, kUint = 5125, kFloat = 5126;
constexpr std::uint64_t kTriangleList = 4;
/// Upper bound on vertices plus triangles: so many per byte of the file, but at least so many.
constexpr std::uint64_t kMostPerByte = 1, kMostAtLeast = 1'000'000;

class GlbReader {
 public:
  GlbReader(const GltfDocument& document, std::size_t fileSize, const RunContext& context)
      : document_(document), context_(context), most_(std::max(kMostAtLeast, kMostPerByte * fileSize)) {}

  Result<MeshFile> read() {
    if (const Status ok = readFrame(); !ok) return tl::unexpected(ok.error());
    if (const Status ok = walk(); !ok) return tl::unexpected(ok.error());
    if (result_.mesh.triangles.empty() && !frame_)
      return failure(ErrorCode::unsupported, "holds no triangle");
    setRounding();
    return std::move(result_);
  }

 private:
  Status readFrame() {
    const Json::json_pointer place("/asset/extras/arete");
    result_.frame.coordinates = "float32";
    result_.up = MeshUp::y;
    if (!document_.json().contains(place)) return {};
    Result<GlbFrame> stated = glbFrameFromJson(document_.json().at(place));
    if (!stated) return tl::unexpected(stated.error());
    const Result<LocalFrame> frame = LocalFrame::create(stated->local);
    if (!frame) return failure(ErrorCode::corrupt, frame.error().message);
    frame_ = *frame;
    result_.up = MeshUp::z;
    result_.crsWkt = std::move(stated->crsWkt);
    result_.verticalUnit = std::move(stated->verticalUnit);
    result_.frame.coordinates = stated->local.isGeographic
                                    ? "float32, metres east, north and up of the origin"
                                    : "float32, metres along the axes of the map from the origin";
    result_.frame.origin = stated->local.origin;
    return {};
  }

  struct Visit {
    std::uint64_t node;
    Affine parent;
  };

  Status walk() {
    const auto nodes = document_.json().find("nodes");
    if (nodes == document_.json().end() || !nodes->is_array()) return {};
    std::vector<Visit> open;
    if (Status ok = addRoots(open, nodes->size()); !ok) return ok;
    std::vector<char> visited(nodes->size(), 0);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const auto node = document_.element("nodes", visit.node);
      if (!node) return tl::unexpected(node.error());
      if (std::exchange(visited[visit.node], char{1}) != 0)
        return failure(ErrorCode::corrupt, fmt::format("node {} has two parents", visit.node));
      const Result<Affine> own = nodeTransform(**node);
      if (!own) return tl::unexpected(own.error());
      const Affine placed = visit.parent.after(*own);
      if ((*node)->contains("skin"))
        return failure(ErrorCode::unsupported,
                       fmt::format("node {} has a skin, which Arete does not read", visit.node));
      if ((*node)->contains("mesh"))
        if (Status ok = addMesh(**node, placed); !ok) return ok;
      if (Status ok = addNumbers(**node, "children", placed, open); !ok) return ok;
    }
    return {};
  }

  /// The nodes of the default scene; without a scene, the nodes without a parent.
  Status addRoots(std::vector<Visit>& open, std::size_t nodes) const {
    const Json& json = document_.json();
    if (json.contains("scenes")) {
      const auto number = GltfDocument::wholeNumber(json, "scene", 0);
      if (!number) return tl::unexpected(number.error());
      const auto scene = document_.element("scenes", *number);
      if (!scene) return tl::unexpected(scene.error());
      return addNumbers(**scene, "nodes", {}, open);
    }
    std::vector<Visit> children;
    for (const Json& node : json["nodes"])
      if (node.is_object())
        if (Status ok = addNumbers(node, "children", {}, children); !ok) return ok;
    std::vector<char> isChild(nodes, 0);
    for (const Visit& child : children)
      if (child.node < nodes) isChild[child.node] = 1;
    for (std::size_t n = 0; n < nodes; ++n)
      if (!isChild[n]) open.push_back({n, {}});
    return {};
  }

  static Status addNumbers(const Json& object, const char* key, const Affine& parent,
                           std::vector<Visit>& to) {
    const auto list = object.find(key);
    if (list == object.end()) return {};
    if (!list->is_array()) return failure(ErrorCode::corrupt, fmt::format("\"{}\" is not a list", key));
    // Pushed in reverse: the last one pushed is visited first.
    for (std::size_t i = list->size(); i-- > 0;) {
      if (!(*list)[i].is_number_unsigned())
        return failure(ErrorCode::corrupt,
                       fmt::format("\"{}\" holds a value that is not the index of a node", key));
      to.push_back({(*list)[i].get<std::uint64_t>(), parent});
    }
    return {};
  }

  Status addMesh(const Json& node, const Affine& placed) {
    const auto number = GltfDocument::wholeNumber(node, "mesh");
    if (!number) return tl::unexpected(number.error());
    const auto mesh = document_.element("meshes", *number);
    if (!mesh) return tl::unexpected(mesh.error());
    const auto primitives = (*mesh)->find("primitives");
    if (primitives == (*mesh)->end() || !primitives->is_array())
      return failure(ErrorCode::corrupt, fmt::format("mesh {} has no primitives", *number));
    const auto weights = weightsOf(node.contains("weights") ? node : **mesh);
    if (!weights)
      return failure(ErrorCode::corrupt, fmt::format("mesh {} has {}", *number, weights.error().message));
    const auto named = [&](std::size_t p, Status status) {
      if (!status)
        status.error().message = fmt::format("mesh {} primitive {}: {}", *number, p, status.error().message);
      return status;
    };

    std::vector<VertexGroup> groups;
    std::vector<Corners> corners;
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      Result<Corners> read = readPrimitive((*primitives)[p], *weights, groups);
      if (!read) return named(p, tl::unexpected(read.error()));
      corners.push_back(*read);
    }
    for (std::size_t p = 0; p < corners.size(); ++p)
      if (Status ok = named(p, useVertices(corners[p], groups[corners[p].group])); !ok) return ok;
    for (VertexGroup& group : groups)
      if (Status ok = addVertices(group, placed); !ok) return ok;
    for (std::size_t p = 0; p < corners.size(); ++p)
      if (Status ok = named(p, addTriangles(corners[p], groups[corners[p].group], placed.mirrors())); !ok)
        return ok;
    return {};
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

  /// The corners of a primitive: indices of the vertices of a group.
  struct Corners {
    std::size_t group = 0;
    std::uint64_t count = 0;
    std::optional<GltfDocument::Elements> indices;  // missing: 0, 1, 2, ...

    std::uint32_t at(std::uint64_t i) const {
      return indices ? indexAt(*indices, i) : static_cast<std::uint32_t>(i);
    }
  };

  Result<Corners> readPrimitive(const Json& primitive, const std::vector<double>& weights,
                                std::vector<VertexGroup>& groups) const {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object())
      return failure(ErrorCode::corrupt, "has no attributes");
    const auto mode = GltfDocument::wholeNumber(primitive, "mode", kTriangleList);
    if (!mode) return tl::unexpected(mode.error());
    if (*mode != kTriangleList)
      return failure(ErrorCode::unsupported, fmt::format("is of mode {}, not a list of triangles", *mode));
    const auto position = GltfDocument::wholeNumber(primitive["attributes"], "POSITION");
    if (!position) return tl::unexpected(position.error());
    const auto positions = positionsOf(*position, "positions");
    if (!positions) return tl::unexpected(positions.error());
    auto targets = targetsOf(primitive, weights, positions->count);
    if (!targets) return tl::unexpected(targets.error());

    Corners corners;
    corners.count = positions->count;
    if (primitive.contains("indices")) {
      const auto number = GltfDocument::wholeNumber(primitive, "indices");
      if (!number) return tl::unexpected(number.error());
      const auto found = document_.accessor(*number, "SCALAR");
      if (!found) return tl::unexpected(found.error());
      if (found->componentType != kUbyte && found->componentType != kUshort && found->componentType != kUint)
        return failure(ErrorCode::corrupt, "has indices that are not unsigned whole numbers");
      corners.indices = *found;
      corners.count = found->count;
    }
    if (corners.count % 3 != 0)
      return failure(ErrorCode::corrupt,
                     fmt::format("has {} corners, not a multiple of three", corners.count));
    const auto same = std::ranges::find_if(groups, [&](const VertexGroup& group) {
      return group.position == *position && group.targets == *targets;
    });
    corners.group = std::size_t(same - groups.begin());
    if (same == groups.end()) groups.emplace_back(*position, *positions, std::move(*targets));
    groups[corners.group].corners += corners.count;
    return corners;
  }

  Result<GltfDocument::Elements> positionsOf(std::uint64_t accessor, const char* what) const {
    const auto positions = document_.accessor(accessor, "VEC3");
    if (positions && positions->componentType != kFloat)
      return failure(ErrorCode::unsupported, fmt::format("has {} that are not 32-bit floats", what));
    return positions;
  }

  /// The morph targets that move positions.
  Result<std::vector<MorphTarget>> targetsOf(const Json& primitive, const std::vector<double>& weights,
                                             std::uint64_t positions) const {
    std::vector<MorphTarget> moving;
    const auto targets = primitive.find("targets");
    if (targets == primitive.end()) return moving;
    if (!targets->is_array()) return failure(ErrorCode::corrupt, "has targets that are not a list");
    if (!weights.empty() && weights.size() != targets->size())
      return failure(ErrorCode::corrupt,
                     fmt::format("has {} morph targets and {} weights", targets->size(), weights.size()));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Json& target = (*targets)[i];
      if (weights[i] == 0 || !target.is_object() || !target.contains("POSITION")) continue;
      const auto number = GltfDocument::wholeNumber(target, "POSITION");
      if (!number) return tl::unexpected(number.error());
      const auto elements = positionsOf(*number, "a morph target of positions");
      if (!elements) return tl::unexpected(elements.error());
      if (elements->count != positions)
        return failure(ErrorCode::corrupt,
                       fmt::format("has {} positions and a morph target of {}", positions, elements->count));
      moving.push_back({*number, weights[i], *elements});
    }
    return moving;
  }

  Status useVertices(const Corners& corners, VertexGroup& group) const {
    const TriangleMesh& mesh = result_.mesh;
    if (mesh.positions.size() + mesh.triangles.size() + group.corners / 3 > most_)
      return failure(ErrorCode::unsupported,
                     "is repeated so often that the mesh is far larger than the file");
    for (std::uint64_t c = 0; c < corners.count; ++c) {
      if (Status ok = reportAndCheck(c, corners.count); !ok) return ok;
      if (!group.use(corners.at(c)))
        return failure(ErrorCode::corrupt, fmt::format("triangle {} names vertex {} of {}", c / 3,
                                                       corners.at(c), group.positions.count));
    }
    return {};
  }

  Status addVertices(VertexGroup& group, const Affine& placed) {
    TriangleMesh& mesh = result_.mesh;
    // A mesh of ours keeps the vertices that no triangle has.
    const std::uint64_t used = group.number(mesh.positions.size(), frame_.has_value());
    if (mesh.positions.size() + mesh.triangles.size() + used + group.corners / 3 > most_)
      return failure(ErrorCode::unsupported,
                     "a mesh is repeated so often that it is far larger than the file");
    if (mesh.positions.size() + used >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::unsupported, "holds more vertices than an index can name");
    for (std::uint64_t i = 0; i < used; ++i) {
      if (Status ok = reportAndCheck(i, used); !ok) return ok;
      const std::uint32_t v = group.vertex(i);
      const Vec3 inFile = placed(group.positionOf(v)), local = frame_ ? gltfToLocal(inFile) : inFile;
      const Vec3 p = frame_ ? frame_->toSource(local) : local;
      if (!isFinite(p))
        return failure(ErrorCode::corrupt, fmt::format("vertex {} of {} has a coordinate that is not finite",
                                                       v, group.positions.count));
      largest_ = {std::max(largest_.x, std::abs(local.x)), std::max(largest_.y, std::abs(local.y)),
                  std::max(largest_.z, std::abs(local.z))};
      mesh.positions.push_back(p);
    }
    return {};
  }

  Status addTriangles(const Corners& corners, const VertexGroup& group, bool flips) {
    for (std::uint64_t c = 0; c < corners.count; c += 3) {
      if (Status ok = reportAndCheck(c, corners.count); !ok) return ok;
      std::array<std::uint32_t, 3> triangle;
      for (std::uint64_t k = 0; k < 3; ++k) triangle[k] = group.indexOf(corners.at(c + k));
      if (flips) std::swap(triangle[1], triangle[2]);
      result_.mesh.triangles.push_back(triangle);
    }
    return {};
  }

  static std::uint32_t indexAt(const GltfDocument::Elements& indices, std::uint64_t i) {
    const char* at = indices.first + i * indices.stride;
    if (indices.componentType == kUbyte) return static_cast<std::uint8_t>(*at);
    std::uint32_t index = 0;
    std::memcpy(&index, at, indices.componentType == kUshort ? 2 : 4);
    return index;
  }

  Status reportAndCheck(std::uint64_t done, std::uint64_t all) const {
    if (done % kRecordsPerCancelCheck > 2) return {};
    context_.report("reading the mesh", static_cast<double>(done) / static_cast<double>(all));
    if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted");
    return {};
  }

  void setRounding() {
    const Vec3 local{float32Rounding(largest_.x, 0), float32Rounding(largest_.y, 0),
                     float32Rounding(largest_.z, 0)};
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
  std::uint64_t most_;
  std::optional<LocalFrame> frame_;
  Vec3 largest_;  // |local coordinates|
  MeshFile result_;
};

/// Where the files are that a glTF names.
std::filesystem::path folderOf(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> bytes = FileBytes::read(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const Result<GltfDocument> document = GltfDocument::open(bytes->view(), folderOf(path));
  if (!document) return failure(document.error().code, document.error().message, path.string());
  Result<MeshFile> file = GlbReader(*document, bytes->size(), context).read();
  if (!file && file.error().culprit.empty()) file.error().culprit = path.string();
  return file;
}

Result<MeshFile> readGltf(const std::filesystem::path& path, const RunContext& context) {
  return readGlb(path, context);
}

}  // namespace arete
