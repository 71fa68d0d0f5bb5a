// SPDX-License-Identifier: GPL-3.0-or-later
//
// A CRS whose axis points down describes depths. A file may also say so by the conventions of CF ("positive",
// "standard_name") or by its format. Some formats demand elevations and come with a CRS of depths all the
// same.
#include "io/geo/crs/vertical.h"

#include <fmt/format.h>

#include <cmath>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

std::string attributeOf(const OGRSpatialReference& crs, const char* name) {
  const char* value = crs.GetAttrValue(name);
  return value ? value : "";
}

void warnOfUnknownUnit(const OGRSpatialReference& crs, const Georeference& georeference, Warnings& warnings) {
  if (crs.IsEmpty() || georeference.isGeographic || std::abs(georeference.linearUnitMetres - 1) < 1e-9)
    return;
  OGRSpatialReference horizontal = crs;
  horizontal.StripVertical();
  const char* unit = nullptr;
  horizontal.GetLinearUnits(&unit);
  warnings.push_back(
      {WarningCode::unit,
       fmt::format("its CRS counts in {} ({:.6g} m) and nothing states the unit of its heights: they are "
                   "taken as metres where "
                   "metres are needed; `verticalUnit` states theirs",
                   unit && *unit ? unit : "a unit without a name", georeference.linearUnitMetres)});
}

/// The unit of the source takes precedence over that of the CRS, which describeCrs() has set.
void takeUnit(const std::string& unit, Georeference& georeference, Warnings& warnings) {
  if (unit.empty()) return;
  const bool crsSays = !georeference.verticalUnit.empty();
  const auto metres = metresPerUnit(unit);
  if (!metres) {
    warnings.push_back(
        {WarningCode::unit, fmt::format("the unit of height '{}' is not known; {}", unit,
                                        crsSays ? "that of the CRS is used"
                                                : "heights are taken as metres where metres are needed")});
    if (crsSays) return;
  } else if (crsSays && std::abs(*metres - georeference.verticalUnitMetres) > 1e-9) {
    warnings.push_back({WarningCode::unit,
                        fmt::format("the band's unit of height is '{}', the CRS's '{}'; the band's is used",
                                    unit, georeference.verticalUnit)});
  }
  georeference.verticalUnit = unit;
  georeference.verticalUnitMetres = metres.value_or(1);
}

}  // namespace

// A vertical axis is the third of a three-dimensional CRS, or the only one of the vertical part of a compound
// CRS.
bool pointsDown(const OGRSpatialReference& crs) {
  OGRAxisOrientation orientation = OAO_Other;
  if (crs.IsCompound())
    crs.GetAxis("VERT_CS", 0, &orientation);
  else if (crs.GetAxesCount() == 3)
    crs.GetAxis(nullptr, 2, &orientation);
  return orientation == OAO_Down;
}

Result<bool> describeVertical(const OGRSpatialReference& crs, const VerticalSigns& signs,
                              const VerticalOptions& options, Georeference& georeference,
                              Warnings& warnings) {
  std::optional<double> statedMetres;
  if (!options.unit.empty()) {
    statedMetres = metresPerUnit(options.unit);
    if (!statedMetres)
      return failure(ErrorCode::usage,
                     "is not a unit of length that is known; m, ft (0.3048 m) and us-ft are", options.unit);
  }
  ARETE_CHECK(describeCrs(crs, georeference));

  // The heights of the model count upwards, so a vertical CRS of depths would be wrong for them: only its
  // datum is kept.
  const bool isDown = pointsDown(crs);
  if (isDown) {
    const std::string datum = attributeOf(crs, "VERT_DATUM");
    if (!datum.empty()) georeference.verticalDatum = datum;
    OGRSpatialReference horizontal = crs;
    if (horizontal.IsCompound())
      horizontal.StripVertical();
    else
      horizontal.DemoteTo2D(nullptr);
    georeference.crsWkt = wktOf(horizontal);
  }
  // What the user states counts first, then a format that demands heights, then the file's conventions, then
  // its CRS. What the file decides is said, since a wrong sign turns the terrain over.
  const std::string reason =
      !signs.depthName.empty() ? signs.depthName
      : isDown                 ? fmt::format("its vertical CRS, {}, points down", attributeOf(crs, "VERT_CS"))
                               : "";
  const bool isDepth = options.isDepth.value_or(!reason.empty() && !signs.isUp);
  if (!options.isDepth && isDepth)
    warnings.push_back(
        {WarningCode::unit,
         fmt::format(
             "{}: depths are negated, so that heights count upwards; `isDepth` up takes them as they are",
             reason)});
  else if (!options.isDepth && !reason.empty())
    warnings.push_back(
        {WarningCode::unit,
         fmt::format(
             "{}, but its format demands heights: they are taken as they are; `isDepth` down negates them",
             reason)});

  // The unit of the file is found first, so that a warning can name a stated one that contradicts it.
  takeUnit(signs.unit, georeference, warnings);
  if (georeference.verticalDatum.empty()) georeference.verticalDatum = signs.datum;
  if (statedMetres) {
    if (!georeference.verticalUnit.empty() &&
        std::abs(*statedMetres - georeference.verticalUnitMetres) > 1e-9)
      warnings.push_back(
          {WarningCode::unit,
           fmt::format("the unit of height of the file, '{}', is replaced by the one stated, '{}'",
                       georeference.verticalUnit, options.unit)});
    georeference.verticalUnit = options.unit;
    georeference.verticalUnitMetres = *statedMetres;
  }
  if (georeference.verticalUnit.empty()) warnOfUnknownUnit(crs, georeference, warnings);
  return isDepth;
}

}  // namespace arete
