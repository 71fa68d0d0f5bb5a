// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first buffer has the compressed bytes and the pictures. The second has none: the extension wants views
// into it, of the size of the decoded bytes, for what does not know it.
#include "io/formats/glb/writer/packed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "engine/base/counted.h"
#include "io/formats/common/flattened.h"
#include "io/formats/glb/packing/meshopt_streams.h"
#include "io/formats/glb/packing/position_grid.h"
#include "io/formats/glb/writer/buffer_plan.h"
#include "io/formats/glb/writer/packed_values.h"

namespace arete {
namespace {

using PackedJson = nlohmann::ordered_json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr std::size_t kMostShortVertices = 0xFFFF;  // whose indices are below the largest of 16 bits

class Packer {
 public:
  Packer(const GltfParts& parts, const MeshWriteOptions& options, std::vector<std::string>& lost)
      : parts_(parts), options_(options), lost_(lost) {}

  GltfContent content() {
    GltfContent content;
    if (parts_.plan.objects.empty()) {
      content.document = {{"asset", parts_.asset}};
      return content;
    }
    placeOnGrid();
    for (const GltfValues& values : parts_.values.values) values_.push_back(valuesOf(values));
    GltfLists lists;
    for (const ObjectPlan& object : parts_.plan.objects) lists.addObject(object, primitivesOf(object));
    for (const Stream& stream : streams_) addView(stream);
    const Vec3& t = parts_.translation;
    for (PackedJson& node : lists.nodes) {
      node["translation"] = {t.x + double{grid_.low[0]}, t.y + double{grid_.low[1]},
                             t.z + double{grid_.low[2]}};
      node["scale"] = {double{grid_.step}, double{grid_.step}, double{grid_.step}};
    }
    for (const auto& picture : parts_.materials.pictures) {
      views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", picture.bytes.size()}});
      bytes_.append(reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size());
      alignBytes();
      lists.addImage(picture, views_.size() - 1);
    }
    lists.required = {"KHR_mesh_quantization", kMeshopt};
    lists.accessors = std::move(accessors_);
    lists.views = std::move(views_);
    lists.buffers = PackedJson::array(
        {{{"byteLength", bytes_.size()}},
         {{"byteLength", decodedSize_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}}});
    content.document = assembledDocument(parts_, std::move(lists));
    content.bufferSize = bytes_.size();
    content.writeBuffer = [bytes = std::make_shared<const std::string>(std::move(bytes_))](ByteSink& sink) {
      constexpr std::size_t kAtOnce = 1 << 20;
      for (std::size_t at = 0; at < bytes->size(); at += kAtOnce) {
        if (!sink.goesOn()) return false;
        sink.write(std::string_view(*bytes).substr(at, kAtOnce));
      }
      return true;
    };
    return content;
  }

