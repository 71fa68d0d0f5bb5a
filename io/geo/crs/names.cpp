// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texts come from files, so they are parsed with crsFromText(), which opens no file and no address.
#include "io/geo/crs/names.h"

#include <fmt/format.h>

#include <array>

#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {

std::string crsName(const std::string& crs) {
  if (crs.empty()) return "none";
  registerGdal();
  const auto parsed = crsFromText(crs);
  if (!parsed) return "unknown";
  const std::string name = parsed->GetName() ? parsed->GetName() : "unnamed";
  const char* authority = parsed->GetAuthorityName(nullptr);
  const char* code = parsed->GetAuthorityCode(nullptr);
  return authority && code ? fmt::format("{} ({}:{})", name, authority, code) : name;
}

bool isGeographicCrs(const std::string& crs) {
  if (crs.empty()) return false;
  registerGdal();
  GdalErrors quiet;
  const auto parsed = crsFromText(crs);
  return parsed && parsed->IsGeographic() != 0;
}

CrsAgreement compareCrs(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return CrsAgreement::unknown;
  if (a == b) return CrsAgreement::same;
  registerGdal();
  GdalErrors quiet;
  auto first = crsFromText(a), second = crsFromText(b);
  if (!first || !second) return CrsAgreement::unknown;
  first->StripVertical();
  second->StripVertical();
  constexpr std::array kOptions = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                   "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                   static_cast<const char*>(nullptr)};
  return first->IsSame(&*second, kOptions.data()) ? CrsAgreement::same : CrsAgreement::different;
}

}  // namespace arete
