// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/validate.h"

#include <fmt/format.h>

#include <array>

#include "cli/arguments/arguments.h"
#include "cli/surface/mending.h"
#include "io/store/amt/surface_file.h"

namespace arete {
namespace {

struct Law {
  int number;
  const char* says;
};

constexpr std::array kLaws = {
    Law{1, "every parent is older than its child"},
    Law{2, "a node's floor and ceiling have the same boundary"},
    Law{3, "a triangle has one creator, at most one remover, and occurs once"},
    Law{4, "no part of a node is a modification by itself"},
    Law{5, "fronts are oriented manifolds of the topology of the source"},
    Law{6, "saturated errors and spheres contain those of the children"},
    Law{8, "the finest front has all faces that the build kept"},
    Law{10, "every sample of the source lies within the error of a triangle, in every front"},
};

}  // namespace

Status validateSurfaceFile(const std::string& path, const SurfaceLawOptions& options, Session& session) {
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(path, AmtVerify::all, session.context()));
  const Status valid = validateSurface(model, options, session.context());
  if (!valid && valid.error().code == ErrorCode::interrupted) return valid;
  Json laws = Json::array();
  std::string text = fmt::format(
      "{}: checksums, indices and every law hold\n"
      "  surface {}, {} at the finest\n",
      path, grouped(model.fileFaces, "face", "faces"),
      grouped(model.mt.finestTriangleCount(), "triangle", "triangles"));
  text += mendedText(model.mending, "  mended  ");
  for (const Law& law : kLaws) {
    text += fmt::format("  law {:<2}  holds  {}\n", law.number, law.says);
    laws.push_back({{"law", law.number}, {"says", law.says}, {"claimed", true}});
  }
  Json json = {{"file", path}, {"kind", "surface"}, {"holds", valid.has_value()}};
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
  if (!valid) return failure(valid.error().code, valid.error().message, path);
  return {};
}

}  // namespace arete
