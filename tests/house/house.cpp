// SPDX-License-Identifier: GPL-3.0-or-later
#include "house/house.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

namespace arete::house {
namespace fs = std::filesystem;

Rooms readRooms(const fs::path& path) {
  Rooms rooms;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 1));
    std::set<std::string>& declared = rooms[line.substr(0, colon)];
    for (std::string word; words >> word;) declared.insert(word);
  }
  return rooms;
}

std::vector<fs::path> filesOf(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && (entry.path().extension() == ".h" || entry.path().extension() == ".cpp"))
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> includesOf(const fs::path& file) {
  std::vector<std::string> names;
  std::ifstream stream(file);
  const std::string start = "#include \"";
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(start)) continue;
    names.push_back(line.substr(start.size(), line.find('"', start.size()) - start.size()));
  }
  return names;
}

std::vector<std::string> undeclaredIncludes(const Rooms& rooms, const fs::path& root) {
  std::vector<std::string> sentences;
  for (const auto& [room, declared] : rooms)
    for (const fs::path& file : filesOf(root / room))
      for (const std::string& name : includesOf(file)) {
        const std::string other = fs::path(name).parent_path().string();
        if (other == room || declared.contains(other)) continue;
        sentences.push_back(fmt::format("{} includes {}, but {} does not declare {}",
                                        fs::relative(file, root).string(), name, room, other));
      }
  return sentences;
}

std::vector<std::string> unusedDeclarations(const Rooms& rooms, const fs::path& root) {
  std::vector<std::string> sentences;
  for (const auto& [room, declared] : rooms) {
    std::set<std::string> used;
    for (const fs::path& file : filesOf(root / room))
      for (const std::string& name : includesOf(file)) used.insert(fs::path(name).parent_path().string());
    for (const std::string& other : declared)
      if (!used.contains(other))
        sentences.push_back(fmt::format("{} declares {} and includes none of it", room, other));
  }
  return sentences;
}

std::vector<std::string> findCircle(const Rooms& rooms) {
  std::set<std::string> done;
  std::vector<std::string> path, circle;
  const std::function<bool(const std::string&)> visit = [&](const std::string& room) {
    if (const auto at = std::ranges::find(path, room); at != path.end()) {
      circle.assign(at, path.end());
      circle.push_back(room);
      return true;
    }
    if (done.contains(room) || !rooms.contains(room)) return false;
    path.push_back(room);
    for (const std::string& other : rooms.at(room))
      if (visit(other)) return true;
    path.pop_back();
    done.insert(room);
    return false;
  };
  for (const auto& [room, declared] : rooms)
    if (visit(room)) break;
  return circle;
}

}  // namespace arete::house
