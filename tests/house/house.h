// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace arete::house {

/// The rooms of the house (arete_room in cmake/AreteTarget.cmake), each with those it may include.
using Rooms = std::map<std::string, std::set<std::string>>;

/// Reads lines "room: room room ...", as the build writes them into rooms.txt.
Rooms readRooms(const std::filesystem::path& path);

/// The C++ files that lie in a folder itself, sorted; those of its sub-folders are not among them.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder);

/// What a file includes in quotation marks, as written.
std::vector<std::string> includesOf(const std::filesystem::path& file);

/// One sentence for each include of a room that is not declared: "a/b/x.cpp includes c/d/y.h, but a/b does
/// not declare c/d". `root` is the folder that the names of rooms are relative to.
std::vector<std::string> undeclaredIncludes(const Rooms& rooms, const std::filesystem::path& root);

/// One sentence for each declared room that no file includes.
std::vector<std::string> unusedDeclarations(const Rooms& rooms, const std::filesystem::path& root);

/// The rooms along a circle of declarations, the first one again at the end; empty where there is none.
std::vector<std::string> findCircle(const Rooms& rooms);

}  // namespace arete::house
