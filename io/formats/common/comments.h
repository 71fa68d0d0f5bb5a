// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <string>

#include "io/files/text_scan.h"
#include "io/formats/common/file.h"

namespace arete {

/// The comment lines of a mesh in a text format: CRS, vertical unit and notes, each after "# ".
inline std::string meshComments(const MeshWriteOptions& options) {
  std::string comments;
  if (!options.crsWkt.empty()) comments += fmt::format("# crs {}\n", text::onOneLine(options.crsWkt));
  if (!options.verticalUnit.empty())
    comments += fmt::format("# vertical_unit {}\n", text::onOneLine(options.verticalUnit));
  for (const std::string& note : options.notes) comments += fmt::format("# {}\n", text::onOneLine(note));
  return comments;
}

}  // namespace arete
