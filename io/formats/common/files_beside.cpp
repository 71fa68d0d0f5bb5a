// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a path are looked up one by one below the folder of the mesh; what was found must lie there
// too once its links are resolved.
#include "io/formats/common/files_beside.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/files/text/utf8.h"
#include "io/files/text_scan.h"
#include "io/geo/gdal/confined.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

/// Of larger folders only so many entries are looked at for a name in another case.
constexpr std::size_t kMostListed = 100'000;

bool isAddress(std::string_view name) {
  return name.starts_with("data:") || name.find("://") != std::string_view::npos;
}

}  // namespace

std::string pathBelow(std::string_view path) {
  const auto isSeparator = [](char c) { return c == '/' || c == '\\'; };
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool hasDrive = path.size() > 1 && isLetter(path[0]) && path[1] == ':';
  if (hasDrive) path.remove_prefix(2);
  bool leadsOut = hasDrive || (!path.empty() && isSeparator(path.front()));
  std::vector<std::string_view> parts;
  std::string_view last;
  while (!path.empty()) {
    const auto end = static_cast<std::size_t>(std::ranges::find_if(path, isSeparator) - path.begin());
    last = path.substr(0, end);
    const bool isFolder = end < path.size();
    path.remove_prefix(std::min(end + 1, path.size()));
    if (last.empty() || last == ".") {
      // The same folder.
    } else if (last != "..") {
      parts.push_back(last);
    } else if (!parts.empty()) {
      parts.pop_back();
    } else {
      leadsOut = true;
    }
    if (isFolder) last = {};
  }
  if (last.empty() || last == "." || last == "..") return {};
  if (leadsOut) return std::string(last);
  std::string joined;
  for (const std::string_view part : parts) {
    if (!joined.empty()) joined += '/';
    joined += part;
  }
  return joined;
}

/// The entry of a folder that has a name, perhaps in another case; empty: none.
std::string FilesBeside::entryOf(const fs::path& folder, const std::string& name) const {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder / name, error))) return name;
  const auto [listing, isNew] = listings_.try_emplace(folder);
  if (isNew) {
    std::size_t count = 0;
    for (fs::directory_iterator at(folder, error), end; !error && at != end && count < kMostListed;
         at.increment(error), ++count) {
      const std::string entry = at->path().filename().string();
      // Of several names that differ in case alone the first in the order of bytes, on every file system.
      const auto [known, isFirst] = listing->second.emplace(text::lowered(text::asUtf8(entry)), entry);
      if (!isFirst) known->second = std::min(known->second, entry);
    }
  }
  const auto found = listing->second.find(text::lowered(text::asUtf8(name)));
  return found == listing->second.end() ? std::string() : found->second;
}

Result<std::string> FilesBeside::find(const std::string& name) const {
  if (isAddress(name)) return failure(ErrorCode::unsupported, "is an address, which is not read", name);
  const std::string below = name.find('\0') == std::string::npos ? pathBelow(name) : std::string();
  if (below.empty()) return failure(ErrorCode::unsupported, "is not the name of a file", name);
  if (folder_.empty())
    return failure(ErrorCode::unsupported, "is a file, and the mesh came without a folder", name);
  std::string found;
  for (std::string_view rest = below; !rest.empty();) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string entry = entryOf(folder_ / found, std::string(rest.substr(0, slash)));
    if (entry.empty()) return failure(ErrorCode::notFound, "does not exist", name);
    found += (found.empty() ? "" : "/") + entry;
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  std::error_code error;
  const fs::path inside = fs::canonical(folder_, error);
  const fs::path file = error ? fs::path() : fs::canonical(folder_ / found, error);
  if (error) return failure(ErrorCode::notFound, "does not exist", name);
  if (std::mismatch(inside.begin(), inside.end(), file.begin(), file.end()).first != inside.end())
    return failure(ErrorCode::unsupported, "is a link that leads out of the folder of the mesh", name);
  if (!mayRead(folder_ / found))
    return failure(ErrorCode::unsupported, "is another file, which is not read", name);
  return found;
}

}  // namespace arete
