// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cli/session/session.h"
#include "io/formats/exchange/convert.h"

namespace arete {

/// Writes the warnings of a conversion, and a line of what the format cannot hold.
void warnOfConversion(const ConvertedMesh& converted, const std::string& input, std::string_view format,
                      const Session& session);

/// The line that says how far floats would move the vertices of a mesh that doubles hold.
std::string doublesText(double movedByFloats);

/// The text of a mesh that was written: "part.obj: 12 triangles, 8 vertices", and the files beside it.
std::string writtenText(const std::string& output, const ConvertedMesh& converted);

/// What a command answers of a mesh that it wrote.
Json writtenJson(const std::string& input, const std::string& output, std::string_view format,
                 const ConvertedMesh& converted);

}  // namespace arete
