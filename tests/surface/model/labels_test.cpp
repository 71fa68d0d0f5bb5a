// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace arete {
namespace {

Attribute scalars(std::string name, ScalarType type, const std::vector<double>& values) {
  Attribute attribute{.name = std::move(name), .type = type};
  for (const double value : values) attribute.append(std::span(&value, 1));
  return attribute;
}

TEST(Labels, WholeNumbersOfNoKnownMeaningAreNotAveraged) {
  struct Case {
    const char* name;
    ScalarType type;
    std::vector<double> values;
    bool isAveraged;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases = {
      {"class", ScalarType::int32, {}, false},
      {"anything", ScalarType::uint8, {1, 2}, false},
      {"anything", ScalarType::int16, {-1, 2}, false},
      {"anything", ScalarType::float32, {3, 7, 3}, false},
      {"anything", ScalarType::float64, {-3, 1e9, 0}, false},
      {"anything", ScalarType::float32, {0, 0, 0}, false},
      {"anything", ScalarType::float32, {3, 7.5, 3}, true},
      {"anything", ScalarType::float64, {3, 7, nan}, false},
      {"anything", ScalarType::float32, {3, std::numeric_limits<double>::infinity()}, false},
      {"anything", ScalarType::float32, {nan, nan}, true},
      {"scalar_Classification", ScalarType::float32, {nan, 0.5}, false},
      {"quality", ScalarType::float32, {}, true},
      {"quality", ScalarType::float32, {0.25, 1}, true},
      {"_FEATURE_ID_0", ScalarType::float32, {3.5, 4.43}, false},
      {"_FEATURE_ID_12", ScalarType::float32, {0.5}, false},
      {"_feature_id", ScalarType::float32, {0.5}, false},
      {"feature_id", ScalarType::float32, {0.5}, false},
      {"_BATCHID", ScalarType::float32, {0.5}, false},
      {"Classification", ScalarType::float32, {0.5}, false},
      {"label", ScalarType::float64, {0.5}, false},
      {"segment_3", ScalarType::float64, {0.5}, false},
      {"labelled", ScalarType::float64, {0.5}, true},
      {"classic", ScalarType::float64, {0.5}, true},
      {"7", ScalarType::float64, {0.5}, true},
      {"", ScalarType::float64, {0.5}, true},
  };
  for (const Case& c : cases) EXPECT_EQ(isLabel(scalars(c.name, c.type, c.values)), !c.isAveraged) << c.name;
}

TEST(Labels, KnownMeaningsAreAveragedWhateverTheirNumbers) {
  for (const AttributeMeaning meaning : {AttributeMeaning::normal, AttributeMeaning::tangent,
                                         AttributeMeaning::textureCoords, AttributeMeaning::color})
    for (const ScalarType type : {ScalarType::uint8, ScalarType::float32}) {
      Attribute attribute = scalars("class", type, {0, 1, 255});
      attribute.meaning = meaning;
      EXPECT_FALSE(isLabel(attribute));
    }
}

}  // namespace
}  // namespace arete
