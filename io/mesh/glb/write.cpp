// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GLB is a header, a chunk of JSON and a chunk of bytes; as text, the JSON has the bytes in base 64. The
// bytes are positions, normals, errors and indices, in this order; every element is a multiple of four bytes,
// the alignment that the format requires. A vertex normal is the normalized sum of the cross products of the
// triangles around the vertex, so larger triangles weigh more. It is computed from the rounded positions.
#include "io/mesh/glb/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "io/crs/local_origin.h"
#include "io/crs/map_scale.h"
#include "io/crs/reader.h"
#include "io/file/file_writer.h"
#include "io/gdal/support.h"
#include "io/mesh/glb/base64.h"
#include "io/mesh/glb/frame.h"
#include "io/mesh/losses.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

using Json = nlohmann::ordered_json;
using Float3 = std::array<float, 3>;

constexpr std::size_t kRecordsPerCancelCheck = 1 << 16;
constexpr int kFloat = 5126, kUint = 5125, kVertexData = 34962, kIndexData = 34963;

Result<GlbFrame> frameOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  Georeference georeference;
  if (!options.crsWkt.empty()) {
    registerGdal();
    const auto crs = crsFromText(options.crsWkt);
    if (!crs) return tl::unexpected(crs.error());
    if (const Status ok = describeCrs(*crs, georeference); !ok) return tl::unexpected(ok.error());
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
    // -0 becomes 0: some readers do not take "-0.0" and "0.0" in min and max as equal.
    rounded.push_back(
        {static_cast<float>(q.x) + 0.0F, static_cast<float>(q.y) + 0.0F, static_cast<float>(q.z) + 0.0F});
  }
  return rounded;
}

