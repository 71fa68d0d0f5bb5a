// SPDX-License-Identifier: GPL-3.0-or-later
//
// The horizontal part of a compound CRS is described from a copy without its vertical part, because OGR's
// accessors return the values of the part that they find first. Coordinates are x, y in GDAL's traditional
// order (longitude first) throughout.
#include "io/geo/crs/reader.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/files/text_scan.h"
#include "io/geo/crs/proj_files.h"
#include "io/geo/gdal/crs_addresses.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr double kFootMetres = 0.3048;
constexpr double kSurveyFootMetres = 1200.0 / 3937.0;

struct UnitName {
  std::string_view name;
  double metres;
};

// These are the spellings in files. The two feet differ by two millionths, and only their names tell them
// apart.
constexpr std::array kUnitNames = {
    UnitName{"m", 1},
    UnitName{"metre", 1},
    UnitName{"metres", 1},
    UnitName{"meter", 1},
    UnitName{"meters", 1},
    UnitName{"ft", kFootMetres},
    UnitName{"foot", kFootMetres},
    UnitName{"feet", kFootMetres},
    UnitName{"international foot", kFootMetres},
    UnitName{"international feet", kFootMetres},
    UnitName{"us survey foot", kSurveyFootMetres},
    UnitName{"us survey feet", kSurveyFootMetres},
    UnitName{"u.s. survey foot", kSurveyFootMetres},
    UnitName{"u.s. foot", kSurveyFootMetres},
    UnitName{"us foot", kSurveyFootMetres},
    UnitName{"foot_us", kSurveyFootMetres},
    UnitName{"us-ft", kSurveyFootMetres},
    UnitName{"ftus", kSurveyFootMetres},
    UnitName{"ft_us", kSurveyFootMetres},
    UnitName{"yard", 0.9144},
    UnitName{"yd", 0.9144},
    UnitName{"fathom", 1.8288},
    UnitName{"mm", 0.001},
    UnitName{"millimetre", 0.001},
    UnitName{"millimeter", 0.001},
    UnitName{"cm", 0.01},
    UnitName{"centimetre", 0.01},
    UnitName{"centimeter", 0.01},
    UnitName{"dm", 0.1},
    UnitName{"decimetre", 0.1},
    UnitName{"decimeter", 0.1},
    UnitName{"km", 1000},
    UnitName{"kilometre", 1000},
    UnitName{"kilometer", 1000},
};

std::string nameOf(const OGRSpatialReference& crs) {
  return crs.GetName() ? crs.GetName() : "unnamed";
}

void describeVertical(const OGRSpatialReference& crs, Georeference& georeference) {
  // A compound CRS has a vertical part; the third axis of any other CRS is the height above the ellipsoid.
  if (crs.IsCompound()) {
    if (const char* name = crs.GetAttrValue("VERT_CS")) georeference.verticalDatum = name;
    const char* unit = nullptr;
    const double metres = crs.GetTargetLinearUnits("VERT_CS", &unit);
    if (metres > 0 && std::isfinite(metres)) {
      georeference.verticalUnit = unit ? unit : "";
      georeference.verticalUnitMetres = metres;
    }
  } else if (crs.GetAxesCount() == 3) {
    georeference.verticalDatum = "ellipsoid";
    double metres = 1;
    crs.GetAxis(nullptr, 2, nullptr, &metres);
    if (metres > 0 && std::isfinite(metres)) {
      georeference.verticalUnit = metres == 1 ? "metre" : fmt::format("{} metre", metres);
      georeference.verticalUnitMetres = metres;
    }
  }
}

/// The beginning of a text, on one line.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 60;
  std::size_t length = std::min(kMost, text.size());
  // A character of several bytes is not torn: the cut goes before its first byte.
  while (length > 0 && length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
    --length;
  std::string line = text.substr(0, length);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 32; }, ' ');
  return length < text.size() ? line + "..." : line;
}

Result<OGRSpatialReference> parsedCrs(const std::string& text, CSLConstList limitations) {
  GdalErrors errors;
  OGRSpatialReference crs;
  if (crs.SetFromUserInput(text.c_str(), limitations) != OGRERR_NONE || crs.IsEmpty()) {
    const std::string said = errors.firstFailure();
    return failure(ErrorCode::usage,
                   said.empty() ? "is not a CRS that GDAL understands"
                                : fmt::format("is not a CRS that GDAL understands: {}", said),
                   text);
  }
  if (crs.IsVertical() && !crs.IsCompound())
    return failure(ErrorCode::usage,
                   "is a vertical CRS alone; name a compound one, for instance EPSG:4326+5773", text);
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

}  // namespace

