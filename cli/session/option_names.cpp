// SPDX-License-Identifier: GPL-3.0-or-later
//
// A table from fields to options. A field that several commands share has the same option in all of them.
#include "cli/session/option_names.h"

#include <algorithm>
#include <array>
#include <utility>

namespace arete {
namespace {

using Name = std::pair<std::string_view, std::string_view>;

// Sorted by field: optionOfField() searches by bisection.
constexpr std::array kNames = {
    Name{"allowCoveredNodata", "--allow-covered-nodata"},
    Name{"attributeErrors", "--attribute-error"},
    Name{"attributeWeight", "--attribute-weight"},
    Name{"band", "--band"},
    Name{"bands", "--drape-bands"},
    Name{"boundsAttributes", "--attributes"},
    Name{"box", "--box"},
    Name{"camera", "--camera"},
    Name{"clusterVertices", "--cluster-vertices"},
    Name{"clutter", "--clutter"},
    Name{"creaseAngleDegrees", "--crease-angle"},
    Name{"crs", "--crs"},
    Name{"deadlineMilliseconds", "--deadline"},
    Name{"distance", "--distance"},
    Name{"drape", "--drape"},
    Name{"dropAttributes", "--drop-attributes"},
    Name{"dropParts", "--drop-parts"},
    Name{"earth", "--earth"},
    Name{"featureCount", "--features"},
    Name{"featurePersistence", "--feature-persistence"},
    Name{"fieldOfView", "--fov"},
    Name{"figures", "--figures"},
    Name{"film", "--film"},
    Name{"fit", "--fit"},
    Name{"fixedVertices", "--fixed"},
    Name{"flipV", "--flip-v"},
    Name{"focus", "--focus"},
    Name{"frames", "--frames"},
    Name{"framesPerSecond", "--fps"},
    Name{"frequency", "--frequency"},
    Name{"growth", "--error-growth"},
    Name{"headless", "--headless"},
    Name{"importance", "--importance"},
    Name{"isDepth", "--positive"},
    Name{"isLonLat", "--lonlat"},
    Name{"keepBorders", "--keep-borders"},
    Name{"kind", "--as"},
    Name{"layer", "--layer"},
    Name{"like", "--like"},
    Name{"lonLat", "--lonlat"},
    Name{"maxDegree", "--max-degree"},
    Name{"maxError", "--max-error"},
    Name{"maxTriangles", "--max-triangles"},
    Name{"memory", "--memory"},
    Name{"method", "--method"},
    Name{"metric", "--metric"},
    Name{"minimumAspect", "--min-aspect"},
    Name{"noCrossings", "--no-crossings"},
    Name{"nodata", "--nodata"},
    Name{"normals", "--normals"},
    Name{"operator", "--operator"},
    Name{"order", "--order"},
    Name{"outsideError", "--outside-error"},
    Name{"packed", "--packed"},
    Name{"paged", "--paged"},
    Name{"pixelError", "--pixel-error"},
    Name{"positionBits", "--position-bits"},
    Name{"quadricWeight", "--quadric-weight"},
    Name{"queue", "--queue"},
    Name{"refraction", "--refraction"},
    Name{"region", "--region"},
    Name{"region-crs", "--region-crs"},
    Name{"rimTolerance", "--rim-tolerance"},
    Name{"samePlace", "--same-place"},
    Name{"samples", "--samples"},
    Name{"seed", "--seed"},
    Name{"shape", "--shape"},
    Name{"splitsSheets", "'arete mesh repair --split-sheets'"},
    Name{"targetHeight", "--target-height"},
    Name{"thresholdRatio", "--ratio"},
    Name{"toCrs", "--to-crs"},
    Name{"unit", "--unit"},
    Name{"up", "--up"},
    Name{"verticalUnit", "--vertical-unit"},
    Name{"viewport", "--viewport"},
    Name{"zField", "--z-field"},
};
static_assert(std::ranges::is_sorted(kNames, {}, &Name::first));

bool isAboutAFile(ErrorCode code) {
  return code == ErrorCode::notFound || code == ErrorCode::unreadable || code == ErrorCode::corrupt;
}

}  // namespace

std::optional<std::string_view> optionOfField(std::string_view field) {
  const auto found = std::ranges::lower_bound(kNames, field, {}, &Name::first);
  if (found == kNames.end() || found->first != field) return std::nullopt;
  return found->second;
}

std::string withOptionNames(std::string_view sentence) {
  std::string translated;
  while (true) {
    const std::size_t open = sentence.find('`');
    const std::size_t close = open == sentence.npos ? open : sentence.find('`', open + 1);
    if (close == sentence.npos) return translated.append(sentence);
    translated.append(sentence.substr(0, open));
    if (const auto option = optionOfField(sentence.substr(open + 1, close - open - 1))) {
      translated.append(*option);
      sentence.remove_prefix(close + 1);
    } else {
      // The closing backquote may open the next pair.
      translated.append(sentence.substr(open, close - open));
      sentence.remove_prefix(close);
    }
  }
}

Error withOptionNames(Error error) {
  error.message = withOptionNames(error.message);
  if (isAboutAFile(error.code)) return error;
  const std::size_t end = std::min(error.culprit.find(' '), error.culprit.size());
  if (const auto option = optionOfField(std::string_view(error.culprit).substr(0, end)))
    error.culprit.replace(0, end, *option);
  return error;
}

}  // namespace arete
