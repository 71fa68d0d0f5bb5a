// SPDX-License-Identifier: GPL-3.0-or-later
//
// The buffer has, object by object, its positions, its other attributes and the indices of its primitives;
// then the pictures. Elements begin at multiples of four bytes, and so do their components' padding: a
// validator refuses three bytes of a color in a row. Indices are 16 bits where these hold all but the
// largest, which the standard keeps from use.
#include "io/formats/glb/writer/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/base/counted.h"
#include "io/formats/common/flattened.h"
#include "io/formats/common/losses.h"
#include "io/formats/glb/writer/buffer_plan.h"
#include "io/formats/glb/writer/framed.h"
#include "io/formats/glb/writer/local_positions.h"
#include "io/formats/glb/writer/materials.h"
#include "io/formats/glb/writer/mesh_plan.h"
#include "io/formats/glb/writer/packed.h"
#include "io/formats/glb/writer/parts.h"
#include "io/formats/glb/writer/vertex_values.h"
#include "surface/model/wedges.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kCornersPerCancelCheck = 1 << 14;
constexpr std::size_t kMostShort = 0xFFFF;  // vertices whose indices are 16 bits and below the largest

class DocumentWriter {
 public:
  explicit DocumentWriter(const GltfParts& parts) : parts_(parts) {}

  // The order of the additions to the plan is the order of the bytes in the buffer, which BufferWriter
  // repeats.
  Json document() {
    if (parts_.plan.objects.empty()) return {{"asset", parts_.asset}};
    GltfLists lists;
    for (const ObjectPlan& object : parts_.plan.objects) lists.addObject(object, primitivesOf(object));
    // Positions are stored near the origin, where 32-bit floats have most digits; the nodes move them back to
    // where they belong.
    if (const Vec3& t = parts_.translation; !(t == Vec3{}))
      for (Json& node : lists.nodes) node["translation"] = {t.x, t.y, t.z};
    for (const auto& picture : parts_.materials.pictures) {
      lists.addImage(picture, plan_.addBytes(picture.bytes.size()));
      plan_.align();
    }
    if (std::ranges::any_of(parts_.values.values, &GltfValues::isQuantized))
      lists.required.insert("KHR_mesh_quantization");
    lists.accessors = std::move(plan_.accessors);
    lists.views = std::move(plan_.views);
    lists.buffers = {{{"byteLength", plan_.size}}};
    return assembledDocument(parts_, std::move(lists));
  }
  std::uint64_t bufferSize() const { return plan_.size; }

 private:
  // Every primitive of an object shares its vertices; only the indices differ. The standard requires the box
  // of the positions.
  Json primitivesOf(const ObjectPlan& object) {
    const std::size_t count = object.vertices.empty() ? parts_.positions.size() : object.vertices.size();
    Json attributes = {{"POSITION", plan_.add(count, sizeof(Float3), sizeof(Float3), GltfCode::kVertexData,
                                              GltfCode::kFloat, "VEC3")}};
    const auto [low, high] = object.vertices.empty() ? boxOf(parts_.positions) : boxOf(gathered(object));
    plan_.accessors.back()["min"] = {double{low[0]}, double{low[1]}, double{low[2]}};
    plan_.accessors.back()["max"] = {double{high[0]}, double{high[1]}, double{high[2]}};
    for (const GltfValues& v : parts_.values.values) {
      const std::size_t bytes = v.values.elementBytes();
      attributes[v.semantic] = plan_.add(count, bytes, paddedToFour(bytes), GltfCode::kVertexData,
                                         gltfComponentOf(v.values.type), gltfTypeOf(v.values.components));
      if (v.values.isNormalized && !isFloat(v.values.type)) plan_.accessors.back()["normalized"] = true;
      if (!v.name.empty()) plan_.accessors.back()["name"] = v.name;
    }
    const bool isShort = count <= kMostShort;
    const std::size_t bytes = isShort ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
    Json primitives = Json::array();
    for (const PrimitivePlan& primitive : object.primitives) {
      Json json = {
          {"attributes", attributes},
          {"indices", plan_.add(3 * primitive.triangles.size(), bytes, bytes, GltfCode::kIndexData,
                                isShort ? GltfCode::kUnsignedShort : GltfCode::kUnsignedInt, "SCALAR")}};
      if (primitive.material != MeshAttributes::kNone) json["material"] = primitive.material;
      primitives.push_back(std::move(json));
      plan_.align();
    }
    return primitives;
  }

