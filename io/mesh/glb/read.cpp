// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes of the scene are visited with their transforms, from the roots, without recursion. The format
// allows a node one parent, so a second visit is an error. Each primitive is copied: its positions are
// transformed by the node and, in a file that Arete wrote, from the local frame to source coordinates.
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
  GlbReader(const GlbDocument& document, std::size_t fileSize, const RunContext& context)
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
    if (!document_.json().contains(place)) return {};
    Result<GlbFrame> stated = glbFrameFromJson(document_.json().at(place));
    if (!stated) return tl::unexpected(stated.error());
    const Result<LocalFrame> frame = LocalFrame::create(stated->local);
    if (!frame) return failure(ErrorCode::corrupt, frame.error().message);
    frame_ = *frame;
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
      const auto number = GlbDocument::wholeNumber(json, "scene", 0);
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
    const auto number = GlbDocument::wholeNumber(node, "mesh");
    if (!number) return tl::unexpected(number.error());
    const auto mesh = document_.element("meshes", *number);
    if (!mesh) return tl::unexpected(mesh.error());
    const auto primitives = (*mesh)->find("primitives");
    if (primitives == (*mesh)->end() || !primitives->is_array())
      return failure(ErrorCode::corrupt, fmt::format("mesh {} has no primitives", *number));
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      Status ok = addPrimitive((*primitives)[p], placed);
      if (ok) continue;
      ok.error().message = fmt::format("mesh {} primitive {}: {}", *number, p, ok.error().message);
      return ok;
    }
    return {};
  }

  Status addPrimitive(const Json& primitive, const Affine& placed) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object())
      return failure(ErrorCode::corrupt, "has no attributes");
    const auto mode = GlbDocument::wholeNumber(primitive, "mode", kTriangleList);
    if (!mode) return tl::unexpected(mode.error());
    if (*mode != kTriangleList)
      return failure(ErrorCode::unsupported, fmt::format("is of mode {}, not a list of triangles", *mode));
    const auto position = GlbDocument::wholeNumber(primitive["attributes"], "POSITION");
    if (!position) return tl::unexpected(position.error());
    const auto positions = document_.accessor(*position, "VEC3");
    if (!positions) return tl::unexpected(positions.error());
    if (positions->componentType != kFloat)
      return failure(ErrorCode::unsupported, "has positions that are not 32-bit floats");
    std::optional<GlbDocument::Elements> indices;
    if (primitive.contains("indices")) {
      const auto number = GlbDocument::wholeNumber(primitive, "indices");
      if (!number) return tl::unexpected(number.error());
      const auto found = document_.accessor(*number, "SCALAR");
      if (!found) return tl::unexpected(found.error());
      if (found->componentType != kUbyte && found->componentType != kUshort && found->componentType != kUint)
        return failure(ErrorCode::corrupt, "has indices that are not unsigned whole numbers");
      indices = *found;
    }
    return addTriangles(*positions, indices, placed);
  }

  Status addTriangles(const GlbDocument::Elements& positions,
                      const std::optional<GlbDocument::Elements>& indices, const Affine& placed) {
    TriangleMesh& mesh = result_.mesh;
    const std::uint64_t corners = indices ? indices->count : positions.count;
    if (corners % 3 != 0)
      return failure(ErrorCode::corrupt, fmt::format("has {} corners, not a multiple of three", corners));
    if (mesh.positions.size() + mesh.triangles.size() + positions.count + corners / 3 > most_)
      return failure(ErrorCode::unsupported,
                     "is repeated so often that the mesh is far larger than the file");
    if (mesh.positions.size() + positions.count >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::unsupported, "is one vertex more than an index can name");
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint64_t v = 0; v < positions.count; ++v) {
      if (Status ok = reportAndCheck(v, positions.count); !ok) return ok;
      std::array<float, 3> xyz;
      std::memcpy(&xyz, positions.first + v * positions.stride, sizeof xyz);
      const Vec3 local = gltfToLocal(placed({xyz[0], xyz[1], xyz[2]}));
      const Vec3 p = frame_ ? frame_->toSource(local) : local;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        return failure(ErrorCode::corrupt, fmt::format("vertex {} of {} has a coordinate that is not finite",
                                                       v, positions.count));
      largest_ = {std::max(largest_.x, std::abs(local.x)), std::max(largest_.y, std::abs(local.y)),
                  std::max(largest_.z, std::abs(local.z))};
      mesh.positions.push_back(p);
    }
    const bool flips = placed.mirrors();
    for (std::uint64_t c = 0; c < corners; c += 3) {
      if (Status ok = reportAndCheck(c, corners); !ok) return ok;
      std::array<std::uint32_t, 3> triangle;
      for (std::uint64_t k = 0; k < 3; ++k) {
        const std::uint32_t index = indices ? indexAt(*indices, c + k) : static_cast<std::uint32_t>(c + k);
        if (index >= positions.count)
          return failure(ErrorCode::corrupt,
                         fmt::format("triangle {} names vertex {} of {}", c / 3, index, positions.count));
        triangle[k] = base + index;
      }
      if (flips) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
    }
    return {};
  }

  static std::uint32_t indexAt(const GlbDocument::Elements& indices, std::uint64_t i) {
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

  const GlbDocument& document_;
  const RunContext& context_;
  std::uint64_t most_;
  std::optional<LocalFrame> frame_;
  Vec3 largest_;  // |local coordinates|
  MeshFile result_;
};

}  // namespace

Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context) {
  const Result<FileBytes> bytes = FileBytes::read(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const Result<GlbDocument> document = GlbDocument::open(bytes->view());
  if (!document) return failure(document.error().code, document.error().message, path.string());
  Result<MeshFile> file = GlbReader(*document, bytes->size(), context).read();
  if (!file && file.error().culprit.empty()) file.error().culprit = path.string();
  return file;
}

}  // namespace arete
