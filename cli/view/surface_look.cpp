// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/surface_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>

#include "cli/arguments/arguments.h"

namespace arete {
namespace {

constexpr std::array<std::string_view, 3> kParts{"textures", "materials", "vertex-colors"};
constexpr std::array<std::string_view, 4> kLights{"sun", "sky", "headlight", "highlights"};

}  // namespace

Result<std::set<std::string_view>> wordsOf(const char* option, std::string_view list,
                                           std::span<const std::string_view> known) {
  std::set<std::string_view> words;
  for (std::string_view rest = list;;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto word = std::ranges::find(known, rest.substr(0, comma));
    if (word == known.end())
      return failure(ErrorCode::usage, fmt::format("must be a list of {}", fmt::join(known, ", ")),
                     fmt::format("{} {}", option, list));
    words.insert(*word);
    if (comma == rest.size()) return words;
    rest.remove_prefix(comma + 1);
  }
}

void SurfaceLookArguments::addTo(CLI::App& command, const std::string& group, OptionKinds& kinds) {
  kinds.ofSurfaces(command
                       .add_option("--without", without,
                                   "Leaves out textures (all pictures), materials (their colours) or "
                                   "vertex-colors; several with commas")
                       ->type_name("PART,...")
                       ->group(group));
  kinds.ofSurfaces(command
                       .add_option("--shading", shading,
                                   "Light by the normals of triangles (flat), the source's, smooth but "
                                   "for edges of 45 degrees, or the file's own, smooth where it has none "
                                   "(stated, default)")
                       ->check(oneOf({"flat", "smooth", "stated"}))
                       ->type_name("NAME")
                       ->group(group));
  kinds.ofSurfaces(command
                       .add_option("--sides", sides,
                                   "The inside of what has one side is dark (material, default), as the "
                                   "outside (both), or not drawn (front)")
                       ->check(oneOf({"material", "both", "front"}))
                       ->type_name("NAME")
                       ->group(group));
  kinds.ofSurfaces(
      command
          .add_option("--light", light,
                      "Parts of the light, with commas: sun, sky, headlight, highlights (default: "
                      "all), or none. The sun goes with the eye unless --sun says where it stands")
          ->type_name("PART,...")
          ->group(group));
}

Result<SurfaceLook> SurfaceLookArguments::look() const {
  SurfaceLook look;
  if (!without.empty()) {
    ARETE_TRY(const auto left, wordsOf("--without", without, kParts));
    look.hasTextures = !left.contains("textures");
    look.hasMaterialColors = !left.contains("materials");
    look.hasVertexColors = !left.contains("vertex-colors");
  }
  if (shading == "flat") look.shading = SurfaceShading::flat;
  if (shading == "smooth") look.shading = SurfaceShading::smooth;
  if (sides == "both") look.sides = SurfaceSides::both;
  if (sides == "front") look.sides = SurfaceSides::front;
  if (light.empty()) return look;
  std::set<std::string_view> lit;
  if (light != "none") {
    ARETE_TRY(lit, wordsOf("--light", light, kLights));
  }
  look.hasSun = lit.contains("sun");
  look.hasSky = lit.contains("sky");
  look.hasHeadlight = lit.contains("headlight");
  look.hasHighlights = lit.contains("highlights");
  return look;
}

}  // namespace arete
