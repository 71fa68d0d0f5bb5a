// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the examples of a command need, and what people look for first.
#include "cli/manual/common_options.h"

#include <algorithm>
#include <array>
#include <vector>

namespace arete {
namespace {

struct CommonOptions {
  std::string_view command;
  std::vector<std::string_view> options;
};

const std::vector<CommonOptions>& commonTable() {
  static const std::vector<CommonOptions> table = {
      {"build", {"--output", "--packed", "--shape", "--nodata", "--crs", "--vertical-unit", "--band"}},
      {"extract",
       {"--output", "--max-error", "--max-triangles", "--region", "--distance", "--outside-error", "--camera",
        "--pixel-error", "--fit", "--certificate"}},
      {"height", {"--at", "--points", "--output", "--lonlat", "--max-error"}},
      {"los",
       {"--from", "--to", "--points", "--pairs", "--output", "--lonlat", "--observer-height",
        "--target-height", "--frequency"}},
      {"profile", {"--along", "--output", "--png", "--lonlat", "--max-error", "--frequency"}},
      {"viewshed",
       {"--output", "--observer", "--observers", "--observer-height", "--target-height", "--radius", "--mode",
        "--lonlat"}},
      {"view",
       {"--camera", "--pixel-error", "--color", "--drape", "--contours", "--exaggeration", "--headless",
        "--screenshot", "--size", "--round", "--film"}},
      {"measure", {"--expect", "--region", "--error-raster", "--error-mesh", "--nodata", "--crs"}},
      {"mesh decimate",
       {"--output", "--max-triangles", "--max-error", "--operator", "--keep-borders", "--drop-attributes"}},
  };
  return table;
}

}  // namespace

std::span<const std::string_view> commonOptions(std::string_view command) {
  const auto found = std::ranges::find(commonTable(), command, &CommonOptions::command);
  return found == commonTable().end() ? std::span<const std::string_view>() : found->options;
}

std::span<const std::string_view> commandsWithCommonOptions() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const CommonOptions& one : commonTable()) all.push_back(one.command);
    return all;
  }();
  return names;
}

}  // namespace arete
