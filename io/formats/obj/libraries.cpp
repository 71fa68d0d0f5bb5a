// SPDX-License-Identifier: GPL-3.0-or-later
//
// "mtllib a b.mtl" may be one file or two: the longest run of words that is the name of a file is one.
#include "io/formats/obj/libraries.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text/utf8.h"
#include "io/files/text_scan.h"
#include "io/formats/common/files_beside.h"
#include "io/formats/obj/mtl.h"

namespace arete {
namespace {

/// A file that names more libraries than this is no model.
constexpr std::size_t kMostLibraries = 256;
/// Of a line of more words, each is a file.
constexpr std::size_t kMostWords = 16;
constexpr std::size_t kMostWarnings = 8;
/// A material takes many times the bytes of its line.
constexpr std::size_t kMostMaterialsOfAll = 1 << 20;

/// Adds a warning unless there are many of its kind.
class LibraryWarnings {
 public:
  explicit LibraryWarnings(Warnings& to) : to_(to) {}
  ~LibraryWarnings() {
    if (count_ > kMostWarnings)
      to_.push_back({WarningCode::omitted,
                     counted(count_ - kMostWarnings, "more library of materials is missing or odd",
                             "more libraries of materials are missing or odd")});
  }
  LibraryWarnings(const LibraryWarnings&) = delete;
  LibraryWarnings& operator=(const LibraryWarnings&) = delete;
  void add(Warning warning) {
    if (count_++ < kMostWarnings) to_.push_back(std::move(warning));
  }
  void addOmitted(std::string sentence) { add({WarningCode::omitted, std::move(sentence)}); }

 private:
  Warnings& to_;
  std::size_t count_ = 0;
};

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    if (text::isSpace(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !text::isSpace(text[end])) ++end;
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string unquoted(std::string_view name) {
  if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  return std::string(name);
}

struct FoundFiles {
  std::vector<std::string> paths;    ///< below the folder
  std::vector<std::string> missing;  ///< "name" and why
};

FoundFiles filesOf(const std::string& line, const FilesBeside& files) {
  FoundFiles found;
  const std::vector<std::string_view> words = wordsOf(line);
  const auto textOf = [&](std::size_t from, std::size_t to) {
    return unquoted({words[from].data(), words[to].data() + words[to].size()});
  };
  for (std::size_t from = 0; from < words.size();) {
    bool isFound = false;
    const std::size_t last = words.size() > kMostWords ? from : words.size() - 1;
    for (std::size_t to = last + 1; to-- > from && !isFound;)
      if (const Result<std::string> path = files.find(textOf(from, to))) {
        found.paths.push_back(*path);
        from = to + 1;
        isFound = true;
      }
    if (isFound) continue;
    // The name ends where a word has the extension, else with the line.
    std::size_t to = from;
    while (to < last && text::lowerExtension(words[to]) != "mtl") ++to;
    const std::string name = textOf(from, to);
    found.missing.push_back(
        fmt::format("{}, which {}", text::quotedToken(name), files.find(name).error().message));
    from = to + 1;
  }
  return found;
}

/// Pictures are named relative to their library: makes that relative to the OBJ. Where there is no such file,
/// but one relative to the OBJ, it is that, as some exporters have it.
void nameFromObj(Material& material, const std::string& library, const FilesBeside& files) {
  const std::size_t slash = library.rfind('/');
  if (slash == std::string::npos) return;
  for (TextureUse& use : material.textures) {
    const std::string below = library.substr(0, slash + 1) + use.picture;
    if (!pathBelow(use.picture).empty() && (files.find(below) || !files.find(use.picture)))
      use.picture = below;
  }
}

}  // namespace

void ObjMaterials::addLibrary(std::string_view files) {
  // Some exporters state the library again for every object.
  if (files.empty() || libraries_.size() > kMostLibraries || isListed_.contains(files)) return;
  isListed_.emplace(files);
  libraries_.emplace_back(files);
}

std::uint32_t ObjMaterials::use(std::string_view name) {
  if (name.empty()) return MeshAttributes::kNone;
  // The library may be in another encoding than the file.
  if (!text::isUtf8(name)) return use(text::asUtf8(name));
  const auto known = numbers_.find(name);
  if (known != numbers_.end()) return known->second;
  if (names_.size() == kMostMaterialsOfAll) {
    ++tooMany_;
    return MeshAttributes::kNone;
  }
  const auto number = static_cast<std::uint32_t>(names_.size());
  numbers_.emplace(name, number);
  names_.emplace_back(name);
  return number;
}

Status ObjMaterials::finish(MeshFile& file, const std::filesystem::path& folder, const RunContext& context) {
  std::vector<Material>& materials = file.mesh.materials;
  LibraryWarnings warnings(file.warnings);
  if (libraries_.size() > kMostLibraries) warnings.addOmitted("it names too many libraries of materials");
  if (tooMany_ > 0)
    warnings.addOmitted(fmt::format("it names more than {} materials; a further one is left out {}",
                                    kMostMaterialsOfAll, counted(tooMany_, "time", "times")));
  const FilesBeside files(folder);
  std::set<std::string> isRead;
  std::map<std::string, std::uint32_t> known;
  for (const std::string& line : libraries_) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted");
    const FoundFiles found = filesOf(line, files);
    for (const std::string& missing : found.missing)
      warnings.addOmitted(fmt::format("its materials are in {}", missing));
    for (const std::string& path : found.paths) {
      if (!isRead.insert(path).second) continue;
      const Result<FileBytes> bytes = FileBytes::readText(folder / path);
      if (!bytes) {
        warnings.addOmitted(fmt::format("its materials are in {}, which {}", text::quotedToken(path),
                                        text::printable(bytes.error().message, 200)));
        continue;
      }
      MtlMaterials library = readMtl(bytes->view());
      for (const Warning& warning : library.warnings)
        warnings.add(warning.behind(fmt::format("of {}: ", text::quotedToken(path))));
      for (Material& material : library.materials) {
        // The library that is named first is searched first.
        if (!known.emplace(material.name, static_cast<std::uint32_t>(materials.size())).second) continue;
        nameFromObj(material, path, files);
        materials.push_back(std::move(material));
      }
    }
  }
  std::vector<std::uint32_t> numberOfUse;
  std::size_t unknown = 0;
  for (const std::string& name : names_) {
    const auto [at, isNew] = known.emplace(name, static_cast<std::uint32_t>(materials.size()));
    if (isNew) {
      ++unknown;
      materials.push_back({.name = name});
    }
    numberOfUse.push_back(at->second);
  }
  if (unknown > 0 && !isRead.empty())
    warnings.addOmitted(fmt::format("{} of its materials {} in no library (the first is {})", unknown,
                                    agreeing(unknown, "is", "are"),
                                    text::quotedToken(materials[materials.size() - unknown].name)));
  for (std::uint32_t& material : file.mesh.materialOf)
    if (material != MeshAttributes::kNone) material = numberOfUse[material];
  return {};
}

}  // namespace arete
