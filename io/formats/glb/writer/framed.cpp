// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every element is a multiple of four bytes, the alignment that the format requires. Normals are computed
// from the rounded positions.
#include "io/formats/glb/writer/framed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/formats/glb/writer/buffer_plan.h"
#include "io/geo/crs/local_origin.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kRecordsPerCancelCheck = 1 << 16;

Result<GlbFrame> frameOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  Georeference georeference;
  if (!options.crsWkt.empty()) {
    registerGdal();
    ARETE_TRY(const auto crs, crsFromText(options.crsWkt));
    ARETE_CHECK(describeCrs(crs, georeference));
  }
  if (!options.verticalUnit.empty())
    georeference.verticalUnitMetres =
        metresPerUnit(options.verticalUnit).value_or(georeference.verticalUnitMetres);
  if (options.verticalUnitMetres > 0) georeference.verticalUnitMetres = options.verticalUnitMetres;
  const Vec3 origin = options.origin.value_or(localOrigin(mesh.positions));
  stateMapScale(georeference, {origin.x, origin.y});  // of the origin: tiles with one origin fit together
  GlbFrame frame{
      .local = localFrameSpec(georeference, origin),
      .crsWkt = options.crsWkt,
      .verticalUnit = options.verticalUnit.empty() ? georeference.verticalUnit : options.verticalUnit,
      .notes = options.notes};
  const auto [west, east] = std::ranges::minmax_element(mesh.positions, {}, &Vec3::x);
  if (!mesh.positions.empty()) frame.local.middleLongitude = west->x / 2 + east->x / 2;
  return frame;
}

Result<std::vector<Float3>> roundedPositions(const TriangleMesh& mesh, const LocalFrame& frame) {
  std::vector<Float3> rounded;
  rounded.reserve(mesh.positions.size());
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (const Vec3& p : mesh.positions) {
    const Vec3 q = localToGltf(frame.toLocal(p));
    if (!(std::abs(q.x) <= kLargest && std::abs(q.y) <= kLargest && std::abs(q.z) <= kLargest))
      return failure(ErrorCode::invalidData,
                     fmt::format("the position {}, {}, {} is beyond the pole, or too far for 32-bit floats",
                                 p.x, p.y, p.z));
    // -0 becomes 0, as in boxOf().
    rounded.push_back(
        {static_cast<float>(q.x) + 0.0F, static_cast<float>(q.y) + 0.0F, static_cast<float>(q.z) + 0.0F});
  }
  return rounded;
}

/// Whether a step along each axis is as long as along the others.
bool scalesAlike(const LocalFrame& frame) {
  if (frame.spec().isGeographic) return false;
  const Vec3& o = frame.spec().origin;
  const double z = frame.toLocal({o.x, o.y, o.z + 1}).z - frame.toLocal(o).z;
  const double x = frame.toLocal({o.x + 1, o.y, o.z}).x - frame.toLocal(o).x;
  const double y = frame.toLocal({o.x, o.y + 1, o.z}).y - frame.toLocal(o).y;
  constexpr double kAlike = 1e-3;  // smaller differences of scale do not change normals visibly
  return std::abs(x - z) <= kAlike * z && std::abs(y - z) <= kAlike * z;
}

/// Writes the elements one by one. False if the work was cancelled.
template <class Values>
bool writeAll(ByteSink& sink, const Values& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % kRecordsPerCancelCheck == 0 && !sink.goesOn()) return false;
    sink.put(values[i]);
  }
  return true;
}

}  // namespace

Result<FramedPositions> framedPositions(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  ARETE_TRY(GlbFrame spec, frameOf(mesh, options));
  ARETE_TRY(const LocalFrame frame, LocalFrame::create(spec.local));
  ARETE_TRY(auto positions, roundedPositions(mesh, frame));
  return FramedPositions{
      .frame = std::move(spec), .positions = std::move(positions), .areAlike = scalesAlike(frame)};
}