  std::vector<Float3> gathered(const ObjectPlan& object) const {
    std::vector<Float3> positions;
    positions.reserve(object.vertices.size());
    for (const std::uint32_t v : object.vertices) positions.push_back(parts_.positions[v]);
    return positions;
  }

  const GltfParts& parts_;
  BufferPlan plan_;
};

/// Writes what DocumentWriter plans, in the same order.
class BufferWriter {
 public:
  BufferWriter(const GltfParts& parts, ByteSink& sink) : parts_(parts), sink_(sink) {}

  bool write() {
    numberOf_.resize(parts_.positions.size());
    for (const ObjectPlan& object : parts_.plan.objects)
      if (!writeObject(object)) return false;
    for (const auto& picture : parts_.materials.pictures) {
      if (!sink_.goesOn()) return false;
      sink_.write({reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size()});
      align();
    }
    return true;
  }

 private:
  void align() { sink_.zeros(paddedToFour(sink_.written()) - sink_.written()); }

  template <class Put>
  bool forEach(std::size_t count, const Put& put) {
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kCornersPerCancelCheck == 0 && !sink_.goesOn()) return false;
      put(i);
    }
    return true;
  }

  bool writeObject(const ObjectPlan& object) {
    const bool hasAll = object.vertices.empty();
    const std::size_t count = hasAll ? parts_.positions.size() : object.vertices.size();
    const auto vertexAt = [&](std::size_t i) { return hasAll ? i : std::size_t{object.vertices[i]}; };
    for (std::size_t i = 0; i < count; ++i) numberOf_[vertexAt(i)] = static_cast<std::uint32_t>(i);
    if (!forEach(count, [&](std::size_t i) { sink_.put(parts_.positions[vertexAt(i)]); })) return false;
    for (const GltfValues& v : parts_.values.values) {
      const std::size_t bytes = v.values.elementBytes(), padding = paddedToFour(bytes) - bytes;
      const auto* const values = reinterpret_cast<const char*>(v.values.values.data());
      if (!forEach(count, [&](std::size_t i) {
            sink_.write({values + vertexAt(i) * bytes, bytes});
            sink_.zeros(padding);
          }))
        return false;
    }
    for (const PrimitivePlan& primitive : object.primitives) {
      if (!forEach(primitive.triangles.size(), [&](std::size_t i) {
            for (const std::uint32_t v : parts_.mesh.triangles[primitive.triangles[i]])
              if (count <= kMostShort)
                sink_.put(static_cast<std::uint16_t>(numberOf_[v]));
              else
                sink_.put(numberOf_[v]);
          }))
        return false;
      align();
    }
    return true;
  }

  const GltfParts& parts_;
  ByteSink& sink_;
  std::vector<std::uint32_t> numberOf_;  // in the object that is written
};

/// The positions, and what becomes of directions.
Status placePositions(GltfParts& parts, const MeshWriteOptions& options, GltfDirections& directions,
                      std::vector<std::string>& lost) {
  parts.asset = {{"version", "2.0"}, {"generator", "Arete"}};
  if (options.up == MeshUp::z) {
    ARETE_TRY(FramedPositions framed, framedPositions(parts.mesh, options));
    parts.positions = std::move(framed.positions);
    parts.asset["extras"]["arete"] = toJson(framed.frame);
    const auto& attributes = parts.mesh.vertexAttributes;
    const bool hasNormals = std::ranges::find(attributes, kNormalName, &Attribute::name) != attributes.end();
    directions = (framed.areAlike || options.normalsAreOfFrame) && hasNormals ? GltfDirections::turned
                                                                              : GltfDirections::recomputed;
    return {};
  }
  ARETE_TRY(LocalPositions local, localPositions(parts.mesh.positions, options.origin));
  if (!options.crsWkt.empty()) lost.emplace_back("a CRS of a mesh whose z is not up");
  if (!options.triangleErrors.empty())
    lost.emplace_back("the error of each triangle of a mesh whose z is not up");
  if (const Vec3& r = local.rounding; !(r == Vec3{}) && !options.packing)
    lost.push_back(fmt::format("coordinates finer than {:.2g}, {:.2g}, {:.2g} (x, y, z)", r.x, r.y, r.z));
  parts.positions = std::move(local.positions);
  parts.translation = local.translation;
  return {};
}

