// SPDX-License-Identifier: GPL-3.0-or-later
//
// The child decodes and sends: the points and indices, then for each attribute its numbers and bytes. The
// parent trusts none of it: a child whose memory was overwritten may send anything.
#include "io/formats/glb/draco.h"

#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/isolated.h"

namespace arete {
namespace {

// A corner table, its seams and the prediction take about this many times what the mesh takes.
constexpr std::uint64_t kWorkPerByte = 16;
// Address space that malloc() reserves for the first block of a thread, which is not used memory.
constexpr std::uint64_t kHeapBytes = std::uint64_t{256} << 20;
// No mesh of use shrinks more than this: below a hundredth of a bit for a triangle.
constexpr std::uint64_t kMostExpansion = 1 << 14;
// What stands before the bytes of an attribute; the largest number of attributes.
constexpr std::uint64_t kRecordBytes = 5 * sizeof(std::uint64_t), kMostAttributes = 1024;

std::optional<ScalarType> typeOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ScalarType::int8;
    case draco::DT_UINT8:
      return ScalarType::uint8;
    case draco::DT_INT16:
      return ScalarType::int16;
    case draco::DT_UINT16:
      return ScalarType::uint16;
    case draco::DT_INT32:
      return ScalarType::int32;
    case draco::DT_UINT32:
      return ScalarType::uint32;
    case draco::DT_FLOAT32:
      return ScalarType::float32;
    case draco::DT_FLOAT64:
      return ScalarType::float64;
    default:
      return std::nullopt;
  }
}

void put(std::string& to, std::uint64_t number) {
  to.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Runs in the child.
Result<std::string> decodeHere(std::string_view bytes, std::uint64_t mostBytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  const auto kind = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!kind.ok()) return failure(ErrorCode::corrupt, "is no Draco bitstream");
  if (kind.value() != draco::TRIANGULAR_MESH)
    return failure(ErrorCode::unsupported, "is a Draco bitstream of something other than triangles");
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    const draco::Status status = decoded.status();
    const bool isUnknown = status.code() == draco::Status::UNKNOWN_VERSION ||
                           status.code() == draco::Status::UNSUPPORTED_VERSION ||
                           status.code() == draco::Status::UNSUPPORTED_FEATURE;
    return failure(isUnknown ? ErrorCode::unsupported : ErrorCode::corrupt,
                   fmt::format("cannot be decoded by Draco: {:.200}", status.error_msg_string()));
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const std::uint64_t points = mesh->num_points(), faces = mesh->num_faces();
  std::uint64_t needed = faces * 3 * sizeof(std::uint32_t);
  for (int i = 0; i < mesh->num_attributes(); ++i)
    needed += points * static_cast<std::uint64_t>(draco::DataTypeLength(mesh->attribute(i)->data_type())) *
              static_cast<std::uint64_t>(mesh->attribute(i)->num_components());
  if (needed > mostBytes)
    return failure(ErrorCode::corrupt,
                   fmt::format("has {} points and {} triangles, more than is announced", points, faces));
  std::string answer;
  answer.reserve(needed + kRecordBytes * (1 + static_cast<std::uint64_t>(mesh->num_attributes())));
  put(answer, points);
  put(answer, faces * 3);
  for (draco::FaceIndex f(0); f.value() < faces; ++f)
    for (const draco::PointIndex& corner : mesh->face(f)) {
      const std::uint32_t index = corner.value();
      answer.append(reinterpret_cast<const char*>(&index), sizeof index);
    }
  for (int i = 0; i < mesh->num_attributes(); ++i) {
    const draco::PointAttribute& attribute = *mesh->attribute(i);
    const auto type = typeOf(attribute.data_type());
    if (!type) continue;
    put(answer, attribute.unique_id());
    put(answer, attribute.num_components());
    put(answer, static_cast<std::uint64_t>(*type));
    put(answer, attribute.normalized() ? 1 : 0);
    const std::size_t element = sizeOf(*type) * attribute.num_components();
    put(answer, points * element);
    std::string value(std::max<std::size_t>(element, static_cast<std::size_t>(attribute.byte_stride())),
                      '\0');
    for (draco::PointIndex p(0); p.value() < points; ++p) {
      attribute.GetMappedValue(p, value.data());
      answer.append(value, 0, element);
    }
  }
  return answer;
}

