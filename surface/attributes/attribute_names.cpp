// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace arete {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kParts = {
    {{"materials", "material"}, {"objects", "object"}, {"groups", "group"}}};

}  // namespace

// Sets count from 0 in files and from 1 in options: "texcoord1" is "uv2".
std::string optionNameOf(std::string_view inFile) {
  for (const auto& [file, option] : kParts)
    if (inFile == file) return std::string(option);
  for (const auto& [file, option] :
       {std::pair{kTexcoordName, std::string_view("uv")}, std::pair{kColorName, std::string_view("color")}}) {
    if (!inFile.starts_with(file)) continue;
    const std::string_view behind = inFile.substr(file.size());
    if (behind.empty()) return std::string(option);
    unsigned set = 0;
    const auto [end, error] = std::from_chars(behind.data(), behind.data() + behind.size(), set);
    if (error == std::errc() && end == behind.data() + behind.size() && set > 0 && set < 1000)
      return fmt::format("{}{}", option, set + 1);
  }
  return std::string(inFile);
}

std::vector<NamedAttribute> namedAttributes(const MeshAttributes& mesh) {
  std::vector<NamedAttribute> all;
  const auto add = [&](const std::vector<Attribute>& attributes, NamedAttribute::Of of) {
    for (std::size_t i = 0; i < attributes.size(); ++i)
      all.push_back({optionNameOf(attributes[i].name), attributes[i].name, of, i});
  };
  add(mesh.vertexAttributes, NamedAttribute::Of::vertices);
  add(mesh.wedgeAttributes, NamedAttribute::Of::wedges);
  add(mesh.triangleAttributes, NamedAttribute::Of::triangles);
  if (!mesh.materials.empty()) all.push_back({"material", "materials", NamedAttribute::Of::materials, 0});
  if (!mesh.objects.empty()) all.push_back({"object", "objects", NamedAttribute::Of::objects, 0});
  if (!mesh.groups.empty()) all.push_back({"group", "groups", NamedAttribute::Of::groups, 0});
  return all;
}

Result<std::vector<NamedAttribute>> findAttributes(const MeshAttributes& mesh, std::string_view name) {
  std::vector<NamedAttribute> found;
  std::vector<std::string> names;
  const std::vector<NamedAttribute> all = namedAttributes(mesh);
  for (const NamedAttribute& a : all) {
    if (a.name == name) found.push_back(a);
    if (std::ranges::find(names, a.name) == names.end()) names.push_back(a.name);
  }
  // A file's own name counts where no option has it.
  if (found.empty())
    std::ranges::copy_if(all, std::back_inserter(found),
                         [&](const NamedAttribute& a) { return a.inFile == name; });
  if (found.empty())
    return failure(ErrorCode::usage,
                   names.empty()
                       ? std::string("is not an attribute: the mesh has none")
                       : fmt::format("is not an attribute of the mesh, which has {}", fmt::join(names, ", ")),
                   std::string(name));
  return found;
}

Result<std::vector<AttributeNumber>> parseAttributeNumbers(std::string_view list) {
  std::vector<AttributeNumber> numbers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    const std::string_view part = list.substr(at, end - at);
    at = end + 1;
    const auto refuse = [&](std::string message) {
      return failure(ErrorCode::usage, std::move(message), std::string(part));
    };
    const std::size_t colon = part.rfind(':');
    if (colon == std::string_view::npos || colon == 0)
      return refuse("is not a name, a colon and a number, as in color:8");
    AttributeNumber made{.name = std::string(part.substr(0, colon))};
    const std::string_view text = part.substr(colon + 1);
    const auto [behind, error] = std::from_chars(text.data(), text.data() + text.size(), made.number);
    if (error != std::errc() || !std::isfinite(made.number) || made.number < 0)
      return refuse("needs a number from 0 behind the colon, as in color:8");
    made.unit = std::string(behind, text.data() + text.size());
    if (!made.unit.empty() && made.unit != "px")
      return refuse(
          fmt::format("has the unknown unit '{}': px, or nothing, for the attribute's own", made.unit));
    if (std::ranges::find(numbers, made.name, &AttributeNumber::name) != numbers.end())
      return refuse(fmt::format("names {} a second time", made.name));
    numbers.push_back(std::move(made));
  }
  return numbers;
}

}  // namespace arete
