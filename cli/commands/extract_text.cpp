// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/extract_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cli/arguments/arguments.h"
#include "cli/arguments/mesh_options.h"
#include "io/query/extract/extract.h"

namespace arete {
namespace {

/// A mean error up to this part of the largest needs no explanation.
constexpr double kLargestMean = 0.02;

}  // namespace

std::string extractText(const ExtractRequest& request, const ExtractedTin& tin, const std::string& unit) {
  const std::string share =
      tin.finestTriangles
          ? fmt::format(" ({:.4g} % of the finest)",
                        100 * static_cast<double>(tin.triangles) / static_cast<double>(*tin.finestTriangles))
          : "";
  // What a grid moves is known of the promise alone.
  const double error = request.packedBits ? std::max(tin.storedError, tin.promisedError) : tin.storedError;
  std::string text = fmt::format(
      "{}: {}{}, {}, error at most {}", request.output, grouped(tin.triangles, "triangle", "triangles"),
      share, grouped(tin.vertices, "vertex", "vertices"), withReliefShare(error, unit, tin.relief));
  if (!request.criterion.region.empty())
    text += fmt::format(" (in the region {})", withUnit(tin.promisedError, unit));
  if (tin.pixels && std::isfinite(*tin.pixels))
    text += fmt::format(", {:.3g} pixels in the camera's picture", *tin.pixels);
  else if (tin.pixels)
    text += ", pixel error unknown around the camera";
  const std::string_view ended = endedBy(request.criterion, tin.isComplete);
  if (ended == "deadline") text += "; ended by the deadline";
  if (ended == "maxError") text += "; ended by --max-error";
  if (ended == "maxTriangles") text += "; ended by --max-triangles";
  if (tin.fit && request.criterion.fit == CutFit::triangles)
    text += fmt::format("; {} before the fit", grouped(tin.fit->trianglesBefore, "triangle", "triangles"));
  else if (tin.fit && request.criterion.fit == CutFit::unbiased)
    text += fmt::format("; mean error {} before the fit", withUnit(tin.fit->meanBefore, unit));
  else if (tin.fit)
    text += fmt::format("; {} before the fit", withUnit(tin.fit->errorBefore, unit));
  if (tin.placed) text += placedText(*tin.placed);
  if (tin.measured) text += fmt::format("; measured {}", withUnit(tin.measured->maxAbsError, unit));
  if (tin.measured && request.criterion.fit == CutFit::unbiased)
    text += fmt::format(", mean {}{}", withUnit(tin.measured->meanError, unit),
                        std::abs(tin.measured->meanError) > kLargestMean * tin.storedError
                            ? " (left by bounds and fixed vertices)"
                            : "");
  if (tin.measuredInside) text += fmt::format(", {} inside", withUnit(tin.measuredInside->maxAbsError, unit));
  if (!request.certificate.empty()) text += fmt::format("\n  certificate {}", request.certificate);
  if (!request.errorRaster.empty()) text += fmt::format("\n  error raster {}", request.errorRaster);
  return text + "\n";
}

}  // namespace arete
