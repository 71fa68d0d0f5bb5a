// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture is placed by trying its own path, then the same with "-1", "-2" behind the name, until there is
// no file, or one of the same bytes.
#include "io/formats/common/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/file_writer.h"
#include "io/files/no_file.h"
#include "io/files/output_file.h"
#include "io/files/text_scan.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 10'000;

struct Kind {
  std::string_view mimeType, extension;  // the first extension of a type is the one given to its files
};
constexpr std::array kKinds = {
    Kind{"image/png", "png"},         Kind{"image/jpeg", "jpg"},  Kind{"image/jpeg", "jpeg"},
    Kind{"image/webp", "webp"},       Kind{"image/ktx2", "ktx2"}, Kind{"image/vnd-ms.dds", "dds"},
    Kind{"image/bmp", "bmp"},         Kind{"image/gif", "gif"},   Kind{"image/tiff", "tif"},
    Kind{"image/tiff", "tiff"},       Kind{"image/x-tga", "tga"}, Kind{"image/x-exr", "exr"},
    Kind{"image/vnd.radiance", "hdr"}};

std::string mimeTypeOf(std::string_view bytes, std::string_view name, std::string_view stated) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kStarts = {{
      {"\x89PNG\r\n\x1A\n"sv, "image/png"},
      {"\xFF\xD8\xFF"sv, "image/jpeg"},
      {"\xABKTX 20\xBB"sv, "image/ktx2"},
      {"DDS "sv, "image/vnd-ms.dds"},
      {"GIF8"sv, "image/gif"},
      {"II*\0"sv, "image/tiff"},
      {"MM\0*"sv, "image/tiff"},
      {"\x76\x2F\x31\x01"sv, "image/x-exr"},
      {"#?RADIANCE"sv, "image/vnd.radiance"},
      {"BM"sv, "image/bmp"},
  }};
  for (const auto& [start, type] : kStarts)
    if (bytes.starts_with(start)) return std::string(type);
  if (bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP") return "image/webp";
  const std::string extension = text::lowerExtension(name);
  for (const Kind& kind : kKinds)
    if (extension == kind.extension) return std::string(kind.mimeType);
  return std::string(stated);
}

std::string extensionOf(std::string_view mimeType) {
  for (const Kind& kind : kKinds)
    if (mimeType == kind.mimeType) return fmt::format(".{}", kind.extension);
  return {};
}

std::string_view viewOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The last part of a name, without what file systems refuse or hide.
std::string fileNameOf(std::string_view name) {
  const std::size_t slash = name.find_last_of("/\\");
  std::string result(slash == std::string_view::npos ? name : name.substr(slash + 1));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 32 || c == 127 || std::strchr("<>:\"|?*#", c) != nullptr) c = '_';
  while (!result.empty() && (result.front() == '.' || result.front() == ' ')) result.erase(0, 1);
  while (!result.empty() && (result.back() == '.' || result.back() == ' ')) result.pop_back();
  constexpr std::size_t kLongest = 200;
  if (result.size() > kLongest) result.erase(0, result.size() - kLongest);
  return result;
}

/// "wood-2.png".
std::string numbered(const std::string& path, int number) {
  if (number == 0) return path;
  const std::size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
  const bool hasExtension = dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
  const std::size_t end = hasExtension ? dot : path.size();
  return fmt::format("{}-{}{}", path.substr(0, end), number, path.substr(end));
}

/// The same path without leading dots of its parts: a file that a mesh brings along is never a hidden one.
std::string unhidden(const std::string& path) {
  std::string result;
  for (const char c : path)
    if (c != '.' || (!result.empty() && result.back() != '/')) result += c;
  return result.empty() || result.back() == '/' ? result + "picture" : result;
}

bool hasBytes(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != bytes.size() || error) return false;
  const Result<FileBytes> file = FileBytes::read(path);
  return file && file->view() == bytes;
}

}  // namespace

