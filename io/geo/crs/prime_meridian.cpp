// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/prime_meridian.h"

#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {

double primeMeridianOf(const std::string& crs) {
  if (crs.empty()) return 0;
  registerGdal();
  GdalErrors quiet;
  const auto parsed = crsFromText(crs);
  return parsed ? parsed->GetPrimeMeridian() : 0;
}

}  // namespace arete