bool hasLooks(const MeshAttributes& of) {
  return !of.vertexAttributes.empty() || !of.wedgeAttributes.empty() || !of.objects.empty() ||
         !of.materials.empty() || of.hasWedges();
}

/// The names and the material that a terrain has in any glTF of ours.
void nameTerrain(GltfParts& parts) {
  for (ObjectPlan& object : parts.plan.objects) {
    object.name = "terrain";
    for (PrimitivePlan& primitive : object.primitives) primitive.material = 0;
  }
  if (!parts.plan.objects.empty()) parts.materials.materials.push_back(groundMaterial());
}

}  // namespace

Result<SurfaceContent> surfaceContent(MeshRef mesh, const MeshWriteOptions& options) {
  SurfaceContent surface;
  std::vector<std::string>& lost = surface.lost;
  const auto parts = std::make_shared<GltfParts>();
  parts->mesh = splitByWedges(mesh).mesh;
  if (parts->mesh.positions.size() >= std::numeric_limits<std::uint32_t>::max())
    return failure(ErrorCode::invalidData,
                   fmt::format("{} vertices are more than a glTF can hold", parts->mesh.positions.size()));
  if (const std::size_t more = parts->mesh.positions.size() - mesh.shape.positions.size(); more > 0)
    lost.push_back(fmt::format("corners of different values at one vertex ({} added)",
                               counted(more, "vertex is", "vertices are")));

  GltfDirections directions = GltfDirections::asTheyAre;
  ARETE_CHECK(placePositions(*parts, options, directions, lost));
  if (!options.packing)
    if (const std::uint64_t flattened =
            countFlattened(parts->mesh, [&](std::uint32_t v) { return parts->positions[v]; });
        flattened > 0)
      lost.push_back(flattenedLoss(flattened));
  const auto take = [&](std::vector<std::string>& from) {
    std::ranges::move(from, std::back_inserter(lost));
    from.clear();
  };
  std::vector<Attribute> attributes = std::exchange(parts->mesh.vertexAttributes, {});
  if (options.up == MeshUp::z && !options.triangleErrors.empty()) {
    std::erase_if(attributes, [](const Attribute& a) { return a.name == "_ERROR"; });
    Attribute errors{.name = "_ERROR"};
    for (const float error : vertexErrors(parts->mesh, options.triangleErrors))
      errors.append(std::array{double{error}});
    attributes.push_back(std::move(errors));
  }
  parts->values = gltfVertexValues(std::move(attributes), parts->mesh, parts->positions, directions);
  take(parts->values.lost);
  parts->materials = writtenMaterials(mesh.attributes, options.pictureFolder, parts->values.textureSets);
  take(parts->materials.lost);
  parts->plan = planMeshes(parts->mesh);
  take(parts->plan.lost);
  const auto isHeld = [&](const Attribute& a) { return !parts->values.leftOut.contains(a.name); };
  std::vector<std::string> others = lossesOf(mesh.attributes, {.vertexAttribute = isHeld,
                                                               .wedgeAttribute = isHeld,
                                                               .triangleAttribute = {},
                                                               .objects = true,
                                                               .groups = false,
                                                               .materials = true,
                                                               .pictures = true});
  take(others);

  if (options.normalsAreOfFrame || (options.packing && options.up == MeshUp::z && !hasLooks(mesh.attributes)))
    nameTerrain(*parts);
  if (options.packing) {
    surface.content = packedContent(*parts, options, lost);
    return surface;
  }
  DocumentWriter writer(*parts);
  surface.content.document = writer.document();
  surface.content.bufferSize = writer.bufferSize();
  surface.content.writeBuffer = [parts](ByteSink& sink) { return BufferWriter(*parts, sink).write(); };
  return surface;
}

}  // namespace arete