PictureSource::PictureSource(const MeshAttributes& mesh, fs::path folder)
    : mesh_(mesh), files_(std::move(folder)) {
  std::set<std::string> taken;
  for (const EmbeddedPicture& picture : mesh.pictures) {
    std::string name = fileNameOf(picture.name);
    const std::string type = mimeTypeOf(viewOf(picture.bytes), name, picture.mimeType);
    if (name.empty()) name = "picture";
    // A name may have a dot and no extension: "Wood 1.5 m".
    if (mimeTypeOf({}, name, {}) != type) name += extensionOf(type);
    // Some file systems ignore case, so names that differ only in it get numbers.
    int number = 0;
    while (!taken.insert(text::lowered(numbered(name, number))).second) ++number;
    names_.push_back(numbered(name, number));
  }
}

Result<PictureBytes> PictureSource::read(const std::string& picture) const {
  if (picture.starts_with('#')) {
    std::size_t number = 0;
    const char* const end = picture.data() + picture.size();
    const auto [behind, error] = std::from_chars(picture.data() + 1, end, number);
    if (error != std::errc{} || behind != end || number >= mesh_.pictures.size())
      return failure(ErrorCode::notFound, "is no picture of the mesh", picture);
    const EmbeddedPicture& embedded = mesh_.pictures[number];
    return PictureBytes{.name = names_[number],
                        .path = names_[number],
                        .mimeType = mimeTypeOf(viewOf(embedded.bytes), names_[number], embedded.mimeType),
                        .bytes = embedded.bytes};
  }
  ARETE_TRY(const std::string path, files_.find(picture));
  const Result<FileBytes> file = FileBytes::read(files_.folder() / path);
  if (!file) return failure(file.error().code, file.error().message, picture);
  const auto* const first = reinterpret_cast<const std::byte*>(file->begin());
  return PictureBytes{.name = path.substr(path.find_last_of('/') + 1),
                      .path = path,
                      .mimeType = mimeTypeOf(file->view(), path, {}),
                      .bytes = {first, first + file->size()}};
}

PicturePlacer::PicturePlacer(const PictureSource& source, fs::path mesh)
    : source_(source), mesh_(std::move(mesh)) {
  taken_.insert(text::lowered(mesh_.filename().string()));
}

Result<std::string> PicturePlacer::place(const std::string& picture) {
  if (const auto known = placed_.find(picture); known != placed_.end()) return known->second;
  const bool isEmbedded = picture.starts_with('#');
  // A picture that cannot be copied keeps its path; an embedded one has none.
  const auto leave = [&](std::string_view reason) {
    warnings_.push_back(
        {WarningCode::omitted, fmt::format("the picture {}, which {}", text::quotedToken(picture), reason)});
    return placed_[picture] = isEmbedded ? std::string() : picture;
  };
  const Result<PictureBytes> bytes = source_.read(picture);
  if (!bytes) return leave(bytes.error().message);
  if (isNoFile(mesh_)) {
    placed_[picture] = leave("has no place beside a pipe");
    return placed_[picture];
  }
  Result<std::string> path = write(*bytes);
  if (path) placed_[picture] = *path;
  return path;
}

Result<std::string> PicturePlacer::write(const PictureBytes& picture) {
  const fs::path folder = mesh_.parent_path();
  const std::string_view bytes = viewOf(picture.bytes);
  const auto use = [&](const std::string& path) {
    taken_.insert(text::lowered(path));
    if (std::ranges::find(files_, folder / path) == files_.end()) files_.push_back(folder / path);
    return path;
  };
  const std::string mesh = text::lowered(mesh_.filename().string());  // is written last, over what is there
  if (text::lowered(picture.path) != mesh && hasBytes(OutputGroup::placeOf(folder / picture.path), bytes))
    return use(picture.path);
  const std::string wanted = unhidden(picture.path);
  for (int number = 0; number < kMostNames; ++number) {
    const std::string path = numbered(wanted, number);
    if (text::lowered(path) != mesh && hasBytes(OutputGroup::placeOf(folder / path), bytes)) return use(path);
    std::error_code error;
    if (taken_.contains(text::lowered(path)) || fs::exists(fs::symlink_status(folder / path, error)))
      continue;
    if (const fs::path below = (folder / path).parent_path(); !below.empty())
      fs::create_directories(below, error);
    ARETE_TRY(FileWriter file, FileWriter::create(folder / path));
    file.write(bytes);
    ARETE_CHECK(file.finish());
    return use(path);
  }
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot be written: {} files have its name and other bytes", kMostNames),
                 (folder / wanted).string());
}

}  // namespace arete
