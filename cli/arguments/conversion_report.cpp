// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/conversion_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/mesh_options.h"
#include "io/geo/crs/names.h"

namespace arete {

// The numbers stand in the report of the writer, which is of any kind of loss.
bool isFineRounding(const std::string& lost, double diagonal, double tolerance) {
  constexpr std::string_view kBegin = "coordinates finer than ";
  if (!lost.starts_with(kBegin)) return false;
  const std::string numbers = lost.substr(kBegin.size(), lost.find(" (") - kBegin.size());
  const auto rounding = parseNumbers("", numbers);
  if (!rounding || rounding->empty()) return false;
  const double most = std::ranges::max(*rounding);
  return most <= kFineShareOfDiagonal * diagonal && most <= kFineShareOfTolerance * tolerance;
}

void warnOfConversion(const ConvertedMesh& converted, const std::string& input, std::string_view format,
                      const Session& session) {
  session.warn(converted.warnings, input);
  std::vector<std::string> lost = converted.lost;
  std::erase_if(lost, [&](const std::string& what) { return isFineRounding(what, converted.diagonal); });
  if (!lost.empty()) session.warn(fmt::format("{} cannot hold {}", format, fmt::join(lost, ", or ")));
}

std::string doublesText(double movedByFloats) {
  return fmt::format(
      "  doubles    coordinates take twice the bytes of the source's floats, which would move them by up to "
      "{:.2g}\n",
      movedByFloats);
}

std::string writtenText(const std::string& output, const ConvertedMesh& converted) {
  std::string text =
      fmt::format("{}: {}, {}\n", output, grouped(converted.triangles, "triangle", "triangles"),
                  grouped(converted.vertices, "vertex", "vertices"));
  if (converted.joinedVertices > 0)
    text += fmt::format("  {} joined at reading\n",
                        grouped(converted.joinedVertices, "vertex at the position of another was",
                                "vertices at the positions of others were"));
  if (converted.placed) text += fmt::format("  {}\n", placedText(*converted.placed).substr(2));
  if (converted.movedByFloats > 0) text += doublesText(converted.movedByFloats);
  for (const std::filesystem::path& file : converted.filesBeside)
    text += fmt::format("  beside it: {}\n", file.string());
  return text;
}

Json writtenJson(const std::string& input, const std::string& output, std::string_view format,
                 const ConvertedMesh& converted) {
  Json beside = Json::array();
  for (const std::filesystem::path& file : converted.filesBeside) beside.push_back(file.string());
  const Vec3& r = converted.frame.rounding;
  Json json = {{"input", input},
               {"output", output},
               {"format", format},
               {"triangles", converted.triangles},
               {"vertices", converted.vertices},
               {"joinedVertices", converted.joinedVertices},
               {"crs", crsName(converted.crsWkt)},
               {"verticalUnit", converted.verticalUnit},
               {"movedByFloats", converted.movedByFloats},
               {"rounding", {r.x, r.y, r.z}},
               {"lost", converted.lost},
               {"filesBeside", std::move(beside)}};
  if (converted.placed) json["placed"] = placedJsonOf(*converted.placed);
  return json;
}

}  // namespace arete
