// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comparisons are written so that NaN fails them.
#include "terrain/model/build_options.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace arete {

std::string_view toString(HoleShape shape) {
  return shape == HoleShape::delaunay ? "delaunay" : "fidelity";
}

Status checkOptions(const BuildOptions& options, std::size_t sampleCount) {
  const auto refuse = [](std::string what, const char* field) {
    return failure(ErrorCode::usage, std::move(what), field);
  };
  if (options.maxDegree < 6 || options.maxDegree > kMostDegree)
    return refuse(fmt::format("the degree bound must be 6 to {}, not {}", kMostDegree, options.maxDegree),
                  "maxDegree");
  if (const double ratio = options.thresholdRatioOrDefault(); !(ratio > 1 && ratio <= 1e6))
    return refuse(fmt::format("the threshold ratio must be above 1, not {}", ratio), "thresholdRatio");
  if (!(options.minimumAspect >= 0 && options.minimumAspect < 0.5))
    return refuse(
        fmt::format("the aspect bound must be 0 or more and below 0.5, not {}", options.minimumAspect),
        "minimumAspect");
  if (!(options.rimTolerance >= 0 && std::isfinite(options.rimTolerance)))
    return refuse(fmt::format("the rim tolerance must be 0 or more samples, not {}", options.rimTolerance),
                  "rimTolerance");
  for (const std::uint32_t v : options.fixedVertices)
    if (v >= sampleCount)
      return refuse(fmt::format("fixed vertex {} of {} samples", v, sampleCount), "fixedVertices");
  return {};
}

}  // namespace arete
