// SPDX-License-Identifier: GPL-3.0-or-later
//
// What CLI11 has parsed is walked. Words that stand for numbers have been replaced by them there ("--mode
// seen" is "0"), so a value that is not among the words of the command line is looked up behind its option.
#include "cli/session/named_files.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "io/geo/gdal/confined.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 13> kOutputs = {
    "--log",  "--output",  "--certificate", "--error-raster",      "--error-mesh", "--screenshot", "--frames",
    "--film", "--figures", "--png",         "--window-screenshot", "--polygons",   "--man"};

/// "--output", or the name of an argument.
std::string optionName(const CLI::Option& option) {
  return option.get_positional() ? option.get_name() : "--" + option.get_lnames().front();
}

std::vector<const CLI::Option*> statedOptions(const CLI::App& command) {
  std::vector<const CLI::Option*> stated;
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && (option->get_positional() || !option->get_lnames().empty()))
      stated.push_back(option);
  return stated;
}

/// The words behind an option, or behind its equals sign.
std::vector<std::string> wordsBehind(const CLI::Option& option, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < words.size(); ++i)
    for (const std::string& name : names) {
      if (words[i] == name && i + 1 < words.size()) values.push_back(words[i + 1]);
      if (words[i].starts_with(name + "=")) values.push_back(words[i].substr(name.size() + 1));
    }
  return values;
}

bool isAmong(const std::string& value, const std::vector<std::string>& words) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return word == value || word.ends_with("=" + value); });
}

bool mayNameInputs(const CLI::Option& option) {
  if (isOutputOption(optionName(option))) return false;
  if (option.get_positional()) return true;
  const std::string type = option.get_type_name();
  return std::ranges::any_of(std::array{"FILE", "FOLDER", "RASTER", "FLIGHT", "CRS", "DEM"},
                             [&](const char* kind) { return type.find(kind) != type.npos; });
}

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file(ignored) && !entry->path().filename().string().starts_with("."))
      files.push_back(entry->path().string());
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> filesLike(const std::string& pattern) {
  std::vector<std::string> files;
  glob_t found{};
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  return files;
}

std::vector<std::string> filesOfName(const std::string& name) {
  std::error_code ignored;
  if (name.find("://") != name.npos || name.starts_with("/vsicurl")) return {name};
  const std::string local = localFileOf(name);
  if (local.empty()) return {};
  if (fs::is_directory(local, ignored)) return filesIn(local);
  if (fs::exists(local, ignored)) return {local};
  return name.find_first_of("*?[") != name.npos ? filesLike(name) : std::vector<std::string>();
}

}  // namespace

bool isOutputOption(const std::string& name) {
  return std::ranges::find(kOutputs, name) != kOutputs.end() || name == "OUTPUT";
}

Json typedOptions(const CLI::App& command, const std::vector<std::string>& words) {
  Json options = Json::object();
  for (const CLI::Option* option : statedOptions(command)) {
    const std::string name = optionName(*option);
    const std::string key = option->get_positional() ? name : name.substr(2);
    if (option->get_expected_max() == 0) {
      options[key] = true;
      continue;
    }
    std::vector<std::string> values = option->results();
    const bool isTyped =
        std::ranges::all_of(values, [&](const std::string& value) { return isAmong(value, words); });
    if (!isTyped) values = wordsBehind(*option, words);
    if (values.size() == 1)
      options[key] = values.front();
    else
      options[key] = values;
  }
  return options;
}

std::vector<std::string> namedInputs(const CLI::App& command) {
  std::vector<std::string> files;
  for (const CLI::Option* option : statedOptions(command)) {
    if (!mayNameInputs(*option)) continue;
    for (const std::string& value : option->results())
      for (const std::string& file : filesOfName(value))
        if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
  return files;
}

Status checkNamedOnce(const CLI::App& command, const std::string& option, const std::string& path) {
  for (const CLI::Option* other : statedOptions(command)) {
    if (optionName(*other) == option) continue;
    for (const std::string& value : other->results()) {
      std::error_code ignored;
      const bool isSame = value == path || fs::equivalent(value, path, ignored) ||
                          fs::weakly_canonical(fs::absolute(value, ignored), ignored) ==
                              fs::weakly_canonical(fs::absolute(path, ignored), ignored);
      if (isSame && !value.empty())
        return failure(ErrorCode::usage, fmt::format("is named by {} already", optionName(*other)),
                       fmt::format("{} {}", option, path));
    }
  }
  return {};
}

}  // namespace arete