 private:
  void placeOnGrid() {
    const int bits = options_.packing->positionBits;
    const std::vector<Float3>& positions = parts_.positions;
    grid_ = PositionGrid::of(positions, bits);
    points_.reserve(positions.size());
    bool isMoved = false;
    for (const Float3& p : positions) {
      points_.push_back(grid_.nearest(p));
      for (std::size_t k = 0; k < 3; ++k)
        isMoved = isMoved || double{p[k]} != double{grid_.low[k]} +
                                                 double{grid_.step} * static_cast<double>(points_.back()[k]);
    }
    // Terrain states what rounding moves in the unit of its map.
    if (const double half = double{grid_.step} / 2; isMoved && options_.up != MeshUp::z)
      lost_.push_back(fmt::format("coordinates finer than {0:.2g}, {0:.2g}, {0:.2g} (x, y, z)", half));
    if (const std::uint64_t fallen = countFallenTogether(positions, points_); fallen > 0)
      lost_.push_back(fmt::format("places closer than its grid of {} bits ({} together with others)", bits,
                                  counted(fallen, "place falls", "places fall")));
    const std::uint64_t flattened = countFlattened(parts_.mesh, [&](std::uint32_t v) {
      const PositionGrid::Point& p = points_[v];
      return std::array{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    });
    if (flattened > 0)
      lost_.push_back(counted(flattened, "triangle, which has no area on its grid",
                              "triangles, which have no area on its grid"));
  }

  PackedValues valuesOf(const GltfValues& values) {
    if (values.semantic != "_ERROR" || options_.up != MeshUp::z || options_.triangleErrors.empty())
      return packedValues(values, lost_);
    GltfValues grown = values;
    const auto& frame = parts_.asset["extras"]["arete"];
    const double more = errorOfGrid(parts_.mesh, parts_.positions, double{grid_.step}) /
                        frame["verticalUnitMetres"].get<double>();
    for (std::size_t i = 0; i < grown.values.elementCount(); ++i) {
      const double sum = grown.values.numbers(i)[0] + more;
      float error = static_cast<float>(sum);
      if (double{error} < sum) error = std::nextafter(error, std::numeric_limits<float>::infinity());
      std::memcpy(grown.values.values.data() + i * sizeof error, &error, sizeof error);
    }
    return packedValues(grown, lost_);
  }

  void alignBytes() { bytes_.resize(paddedToFour(bytes_.size()), '\0'); }

  /// Elements of one kind of all objects, which become one view: names of views take as many bytes as small
  /// streams do, and long streams compress better.
  struct Stream {
    std::string key;
    std::size_t stride = 4;
    const char* filter = nullptr;
    std::string bytes = {};                   ///< of vertices
    std::vector<std::uint32_t> indices = {};  ///< of triangles
  };

  /// @return The number of the stream, which its view has too.
  std::size_t streamOf(const std::string& key, std::size_t stride, const char* filter) {
    const auto found = std::ranges::find(streams_, key, &Stream::key);
    if (found == streams_.end()) streams_.push_back({.key = key, .stride = stride, .filter = filter});
    return static_cast<std::size_t>(std::ranges::find(streams_, key, &Stream::key) - streams_.begin());
  }

  void addView(const Stream& stream) {
    const bool areIndices = !stream.indices.empty();
    const std::size_t count = areIndices ? stream.indices.size() : stream.bytes.size() / stream.stride;
    const std::string encoded = areIndices ? encodeMeshoptTriangles(stream.indices, numberOf_.size())
                                           : encodeMeshoptVertices(stream.bytes, count, stream.stride);
    PackedJson extension = {{"buffer", 0},
                            {"byteOffset", bytes_.size()},
                            {"byteLength", encoded.size()},
                            {"byteStride", stream.stride},
                            {"mode", areIndices ? "TRIANGLES" : "ATTRIBUTES"},
                            {"count", count}};
    if (stream.filter != nullptr) extension["filter"] = stream.filter;
    PackedJson view = {{"buffer", 1}, {"byteOffset", decodedSize_}, {"byteLength", count * stream.stride}};
    if (!areIndices) view["byteStride"] = stream.stride;
    view["target"] = areIndices ? GltfCode::kIndexData : GltfCode::kVertexData;
    view["extensions"] = {{kMeshopt, std::move(extension)}};
    views_.push_back(std::move(view));
    bytes_ += encoded;
    alignBytes();
    decodedSize_ += paddedToFour(count * stream.stride);
  }

  std::size_t addAccessor(std::size_t view, std::size_t offset, int component, std::size_t count,
                          const char* type) {
    accessors_.push_back({{"bufferView", view}});
    if (offset > 0) accessors_.back()["byteOffset"] = offset;
    accessors_.back().update({{"componentType", component}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
  }

  PackedJson primitivesOf(const ObjectPlan& object) {
    std::vector<std::uint32_t> vertices = object.vertices;
    if (vertices.empty()) {
      vertices.resize(parts_.positions.size());
      std::iota(vertices.begin(), vertices.end(), 0U);
    }
    std::vector<std::vector<std::uint32_t>> indices = orderVertices(object, vertices);
    const std::size_t count = vertices.size();
    PackedJson attributes = {{"POSITION", addPositions(vertices)}};
    for (const PackedValues& v : values_) {
      const std::size_t stream = streamOf(v.semantic, v.stride, v.filter);
      std::string& bytes = streams_[stream].bytes;
      attributes[v.semantic] = addAccessor(stream, bytes.size(), v.component, count, v.type);
      for (const std::uint32_t vertex : vertices) bytes.append(v.bytes, vertex * v.stride, v.stride);
      if (v.isNormalized) accessors_.back()["normalized"] = true;
      if (!v.name.empty()) accessors_.back()["name"] = v.name;
    }
    const bool isShort = count <= kMostShortVertices;
    const std::size_t bytesEach = isShort ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
    PackedJson primitives = PackedJson::array();
    const std::size_t stream =
        streamOf(isShort ? "indices of 16 bits" : "indices of 32 bits", bytesEach, nullptr);
    for (std::size_t p = 0; p < indices.size(); ++p) {
      std::vector<std::uint32_t>& all = streams_[stream].indices;
      const std::size_t accessor = addAccessor(stream, all.size() * bytesEach,
                                               isShort ? GltfCode::kUnsignedShort : GltfCode::kUnsignedInt,
                                               indices[p].size(), "SCALAR");
      all.insert(all.end(), indices[p].begin(), indices[p].end());
      primitives.push_back({{"attributes", attributes}, {"indices", accessor}});
      if (const std::uint32_t m = object.primitives[p].material; m != MeshAttributes::kNone)
        primitives.back()["material"] = m;
    }
    return primitives;
  }

  /// Orders the triangles of each primitive, and the vertices of all.
  /// @return By primitive, its indices into the vertices.
  std::vector<std::vector<std::uint32_t>> orderVertices(const ObjectPlan& object,
                                                        std::vector<std::uint32_t>& vertices) {
    numberOf_.resize(parts_.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) numberOf_[vertices[i]] = static_cast<std::uint32_t>(i);
    std::vector<std::vector<std::uint32_t>> indices;
    std::vector<std::uint32_t> all;
    for (const PrimitivePlan& primitive : object.primitives) {
      std::vector<std::uint32_t> corners;
      corners.reserve(3 * primitive.triangles.size());
      for (const std::uint32_t t : primitive.triangles)
        for (const std::uint32_t v : parts_.mesh.triangles[t]) corners.push_back(numberOf_[v]);
      indices.push_back(orderForCache(corners, vertices.size()));
      all.insert(all.end(), indices.back().begin(), indices.back().end());
    }
    const std::vector<std::uint32_t> number = orderOfFirstUse(all, vertices.size());
    std::vector<std::uint32_t> ordered(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) ordered[number[i]] = vertices[i];
    vertices = std::move(ordered);
    for (auto& of : indices)
      for (std::uint32_t& index : of) index = number[index];
    return indices;
  }

  std::size_t addPositions(const std::vector<std::uint32_t>& vertices) {
    constexpr std::size_t kStride = 8;
    const std::size_t stream = streamOf("POSITION", kStride, nullptr);
    std::string& bytes = streams_[stream].bytes;
    const std::size_t begin = bytes.size();
    bytes.resize(begin + vertices.size() * kStride, '\0');
    PositionGrid::Point low = points_[vertices.front()], high = low;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const PositionGrid::Point& p = points_[vertices[i]];
      std::memcpy(bytes.data() + begin + i * kStride, p.data(), sizeof p);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    const std::size_t accessor =
        addAccessor(stream, begin, GltfCode::kUnsignedShort, vertices.size(), "VEC3");
    accessors_[accessor]["min"] = low;
    accessors_[accessor]["max"] = high;
    return accessor;
  }

  const GltfParts& parts_;
  const MeshWriteOptions& options_;
  std::vector<std::string>& lost_;
  PositionGrid grid_;
  std::vector<PositionGrid::Point> points_;  // by vertex
  std::vector<PackedValues> values_;
  std::vector<std::uint32_t> numberOf_;  // by vertex, in the object that is written
  std::vector<Stream> streams_;
  PackedJson views_ = PackedJson::array(), accessors_ = PackedJson::array();
  std::string bytes_;
  std::uint64_t decodedSize_ = 0;
};

}  // namespace

GltfContent packedContent(const GltfParts& parts, const MeshWriteOptions& options,
                          std::vector<std::string>& lost) {
  return Packer(parts, options, lost).content();
}

}  // namespace arete
