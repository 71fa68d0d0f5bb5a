// SPDX-License-Identifier: GPL-3.0-or-later
//
// PROJ asks the functions of its default context for each file, and contexts that are created later, those of
// GDAL, have the same functions. Its database is opened by SQLite, after these have found it. Files are
// opened without waiting, so that a pipe cannot block, and only regular files are read.
//
// fileNamedBy() looks through the text, whatever its form: PROJ strings stand in WKT too (EXTENSION), and a
// grid is a parameter in WKT 2 and PROJJSON.
#include "io/geo/crs/proj_files.h"

#include <proj.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <vector>

#include "io/files/text_scan.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

struct Allowed {
  std::mutex mutex;
  std::vector<std::string> folders;
  std::string texts;
};

Allowed& allowed() {
  static Allowed instance;
  return instance;
}

std::string normal(const std::string& path) {
  return fs::path(path).lexically_normal().string();
}

void addFolder(std::string folder) {
  folder = normal(folder);
  if (folder.empty() || folder.front() != '/') return;
  if (folder.back() != '/') folder += '/';
  if (folder != "/") allowed().folders.push_back(std::move(folder));
}

void addFolders(const char* list) {
  std::string_view rest = list ? list : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    addFolder(std::string(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

/// Whether a text has a name as a whole: after = , @ or a quotation mark, and up to the next separator.
bool standsIn(std::string_view text, std::string_view name) {
  for (std::size_t at = 0; !name.empty() && (at = text.find(name, at)) != text.npos; ++at) {
    const std::size_t end = at + name.size();
    const bool begins = at > 0 && std::string_view("=,@\"").find(text[at - 1]) != std::string_view::npos;
    const bool ends =
        end == text.size() || std::string_view(",+ \"\n\t").find(text[end]) != std::string_view::npos;
    if (begins && ends) return true;
  }
  return false;
}

bool isAllowed(const char* name) {
  Allowed& a = allowed();
  const std::lock_guard lock(a.mutex);
  if (standsIn(a.texts, name)) return true;
  const std::string path = normal(name);
  return std::ranges::any_of(a.folders, [&](const std::string& folder) { return path.starts_with(folder); });
}

// A name without a path is one of PROJ's data directories, an absolute path or one with ./ or ../ anything.
bool isOutside(std::string_view name) {
  if (name.starts_with('@')) name.remove_prefix(1);
  return name.find_first_of("/\\:~") != name.npos || name.starts_with('.');
}

/// "EPSG:4326", as in +init=epsg:4326, which PROJ looks up in its database.
bool isCode(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == name.npos || colon == 0 || colon + 1 == name.size()) return false;
  const auto isWord = [](std::string_view text) {
    return std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  };
  return isWord(name.substr(0, colon)) && isWord(name.substr(colon + 1));
}

/// The first name outside of a list "a,b,c".
std::string_view firstOutside(std::string_view list) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    if (const std::string_view name = list.substr(0, end); isOutside(name)) return name;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return {};
}

/// The value of +KEY=VALUE that begins at `at`, up to a blank or a quotation mark.
std::string_view valueAt(std::string_view text, std::size_t at) {
  return text.substr(at, std::min(text.find_first_of(" \t\r\n\"'+|]}", at), text.size()) - at);
}

std::string_view namedInProjString(std::string_view text, const std::string& lower) {
  constexpr std::array<std::string_view, 8> kKeys = {"init",     "nadgrids", "geoidgrids", "grids",
                                                     "xy_grids", "z_grids",  "file",       "model"};
  for (const std::string_view key : kKeys) {
    const std::string wanted = std::string(key) + "=";
    for (std::size_t at = 0; (at = lower.find(wanted, at)) != lower.npos; at += wanted.size()) {
      const bool isKey =
          at == 0 || !(std::isalnum(static_cast<unsigned char>(lower[at - 1])) || lower[at - 1] == '_');
      if (!isKey) continue;
      const std::string_view value = valueAt(text, at + wanted.size());
      if (key == "init" && isCode(value)) continue;
      if (const std::string_view name = firstOutside(value); !name.empty()) return name;
    }
  }
  return {};
}

/// The quoted text that follows `at`, after one comma or colon.
std::string_view quotedAfter(std::string_view text, std::size_t at) {
  const std::size_t open = text.find('"', at);
  const std::size_t close = open == text.npos ? open : text.find('"', open + 1);
  return close == text.npos ? std::string_view() : text.substr(open + 1, close - open - 1);
}

std::string_view namedInParameters(std::string_view text, const std::string& lower) {
  for (std::size_t at = 0; (at = lower.find("parameterfile", at)) != lower.npos; at += 13) {
    const std::string_view name = quotedAfter(text, at + 13);
    if (name.data() == nullptr) break;
    const auto end = static_cast<std::size_t>(name.data() - text.data()) + name.size() + 1;
    if (const std::string_view value = quotedAfter(text, end); isOutside(value)) return value;
  }
  // PROJJSON: numbers are the values of all other parameters.
  for (std::size_t at = 0; (at = lower.find("\"value\"", at)) != lower.npos; at += 7) {
    const std::size_t from = text.find_first_not_of(" \t\r\n:", at + 7);
    if (from == text.npos || text[from] != '"') continue;
    if (const std::string_view value = quotedAfter(text, from); isOutside(value)) return value;
  }
  return {};
}

}  // namespace

bool projMayOpen(const char* name) {
  static std::once_flag once;
  std::call_once(once, [] {
    const std::lock_guard lock(allowed().mutex);
    addFolders(proj_info().searchpath);
    addFolders(std::getenv("PROJ_DATA"));
    addFolders(std::getenv("PROJ_LIB"));
  });
  struct stat status {};
  const bool isOther = ::stat(name, &status) == 0 && !S_ISREG(status.st_mode);
  return !isOther && isAllowed(name);
}

void allowProjFiles(const std::string& text) {
  const std::lock_guard lock(allowed().mutex);
  allowed().texts += text + '\n';
}

std::string fileNamedBy(const std::string& crsText) {
  const std::string lower = text::lowered(crsText);
  std::string_view name = namedInProjString(crsText, lower);
  if (name.empty()) name = namedInParameters(crsText, lower);
  return std::string(name);
}

}  // namespace arete
