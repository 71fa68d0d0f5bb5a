// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/option_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace arete {
namespace {

/// "Place of ..." as "place of ...", to stand behind a colon; names as "GeoTIFF" and "CRS" stay.
std::string continued(std::string text) {
  const std::string_view word = std::string_view(text).substr(0, text.find(' '));
  if (std::ranges::count_if(word, [](unsigned char c) { return std::isupper(c) != 0; }) == 1 &&
      word.size() > 1)
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

ModelKind kindOf(const AmtContainer& file) {
  return file.isOfSurface() ? ModelKind::surface : ModelKind::terrain;
}

OptionKinds::OptionKinds(std::string_view ofTerrain, std::string_view ofSurfaces)
    : ofTerrain_(ofTerrain), ofSurfaces_(ofSurfaces) {}

CLI::Option* OptionKinds::declare(CLI::Option* option, ModelKind kind) {
  option->description((kind == ModelKind::terrain ? ofTerrain_ : ofSurfaces_) + ": " +
                      continued(option->get_description()));
  declared_.push_back({option, kind});
  return option;
}

void OptionKinds::groupOfTerrain(CLI::App& command, const std::string& group) {
  for (CLI::Option* option : command.get_options([&](CLI::Option* o) { return o->get_group() == group; }))
    ofTerrain(option);
}

void OptionKinds::valuesOf(ModelKind kind, const CLI::Option* option, std::vector<std::string> values) {
  declared_.push_back({option, kind, std::move(values)});
}

std::optional<std::string> OptionKinds::statedForOther(ModelKind kind) const {
  for (const Declared& declared : declared_) {
    if (declared.kind == kind || declared.option->count() == 0) continue;
    const std::string name = declared.option->get_name();
    if (declared.values.empty()) return name;
    for (const std::string& value : declared.option->results())
      if (std::ranges::any_of(declared.values, [&](const std::string& known) {
            return known.ends_with(':') ? value.starts_with(known) : value == known;
          }))
        return name + " " + value;
  }
  return std::nullopt;
}

Status OptionKinds::refuseOther(ModelKind kind, const std::string& hint) const {
  const std::optional<std::string> stated = statedForOther(kind);
  if (!stated) return {};
  const bool isTerrain = kind == ModelKind::terrain;
  return failure(ErrorCode::usage,
                 fmt::format("is for {}, and the file is of {}{}", isTerrain ? "surfaces" : "terrain",
                             isTerrain ? "terrain" : "a surface", hint.empty() ? "" : " (" + hint + ")"),
                 *stated);
}

}  // namespace arete
