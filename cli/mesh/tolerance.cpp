// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/arguments/arguments.h"

namespace arete {

Result<std::vector<SurfaceTolerance>> parseSurfaceTolerances(const std::string& option,
                                                             const std::string& text, double diagonal) {
  std::vector<SurfaceTolerance> tolerances;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    SurfaceTolerance tolerance{.text = text.substr(begin, end - begin)};
    const bool isShare = tolerance.text.ends_with('%');
    const Result<std::vector<double>> number =
        parseNumbers(option, isShare ? tolerance.text.substr(0, tolerance.text.size() - 1) : tolerance.text);
    if (!number) return tl::unexpected(number.error());
    if (number->size() != 1 || !(number->front() >= 0))
      return failure(ErrorCode::usage, fmt::format("'{}' is no distance", tolerance.text), option);
    tolerance.distance = isShare ? number->front() / 100 * diagonal : number->front();
    if (std::ranges::count(tolerances, tolerance.distance, &SurfaceTolerance::distance) > 0)
      return failure(ErrorCode::usage, fmt::format("has {} twice", tolerance.text), option);
    tolerances.push_back(std::move(tolerance));
    begin = end + 1;
  }
  return tolerances;
}

std::string withShare(double distance, double diagonal) {
  return fmt::format("{:.6g} ({:.4g} % of the diagonal)", distance, 100 * distance / diagonal);
}

}  // namespace arete