std::optional<double> metresPerUnit(std::string_view name) {
  const std::string lower = text::lowered(name);
  for (const UnitName& unit : kUnitNames)
    if (unit.name == lower) return unit.metres;
  return std::nullopt;
}

bool isKnownCrs(const OGRSpatialReference* crs) {
  return crs && !crs->IsEmpty() && nameOf(*crs).rfind("Undefined ", 0) != 0;
}

std::string wktOf(const OGRSpatialReference& crs) {
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  char* text = nullptr;
  std::string wkt;
  if (crs.exportToWkt(&text, options) == OGRERR_NONE && text) wkt = text;
  CPLFree(text);
  return wkt;
}

Result<OGRSpatialReference> crsFromText(const std::string& text) {
  if (const std::string name = fileNamedBy(text); !name.empty())
    return failure(
        ErrorCode::invalidData,
        fmt::format("its CRS names '{}', and what stands in a file does not make other files be opened; "
                    "state the CRS with `crs`, or put the grid into PROJ's data directory",
                    name));
  auto crs = parsedCrs(text, OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
  if (crs) return crs;
  // Of a file, not of the command line: the caller knows which.
  return failure(ErrorCode::invalidData,
                 fmt::format("its CRS, '{}', {}", shortened(text), crs.error().message));
}

Result<OGRSpatialReference> crsFromUser(const std::string& text) {
  // A bare number is one of EPSG's.
  const bool isNumber = text.size() >= 4 && text.size() <= 6 &&
                        std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  if (isNumber) {
    auto numbered = parsedCrs("EPSG:" + text, nullptr);
    if (!numbered) numbered.error().culprit = text;
    return numbered;
  }
  allowProjFiles(text);
  const StatedCrsAddress fetched;
  return parsedCrs(text, nullptr);
}

Result<OGRSpatialReference> chooseCrs(const OGRSpatialReference* own, const std::string& text,
                                      Warnings& warnings) {
  OGRSpatialReference chosen;
  if (isKnownCrs(own)) chosen = *own;
  if (!text.empty()) {
    ARETE_TRY(auto stated, crsFromUser(text));
    if (isKnownCrs(own) && !own->IsSame(&stated))
      warnings.push_back({WarningCode::position,
                          fmt::format("the CRS of the file, {}, is replaced by the one stated, {}; nothing "
                                      "is reprojected, as gdalwarp -t_srs or ogr2ogr -t_srs would",
                                      nameOf(*own), nameOf(stated))});
    chosen = std::move(stated);
  }
  chosen.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return chosen;
}

Status describeCrs(const OGRSpatialReference& crs, Georeference& georeference) {
  if (crs.IsEmpty()) return {};
  const GdalErrors quiet;  // PROJ reports a CRS without an ellipsoid, such as that of a building site
  if (crs.IsGeocentric())
    return failure(ErrorCode::unsupported,
                   fmt::format("the CRS {} is geocentric: its x, y are not plan positions", nameOf(crs)));
  georeference.crsWkt = wktOf(crs);

  OGRSpatialReference horizontal = crs;
  horizontal.StripVertical();
  georeference.isGeographic = horizontal.IsGeographic() || horizontal.IsDerivedGeographic();
  if (georeference.isGeographic) {
    const double radians = horizontal.GetAngularUnits();
    if (radians > 0) georeference.angularUnitRadians = radians;
  } else {
    const double metres = horizontal.GetLinearUnits();
    if (metres > 0) georeference.linearUnitMetres = metres;
  }
  OGRErr semiMajorStatus = OGRERR_NONE, flatteningStatus = OGRERR_NONE;
  const double semiMajor = horizontal.GetSemiMajor(&semiMajorStatus);
  const double inverseFlattening = horizontal.GetInvFlattening(&flatteningStatus);
  if (semiMajorStatus == OGRERR_NONE && flatteningStatus == OGRERR_NONE) {
    georeference.semiMajorAxisMetres = semiMajor;
    georeference.inverseFlattening = inverseFlattening;
  }
  describeVertical(crs, georeference);
  return {};
}

}  // namespace arete
