// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/extract_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/mesh_options.h"
#include "cli/mesh/tolerance.h"
#include "cli/surface/why_not_fewer.h"
#include "engine/base/counted.h"
#include "io/files/shell_text.h"
#include "io/query/extract/extract.h"

namespace arete {
namespace {

std::string endText(const ExtractRequest& request, const ExtractedSurface& found) {
  const std::string_view ended = endedBy(request.criterion, found.isComplete);
  if (ended == "deadline") return "; ended by the deadline";
  if (ended == "maxError") return "; ended by --max-error";
  return ended == "maxTriangles" ? "; ended by --max-triangles" : "";
}

}  // namespace

std::string extractText(const ExtractRequest& request, const ExtractedSurface& found,
                        const SurfaceModel& model, bool statesShare) {
  const double diagonal = found.diagonal;
  const double percent =
      100 * static_cast<double>(found.triangles) / static_cast<double>(found.finestTriangles);
  std::string text = fmt::format("{}: {}{}, {}, no point of the source{} farther than {}{}\n", request.output,
                                 grouped(found.triangles, "triangle", "triangles"),
                                 statesShare ? fmt::format(" ({:.4g} % of the finest)", percent) : "",
                                 grouped(found.vertices, "vertex", "vertices"),
                                 found.droppedDistance ? " but what is left out" : "",
                                 withShare(found.error, diagonal), endText(request, found));
  if (!model.boundsLines && model.mayHaveLines())
    text +=
        "  lines      not bounded: an earlier version built the file, whose errors are distances to "
        "anything\n";
  // They keep most of the surface from being coarser.
  if (2 * model.mt.rootTriangleCount() > model.finestTriangles())
    if (const std::string seams = seamsOfModel(model); seams.size() > 2)
      text += fmt::format("  seams      {}\n", seams.substr(2));
  if (found.fit)
    text += fmt::format("  fit        RMS {:.4g} % of the diagonal instead of {:.4g} %{}\n",
                        100 * found.fit->rmsAfter / diagonal, 100 * found.fit->rmsBefore / diagonal,
                        found.fit->part == 1
                            ? ""
                            : fmt::format("; {:.3g} of each move, to keep the tolerance", found.fit->part));
  else if (found.isDisplaced)
    text += "  displaced  to where the distances are smaller (--no-displacement: as in the source)\n";
  text += movedText(found.movedAttributes);
  for (const AttributeNumber& of : found.attributeErrors)
    text += std::isfinite(of.number) ? fmt::format("  {:<10} at most {:.4g}{}{} off within that distance\n",
                                                   of.name, of.number, of.unit.empty() ? "" : " ", of.unit)
                                     : fmt::format("  {:<10} not bounded\n", of.name);
  if (found.importance)
    text += fmt::format("  importance {} from {:.4g} to {:.4g}; no point farther than {} / {}\n",
                        request.criterion.importance, found.importance->least, found.importance->largest,
                        withShare(found.importance->weighted, diagonal), request.criterion.importance);
  if (found.movedByGrid > 0)
    text += fmt::format("  packed     on a grid that moves a point by up to {}, part of the error\n",
                        withShare(found.movedByGrid, diagonal));
  if (found.otherWay)
    text += fmt::format("  other way  no point of the result farther than {}\n",
                        withShare(*found.otherWay, diagonal));
  if (found.droppedDistance)
    text += fmt::format("  left out   {} of {}, no point of {} farther than {}\n",
                        grouped(*found.droppedComponents, "component", "components"),
                        grouped(*found.droppedFaces, "face", "faces"),
                        agreeing(*found.droppedComponents, "it", "them"),
                        withShare(*found.droppedDistance, diagonal));
  // What is bounded needs no sample.
  std::vector<AttributeChange> sampled = found.attributeChanges;
  std::erase_if(sampled, [&](const AttributeChange& change) {
    return std::ranges::find(found.attributeErrors, change.name, &AttributeNumber::name) !=
           found.attributeErrors.end();
  });
  text += changesText(sampled);
  if (found.crossings > 0)
    text += fmt::format("  crossings  {} of triangles; the source has {}\n",
                        grouped(found.crossings, "pair", "pairs"), grouped(*found.sourceCrossings));
  if (found.movedByFloats > 0) text += doublesText(found.movedByFloats);
  for (const std::filesystem::path& beside : found.written.filesBeside)
    text += fmt::format("  beside     {}\n", beside.string());
  if (found.measured) {
    text += fmt::format("  measured   {}\n", withShare(found.measured->distances.backward.maximum, diagonal));
    text += fmt::format("  certificate {}\n", request.certificate);
  }
  if (!request.map.empty()) text += fmt::format("  map        {}\n", request.map);
  return text;
}

std::string leftByRoundingText(const ExtractRequest& request, const ExtractedSurface& found,
                               const SurfaceModel& model) {
  return fmt::format(
      "{}: the tolerance is not kept everywhere: rounding (--position-bits) has moved "
      "vertices of the source by up to {}, and with it no error is below {}",
      request.output, withShare(model.positionError, model.diagonal),
      withShare(found.leftByRounding, model.diagonal));
}

std::string surfaceCheckCommand(const ExtractRequest& request, const std::string& modelPath,
                                double promisedError, std::uint64_t samples) {
  std::string command, source = modelPath;
  if (request.criterion.dropParts > 0) {
    source = std::filesystem::path(request.output).replace_extension(".source.ply").string();
    command = fmt::format("arete extract {} -o {} --max-error 0 --drop-parts {} && ", shellQuoted(modelPath),
                          shellQuoted(source), request.criterion.dropParts);
  }
  command += fmt::format("arete measure {} {} --expect {} --samples {}", shellQuoted(request.output),
                         shellQuoted(source), promisedError, samples);
  // In sight or in a region alone nothing is certain of the whole.
  const CutRequest& asked = request.criterion;
  if (asked.attributeErrors.empty() || asked.spaceRegion || asked.hasCamera() || asked.focus) return command;
  std::string list;
  for (const AttributeNumber& of : asked.attributeErrors)
    list += fmt::format("{}{}:{}{}", list.empty() ? "" : ",", of.name, of.number, of.unit);
  return command + " --expect-attribute " + shellQuoted(list);
}

}  // namespace arete
