// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GLB is a header, a chunk of JSON and a chunk of bytes; as text, the JSON has the bytes in base 64.
#include "io/formats/glb/writer/container.h"

#include <fmt/format.h>

#include <cassert>
#include <limits>
#include <utility>

namespace arete {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

tl::unexpected<Error> interrupted() {
  return failure(ErrorCode::interrupted, "writing was interrupted");
}

Status writeText(GltfContent content, const std::filesystem::path& path, const RunContext& context) {
  if (content.bufferSize > kMost)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} bytes are more than Arete reads from a glTF, 4 GiB", content.bufferSize));
  ARETE_TRY(FileWriter file, FileWriter::create(path));
  const bool hasBuffer = content.document.contains("buffers");
  constexpr std::string_view kBegin = "data:application/octet-stream;base64,";
  if (hasBuffer) content.document["buffers"][0]["uri"] = kBegin;
  const std::string json = content.document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  // The buffers are the last list of the document.
  const std::size_t at = hasBuffer ? json.rfind(kBegin) + kBegin.size() : json.size();
  file.write(std::string_view(json).substr(0, at));
  ByteSink sink(file, true, content.bufferSize, context);
  if (hasBuffer && !content.writeBuffer(sink)) return interrupted();
  assert(sink.written() == content.bufferSize);
  sink.finish();
  file.write(std::string_view(json).substr(at));
  return file.finish();
}

Status writeBinary(const GltfContent& content, const std::filesystem::path& path, const RunContext& context) {
  std::string json = content.document.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + json.size() + (content.bufferSize > 0 ? 8 + content.bufferSize : 0);
  if (total > kMost)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} bytes are more than a GLB can hold, 4 GiB", total));

  ARETE_TRY(FileWriter file, FileWriter::create(path));
  const auto put = [&](std::uint64_t value) {
    putBytes(file.reserve(sizeof(std::uint32_t)), static_cast<std::uint32_t>(value));
  };
  file.write("glTF");
  put(2);
  put(total);
  put(json.size());
  file.write("JSON");
  file.write(json);
  if (content.bufferSize > 0) {
    put(content.bufferSize);
    file.write(std::string_view("BIN\0", 4));
    ByteSink sink(file, false, content.bufferSize, context);
    if (!content.writeBuffer(sink)) return interrupted();
    assert(sink.written() == content.bufferSize);
  }
  return file.finish();
}

}  // namespace

Status writeContainer(GltfContent content, const std::filesystem::path& path, bool asText,
                      const RunContext& context) {
  return asText ? writeText(std::move(content), path, context) : writeBinary(content, path, context);
}

}  // namespace arete
