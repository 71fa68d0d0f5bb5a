// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/validate.h"

#include <fmt/format.h>

#include "cli/arguments/arguments.h"
#include "cli/surface/mending.h"
#include "engine/laws/law.h"
#include "io/store/amt/surface_file.h"

namespace arete {
Status validateSurfaceFile(const AmtContainer& file, const SurfaceLawOptions& options, Session& session) {
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(file, {}, session.context()));
  const Status valid = validateSurface(model, options, session.context());
  // A run that ended otherwise says nothing of the laws.
  if (!valid && valid.error().code != ErrorCode::brokenPromise) return valid;
  Json laws = Json::array();
  std::string text = fmt::format(
      "{}: checksums, indices and every law hold\n"
      "  surface {}, {} at the finest\n",
      file.path(), grouped(model.fileFaces, "face", "faces"),
      grouped(model.mt.finestTriangleCount(), "triangle", "triangles"));
  text += mendedText(model.mending, "  mended  ");
  for (const Law& law : kLaws) {
    if (law.ofSurfaces.empty()) continue;
    text += fmt::format("  law {:<2}  holds  {}\n", law.number, law.ofSurfaces);
    laws.push_back({{"law", law.number}, {"says", law.ofSurfaces}, {"claimed", true}});
  }
  Json json = {{"file", file.path()}, {"kind", "surface"}, {"holds", valid.has_value()}};
  json["sourceFaces"] = model.fileFaces;
  json["finestTriangles"] = model.mt.finestTriangleCount();
  json["mended"] = mendedJson(model.mending);
  json["samples"] = options.everySample ? "full" : "vertices";
  if (valid) {
    text += options.everySample ? "  law 10 by vertices, middles of faces and of their sides\n"
                                : "  law 10 by vertices (--full: more samples)\n";
    session.say(text);
    json["laws"] = std::move(laws);
  } else {
    json["violation"] = valid.error().message;
  }
  session.answer(json);
  if (!valid) return failure(valid.error().code, valid.error().message, file.path());
  return {};
}

}  // namespace arete
