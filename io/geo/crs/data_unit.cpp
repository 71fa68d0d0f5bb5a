// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/data_unit.h"

#include <cmath>

#include "io/geo/crs/reader.h"

namespace arete {

DataUnit heightUnitOf(const Georeference& georeference) {
  if (georeference.verticalUnit.empty()) return {};
  // A name that is not known comes with the metres of one that is not stated, 1.
  const bool isKnown =
      georeference.verticalUnitMetres != 1 || metresPerUnit(georeference.verticalUnit).has_value();
  return isKnown ? DataUnit{georeference.verticalUnitMetres} : DataUnit{};
}

DataUnit groundUnitOf(const Georeference& georeference) {
  return georeference.crsWkt.empty() ? DataUnit{} : DataUnit{1};
}

DataUnit spaceUnitOf(const std::string& crsWkt, const std::string& verticalUnit) {
  const auto ofHeights = metresPerUnit(verticalUnit);
  if (crsWkt.empty()) return {ofHeights.value_or(0)};
  const auto crs = crsFromText(crsWkt);
  Georeference georeference;
  if (!crs || !describeCrs(*crs, georeference) || georeference.isGeographic) return {};
  const double ofPlan = georeference.linearUnitMetres;
  if (!verticalUnit.empty() && !(ofHeights && std::abs(*ofHeights - ofPlan) <= 1e-9 * ofPlan)) return {};
  return {ofPlan};
}

}  // namespace arete