std::vector<Float3> normalsOf(const TriangleMesh& mesh, const std::vector<Float3>& positions) {
  std::vector<Vec3> sums(positions.size());
  for (const auto& t : mesh.triangles) {
    const Float3 &p = positions[t[0]], &q = positions[t[1]], &r = positions[t[2]];
    const auto from = [&](const Float3& to, std::size_t k) { return double{to[k]} - double{p[k]}; };
    const Vec3 n{from(q, 1) * from(r, 2) - from(q, 2) * from(r, 1),
                 from(q, 2) * from(r, 0) - from(q, 0) * from(r, 2),
                 from(q, 0) * from(r, 1) - from(q, 1) * from(r, 0)};
    for (const std::uint32_t v : t) sums[v] = {sums[v].x + n.x, sums[v].y + n.y, sums[v].z + n.z};
  }
  std::vector<Float3> normals;
  normals.reserve(sums.size());
  for (const Vec3& s : sums) {
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

/// Collects the views and accessors of the one buffer.
struct BufferPlan {
  Json views = Json::array(), accessors = Json::array();
  std::uint64_t size = 0;

  std::size_t add(std::size_t count, std::size_t bytesEach, int target, int component, const char* type) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", size}, {"byteLength", count * bytesEach}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    size += count * bytesEach;
    return accessors.size() - 1;
  }
};

Json documentOf(const TriangleMesh& mesh, const std::vector<Float3>& positions, bool hasErrors,
                const GlbFrame& frame, std::uint64_t& bufferSize) {
  Json document = {
      {"asset", {{"version", "2.0"}, {"generator", "Arete"}, {"extras", {{"arete", toJson(frame)}}}}}};
  bufferSize = 0;
  if (mesh.triangles.empty()) return document;
  BufferPlan plan;
  Json attributes = {{"POSITION", plan.add(positions.size(), sizeof(Float3), kVertexData, kFloat, "VEC3")}};
  Float3 low = positions[0], high = positions[0];
  for (const Float3& p : positions)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  plan.accessors[0]["min"] = {double{low[0]}, double{low[1]}, double{low[2]}};
  plan.accessors[0]["max"] = {double{high[0]}, double{high[1]}, double{high[2]}};
  attributes["NORMAL"] = plan.add(positions.size(), sizeof(Float3), kVertexData, kFloat, "VEC3");
  if (hasErrors)
    attributes["_ERROR"] = plan.add(positions.size(), sizeof(float), kVertexData, kFloat, "SCALAR");
  const std::size_t indices =
      plan.add(3 * mesh.triangles.size(), sizeof(std::uint32_t), kIndexData, kUint, "SCALAR");
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", {0}}}};
  document["nodes"] = {{{"name", "terrain"}, {"mesh", 0}}};
  document["materials"] = {
      {{"name", "ground"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
  document["meshes"] = {
      {{"name", "terrain"},
       {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
  document["accessors"] = std::move(plan.accessors);
  document["bufferViews"] = std::move(plan.views);
  document["buffers"] = {{{"byteLength", plan.size}}};
  bufferSize = plan.size;
  return document;
}

/// Where the bytes of the buffer go: into the file, or in base 64.
class ByteSink {
 public:
  ByteSink(FileWriter& file, bool isText) : file_(file), isText_(isText) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::string_view bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (!isText_) return file_.write(bytes);
    base64_.add(bytes, text_);
    if (text_.size() >= kTextAtOnce) writeText();
  }
  void finish() {
    base64_.finish(text_);
    writeText();
  }

 private:
  static constexpr std::size_t kTextAtOnce = 1 << 16;
  void writeText() {
    file_.write(text_);
    text_.clear();
  }

  FileWriter& file_;
  bool isText_;
  Base64Writer base64_;
  std::string text_;
};

/// Writes the elements one by one. False if the context was cancelled.
template <class Values>
bool writeAll(ByteSink& sink, const Values& values, const RunContext& context, double from, double to) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % kRecordsPerCancelCheck == 0) {
      context.report("writing the mesh",
                     from + (to - from) * static_cast<double>(i) / static_cast<double>(values.size()));
      if (context.cancelled()) return false;
    }
    sink.put(values[i]);
  }
  return true;
}

/// Writes the JSON with the buffer in it.
///
/// @param writeBuffer Writes the bytes. False if it was cancelled.
Status writeText(Json document, FileWriter& file, const std::function<bool(ByteSink&)>& writeBuffer) {
  const bool hasBuffer = document.contains("buffers");
  constexpr std::string_view kBegin = "data:application/octet-stream;base64,";
  if (hasBuffer) document["buffers"][0]["uri"] = kBegin;
  const std::string json = document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  // The buffers are the last list of the document.
  const std::size_t at = hasBuffer ? json.rfind(kBegin) + kBegin.size() : json.size();
  file.write(std::string_view(json).substr(0, at));
  ByteSink sink(file, true);
  if (hasBuffer && !writeBuffer(sink)) return failure(ErrorCode::interrupted, "writing was interrupted");
  sink.finish();
  file.write(std::string_view(json).substr(at));
  return {};
}

Status writeTo(const TriangleMesh& mesh, const std::filesystem::path& path, bool asText,
               const MeshWriteOptions& options, const RunContext& context) {
  const Result<GlbFrame> spec = frameOf(mesh, options);
  if (!spec) return tl::unexpected(spec.error());
  const Result<LocalFrame> frame = LocalFrame::create(spec->local);
  if (!frame) return tl::unexpected(frame.error());
  const auto positions = roundedPositions(mesh, *frame);
  if (!positions) return tl::unexpected(positions.error());
  const std::vector<float> errors = vertexErrors(mesh, options.triangleErrors);
  std::uint64_t bufferSize = 0;
  Json document = documentOf(mesh, *positions, !errors.empty(), *spec, bufferSize);
  const auto writeBuffer = [&](ByteSink& sink) {
    return writeAll(sink, *positions, context, 0, 0.25) &&
           writeAll(sink, normalsOf(mesh, *positions), context, 0.25, 0.5) &&
           writeAll(sink, errors, context, 0.5, 0.6) && writeAll(sink, mesh.triangles, context, 0.6, 1);
  };
  if (asText) {
    if (bufferSize > std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::invalidData,
                     fmt::format("{} bytes are more than Arete reads from a glTF, 4 GiB", bufferSize));
    Result<FileWriter> file = FileWriter::create(path);
    if (!file) return tl::unexpected(file.error());
    if (Status written = writeText(std::move(document), *file, writeBuffer); !written) return written;
    return file->finish();
  }
  std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + json.size() + (bufferSize > 0 ? 8 + bufferSize : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    return failure(ErrorCode::invalidData,
                   fmt::format("{} bytes are more than a GLB can hold, 4 GiB", total));

  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return tl::unexpected(file.error());
  const auto put = [&](std::uint64_t value) {
    putBytes(file->reserve(sizeof(std::uint32_t)), static_cast<std::uint32_t>(value));
  };
  file->write("glTF");
  put(2);
  put(total);
  put(json.size());
  file->write("JSON");
  file->write(json);
  if (bufferSize > 0) {
    put(bufferSize);
    file->write(std::string_view("BIN\0", 4));
    ByteSink sink(*file, false);
    if (!writeBuffer(sink)) return failure(ErrorCode::interrupted, "writing was interrupted");
  }
  return file->finish();
}

Result<MeshWriteReport> write(MeshRef written, const std::filesystem::path& path, bool asText,
                              const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  Status status = written.validate();
  if (!status) status = failure(ErrorCode::invalidData, status.error().message);
  if (status && !options.triangleErrors.empty() && options.triangleErrors.size() != mesh.triangles.size())
    status = failure(
        ErrorCode::invalidData,
        fmt::format("{} errors for {} triangles", options.triangleErrors.size(), mesh.triangles.size()));
  if (status) status = writeTo(mesh, path, asText, options, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path.string();
  if (!status) return tl::unexpected(status.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace

Result<MeshWriteReport> writeGlb(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  return write(mesh, path, false, options, context);
}

Result<MeshWriteReport> writeGltf(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options, const RunContext& context) {
  return write(mesh, path, true, options, context);
}

}  // namespace arete
