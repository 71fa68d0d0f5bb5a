// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/average.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace arete {

void appendAverage(Attribute& to, const Attribute& from, const std::array<std::uint32_t, 3>& elements,
                   const std::array<double, 3>& weights, bool isOfLabels) {
  const std::size_t heaviest = std::size_t(std::ranges::max_element(weights) - weights.begin());
  if (isOfLabels) return to.append(from.element(elements[heaviest]));
  const std::vector<double> first = from.numbers(elements[heaviest]);
  std::vector<double> sum(from.components, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0) continue;  // also where the element is not finite
    const std::vector<double> numbers = from.numbers(elements[i]);
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weights[i] * numbers[c];
  }
  const bool isTangent = from.meaning == AttributeMeaning::tangent && from.components == 4;
  if (isTangent || (from.meaning == AttributeMeaning::normal && from.components == 3)) {
    const double length = std::hypot(sum[0], sum[1], sum[2]),
                 wanted = std::hypot(first[0], first[1], first[2]);
    for (std::size_t c = 0; c < 3; ++c) sum[c] = length > 0 ? sum[c] * (wanted / length) : first[c];
  }
  if (isTangent) sum[3] = first[3];
  to.append(sum);
}

}  // namespace arete