/// Takes numbers and bytes from the front of an answer.
class Answer {
 public:
  explicit Answer(std::string_view bytes) : bytes_(bytes) {}

  bool isAtEnd() const { return bytes_.empty(); }
  std::optional<std::uint64_t> number() {
    const auto bytes = take(sizeof(std::uint64_t));
    if (!bytes) return std::nullopt;
    std::uint64_t value = 0;
    std::memcpy(&value, bytes->data(), sizeof value);
    return value;
  }
  std::optional<std::string_view> take(std::uint64_t count) {
    if (count > bytes_.size()) return std::nullopt;
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

 private:
  std::string_view bytes_;
};

std::optional<DracoAttribute> attributeOf(Answer& answer, std::uint64_t points) {
  const auto id = answer.number(), components = answer.number(), type = answer.number(),
             normalized = answer.number(), size = answer.number();
  // The numbers are read in turn, so the last one is there only if all are.
  if (!size || *id > 0x7FFFFFFF || *components == 0 || *components > 255 ||
      *type > static_cast<std::uint64_t>(ScalarType::float64))
    return std::nullopt;
  DracoAttribute attribute{.uniqueId = static_cast<int>(*id),
                           .components = static_cast<int>(*components),
                           .type = static_cast<ScalarType>(*type),
                           .normalized = *normalized != 0,
                           .bytes = {}};
  const auto bytes = answer.take(*size);
  if (!bytes || *size != points * sizeOf(attribute.type) * *components) return std::nullopt;
  attribute.bytes = *bytes;
  return attribute;
}

std::optional<DracoMesh> meshOf(std::string_view bytes) {
  Answer answer(bytes);
  DracoMesh mesh;
  const auto points = answer.number(), indices = answer.number();
  if (!points || !indices || *points > 0xFFFFFFFF || *indices % 3 != 0 || *indices > bytes.size())
    return std::nullopt;
  mesh.points = *points;
  // The list is taken before memory is allocated, so its length is at most the answer's.
  const auto list = answer.take(*indices * sizeof(std::uint32_t));
  if (!list) return std::nullopt;
  mesh.indices.resize(*indices);
  std::memcpy(mesh.indices.data(), list->data(), list->size());
  if (std::ranges::any_of(mesh.indices, [&](std::uint32_t index) { return index >= *points; }))
    return std::nullopt;
  while (!answer.isAtEnd()) {
    auto attribute = attributeOf(answer, *points);
    if (!attribute || mesh.attributes.size() == kMostAttributes) return std::nullopt;
    mesh.attributes.push_back(std::move(*attribute));
  }
  return mesh;
}

}  // namespace

Result<DracoMesh> decodeDraco(std::string_view bytes, std::uint64_t mostBytes,
                              const RunContext& context) try {
  const std::uint64_t most = std::min<std::uint64_t>(mostBytes, bytes.size() * kMostExpansion);
  const IsolationLimits limits{.memoryBytes = kHeapBytes + kWorkPerByte * most + 2 * bytes.size(),
                               .answerBytes = most + kRecordBytes * (1 + kMostAttributes),
                               .seconds = static_cast<unsigned>(60 + bytes.size() / 100'000)};
  const Result<std::string> answer = runIsolated([&] { return decodeHere(bytes, most); }, limits, context);
  if (!answer) {
    // In the child a lack of memory is a lack within its limit.
    if (answer.error().message.empty() || answer.error().code == ErrorCode::internal)
      return failure(ErrorCode::corrupt, "cannot be decoded by Draco");
    return tl::unexpected(answer.error());
  }
  std::optional<DracoMesh> mesh = meshOf(*answer);
  if (!mesh) return failure(ErrorCode::corrupt, "decodes to triangles of points that it does not have");
  return std::move(*mesh);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
