// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file is binary if its size is the one that its triangle count implies. Otherwise it is ASCII if it begins
// with "solid" (any case, after blanks) and its start is text; binary headers may begin with that word, but
// bytes that no text has follow. Otherwise it is binary: with bytes to spare, which are left out with a
// warning, or truncated.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text_decoder.h"
#include "io/files/text_scan.h"
#include "io/formats/stl/read_parts.h"
#include "io/formats/stl/stl.h"

namespace arete {

namespace {

/// Bytes at the start of a file that show whether it is a text.
constexpr std::size_t kProbe = 4096;

std::uint32_t binaryCount(std::string_view file) {
  std::uint32_t count = 0;
  std::memcpy(&count, file.data() + kStlHeaderSize, sizeof count);
  return count;
}

std::uint64_t binarySize(std::uint32_t count) {
  return kStlPreambleSize + std::uint64_t{count} * kStlRecordSize;
}

bool isAscii(std::string_view file) {
  const std::string_view start = file.substr(0, kProbe);
  while (!file.empty() && text::isSpace(file.front())) file.remove_prefix(1);
  const bool beginsWithSolid =
      file.size() > 5 && equalsStlWord(file.substr(0, 5), "solid") && text::isSpace(file[5]);
  return beginsWithSolid && std::ranges::none_of(start, [](char c) {
           return static_cast<unsigned char>(c) < 32 && !text::isSpace(c);
         });
}

}  // namespace

Result<MeshFile> readStl(const std::filesystem::path& path, const RunContext& context) {
  ARETE_TRY(FileBytes bytes, FileBytes::read(path));
  const bool hasPreamble = bytes.size() >= kStlPreambleSize;
  const std::uint32_t count = hasPreamble ? binaryCount(bytes.view()) : 0;
  if (hasPreamble && bytes.size() == binarySize(count))
    return readBinaryStl(bytes.view(), count, path.string(), context);
  if (TextDecoder::isNeededFor(bytes.view().substr(0, kProbe))) {
    ARETE_TRY(FileBytes text, FileBytes::readText(path));
    if (isAscii(text.view())) return readAsciiStl(text.view(), path.string(), context);
  }
  const std::string_view file = bytes.view();
  if (isAscii(file)) return readAsciiStl(file, path.string(), context);
  const std::uint64_t spare =
      hasPreamble && file.size() > binarySize(count) ? file.size() - binarySize(count) : 0;
  if (count > 0 && spare % kStlRecordSize != 0) {
    Result<MeshFile> mesh = readBinaryStl(file.substr(0, binarySize(count)), count, path.string(), context);
    if (mesh)
      mesh->warnings.push_back({WarningCode::omitted, fmt::format("{} left out behind its {}",
                                                                  counted(spare, "byte is", "bytes are"),
                                                                  counted(count, "triangle", "triangles"))});
    return mesh;
  }
  if (file.size() < kStlPreambleSize)
    return failure(
        ErrorCode::corrupt,
        fmt::format("is not an STL: it has {} bytes, does not begin with \"solid\", and a binary one begins "
                    "with {} bytes of header",
                    file.size(), kStlPreambleSize),
        path.string());
  return failure(
      ErrorCode::corrupt,
      spare > 0
          ? fmt::format("is not an STL, or its header is wrong: it states {} triangles, and {} bytes "
                        "follow them, as many as {} more",
                        count, spare, spare / kStlRecordSize)
          : fmt::format("is truncated or not an STL: {} {} bytes, the file has {}",
                        counted(count, "triangle needs", "triangles need"), binarySize(count), file.size()),
      path.string());
}

}  // namespace arete
