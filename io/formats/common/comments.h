// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/text_scan.h"
#include "io/formats/common/file.h"

namespace arete {

/// The key of the comment that says where a mesh in metres is, and the numbers behind it.
constexpr std::string_view kMetresAboutKey = "metres_about ";
inline std::string metresAboutText(const Vec3& place) {
  return fmt::format("{} {} {}", place.x, place.y, place.z);
}
/// Reads three numbers behind a key; nothing if there are others.
inline std::optional<Vec3> readPlaceNumbers(std::string_view numbers) {
  const char* at = numbers.data();
  const char* const end = at + numbers.size();
  std::array<double, 3> xyz{};
  for (double& value : xyz) {
    while (at < end && text::isBlank(*at)) ++at;
    if (at == end || !text::scanNumber(at, end, value) || !std::isfinite(value)) return std::nullopt;
  }
  return Vec3{xyz[0], xyz[1], xyz[2]};
}

/// The comment lines of a mesh in a text format: CRS, vertical unit and notes, each after "# ".
inline std::string meshComments(const MeshWriteOptions& options) {
  std::string comments;
  if (!options.crsWkt.empty()) comments += fmt::format("# crs {}\n", text::onOneLine(options.crsWkt));
  if (!options.verticalUnit.empty())
    comments += fmt::format("# vertical_unit {}\n", text::onOneLine(options.verticalUnit));
  if (options.metresAbout)
    comments += fmt::format("# {}{}\n", kMetresAboutKey, metresAboutText(*options.metresAbout));
  for (const std::string& note : options.notes) comments += fmt::format("# {}\n", text::onOneLine(note));
  return comments;
}

}  // namespace arete