std::vector<Float3> normalsOf(const TriangleMesh& mesh, std::span<const Float3> positions) {
  std::vector<Vec3> sums(positions.size());
  for (const auto& t : mesh.triangles) {
    const Float3 &p = positions[t[0]], &q = positions[t[1]], &r = positions[t[2]];
    const auto from = [&](const Float3& to, std::size_t k) { return double{to[k]} - double{p[k]}; };
    // The cross product weighs the normal of a face by its area.
    const Vec3 n{from(q, 1) * from(r, 2) - from(q, 2) * from(r, 1),
                 from(q, 2) * from(r, 0) - from(q, 0) * from(r, 2),
                 from(q, 0) * from(r, 1) - from(q, 1) * from(r, 0)};
    for (const std::uint32_t v : t) sums[v] = {sums[v].x + n.x, sums[v].y + n.y, sums[v].z + n.z};
  }
  std::vector<Float3> normals;
  normals.reserve(sums.size());
  for (const Vec3& s : sums) {
    // A vertex without faces, or whose faces cancel out, points up: glTF requires unit vectors.
    const double length = std::hypot(s.x, s.y, s.z);
    if (length > 0 && std::isfinite(length))
      normals.push_back({static_cast<float>(s.x / length), static_cast<float>(s.y / length),
                         static_cast<float>(s.z / length)});
    else
      normals.push_back({0, 1, 0});
  }
  return normals;
}

std::vector<float> vertexErrors(const TriangleMesh& mesh, std::span<const float> triangleErrors) {
  std::vector<float> errors;
  if (triangleErrors.empty()) return errors;
  errors.resize(mesh.positions.size());
  for (std::size_t t = 0; t < triangleErrors.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) errors[v] = std::max(errors[v], triangleErrors[t]);
  return errors;
}

std::array<Float3, 2> boxOf(std::span<const Float3> positions) {
  Float3 low = positions[0], high = positions[0];
  for (const Float3& p : positions)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  // Adding 0 turns -0 into 0.
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] += 0.0F;
    high[k] += 0.0F;
  }
  return {low, high};
}

Json groundMaterial() {
  return {{"name", "ground"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
}

GltfContent terrainContent(const TriangleMesh& mesh, const FramedPositions& framed,
                           const std::vector<float>& errors) {
  GltfContent content;
  Json& document = content.document;
  document = {
      {"asset", {{"version", "2.0"}, {"generator", "Arete"}, {"extras", {{"arete", toJson(framed.frame)}}}}}};
  // glTF has no empty accessors, so a mesh without triangles has no scene either.
  if (mesh.triangles.empty()) return content;
  const std::vector<Float3>& positions = framed.positions;
  BufferPlan plan;
  const auto add = [&](std::size_t bytes, const char* type) {
    return plan.add(positions.size(), bytes, bytes, GltfCode::kVertexData, GltfCode::kFloat, type);
  };
  Json attributes = {{"POSITION", add(sizeof(Float3), "VEC3")}};
  const auto [low, high] = boxOf(positions);
  plan.accessors[0]["min"] = {double{low[0]}, double{low[1]}, double{low[2]}};
  plan.accessors[0]["max"] = {double{high[0]}, double{high[1]}, double{high[2]}};
  attributes["NORMAL"] = add(sizeof(Float3), "VEC3");
  if (!errors.empty()) attributes["_ERROR"] = add(sizeof(float), "SCALAR");
  constexpr std::size_t kIndexBytes = sizeof(std::uint32_t);
  const std::size_t indices = plan.add(3 * mesh.triangles.size(), kIndexBytes, kIndexBytes,
                                       GltfCode::kIndexData, GltfCode::kUnsignedInt, "SCALAR");
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", {0}}}};
  document["nodes"] = {{{"name", "terrain"}, {"mesh", 0}}};
  document["materials"] = Json::array({groundMaterial()});
  document["meshes"] = {
      {{"name", "terrain"},
       {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
  document["accessors"] = std::move(plan.accessors);
  document["bufferViews"] = std::move(plan.views);
  document["buffers"] = {{{"byteLength", plan.size}}};
  content.bufferSize = plan.size;
  // The buffer follows the plan: positions, normals, errors, then indices.
  content.writeBuffer = [&mesh, &framed, &errors](ByteSink& sink) {
    return writeAll(sink, framed.positions) && writeAll(sink, normalsOf(mesh, framed.positions)) &&
           writeAll(sink, errors) && writeAll(sink, mesh.triangles);
  };
  return content;
}

}  // namespace arete
