// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's decoders are safe for any bytes, but take counts and strides as given, so these are checked
// first, by the text of the extension. Then no memory is taken that the source cannot fill: a triangle has
// at least a byte, so has an index of a sequence, and each byte of 16 attributes has at least a quarter.
#include "io/formats/glb/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "engine/base/caught_failure.h"
#include "io/formats/glb/corrupt.h"

namespace arete {
namespace {

constexpr std::uint64_t kAttributesPerByte = 64;

Status checkFilter(std::string_view filter, std::uint64_t stride) {
  if (filter.empty() || filter == "NONE") return {};
  const bool isOctahedral = filter == "OCTAHEDRAL", isQuaternion = filter == "QUATERNION";
  if (!isOctahedral && !isQuaternion && filter != "EXPONENTIAL")
    return failure(ErrorCode::unsupported, fmt::format("the meshopt filter {} is unknown", filter));
  if ((isOctahedral && stride != 4 && stride != 8) || (isQuaternion && stride != 8))
    return corrupt(fmt::format("a stride of {} does not fit the meshopt filter {}", stride, filter));
  return {};
}

Status checkAttributes(std::string_view source, std::uint64_t count, std::uint64_t stride) {
  if (stride == 0 || stride % 4 != 0 || stride > 256)
    return corrupt(fmt::format("attributes that meshopt compressed have a stride of {}", stride));
  if (count > source.size() * kAttributesPerByte / stride)
    return corrupt(fmt::format("{} bytes of meshopt compression cannot hold {} elements of {} bytes",
                               source.size(), count, stride));
  return {};
}

Status checkIndices(std::string_view source, std::uint64_t count, std::uint64_t stride, bool areTriangles) {
  if (stride != 2 && stride != 4)
    return corrupt(fmt::format("indices that meshopt compressed have a stride of {}", stride));
  if (areTriangles && count % 3 != 0)
    return corrupt(fmt::format("{} indices that meshopt compressed are no triangles", count));
  if ((areTriangles ? count / 3 : count) > source.size())
    return corrupt(
        fmt::format("{} bytes of meshopt compression cannot hold {} indices", source.size(), count));
  return {};
}

/// The first byte is the kind of the bytes and their version.
Status checkVersion(std::string_view source, unsigned kind, unsigned latest) {
  const unsigned head = source.empty() ? 0 : static_cast<unsigned char>(source[0]);
  if ((head & 0xF0U) != kind) return corrupt("bytes of meshopt compression do not begin as they must");
  if ((head & 0x0FU) > latest)
    return failure(ErrorCode::unsupported,
                   fmt::format("version {} of meshopt compression is not supported", head & 0x0FU));
  return {};
}

}  // namespace

Result<std::string> decodeMeshopt(std::string_view source, std::uint64_t count, std::uint64_t byteStride,
                                  std::string_view mode, std::string_view filter) try {
  const bool areAttributes = mode == "ATTRIBUTES", areTriangles = mode == "TRIANGLES";
  if (!areAttributes && !areTriangles && mode != "INDICES")
    return failure(ErrorCode::unsupported, fmt::format("the meshopt mode {} is unknown", mode));
  Status valid = areAttributes ? checkFilter(filter, byteStride) : Status{};
  if (!areAttributes && !filter.empty() && filter != "NONE")
    valid = corrupt(fmt::format("indices have the meshopt filter {}", filter));
  if (valid)
    valid = areAttributes ? checkAttributes(source, count, byteStride)
                          : checkIndices(source, count, byteStride, areTriangles);
  if (valid)
    valid = checkVersion(source, areAttributes ? 0xA0 : areTriangles ? 0xE0 : 0xD0, areAttributes ? 0 : 1);
  if (!valid) return tl::unexpected(valid.error());

  std::string decoded(count * byteStride, '\0');
  const auto* const bytes = reinterpret_cast<const unsigned char*>(source.data());
  const int error =
      areAttributes  ? meshopt_decodeVertexBuffer(decoded.data(), count, byteStride, bytes, source.size())
      : areTriangles ? meshopt_decodeIndexBuffer(decoded.data(), count, byteStride, bytes, source.size())
                     : meshopt_decodeIndexSequence(decoded.data(), count, byteStride, bytes, source.size());
  if (error != 0) return corrupt("bytes of meshopt compression cannot be decoded");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, byteStride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, byteStride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, byteStride);
  return decoded;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
