// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL requests a CRS, and nothing else, with the header "Accept: application/x-ogcwkt"
// (OGRSpatialReference::importFromUrl()). GDAL's own callback for requests is per thread, so that a program
// that has this one in its process is not changed.
#include "io/geo/gdal/crs_addresses.h"

#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>

#include <cstring>

namespace arete {
namespace {

thread_local int refusing = 0, statedAddresses = 0;

/// @return Null: GDAL goes on to what was there before.
CPLHTTPResult* refuseCrs(const char*, CSLConstList options, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc,
                         void*, void*) {
  const char* headers = CSLFetchNameValue(options, "HEADERS");
  if (statedAddresses > 0 || headers == nullptr || std::strstr(headers, "application/x-ogcwkt") == nullptr)
    return nullptr;
  auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("what stands in a file does not make its CRS be fetched from an address");
  return result;
}

}  // namespace

NoCrsAddresses::NoCrsAddresses() {
  if (refusing++ == 0) CPLHTTPPushFetchCallback(&refuseCrs, nullptr);
}

NoCrsAddresses::~NoCrsAddresses() {
  if (--refusing == 0) CPLHTTPPopFetchCallback();
}

StatedCrsAddress::StatedCrsAddress() {
  ++statedAddresses;
}

StatedCrsAddress::~StatedCrsAddress() {
  --statedAddresses;
}

}  // namespace arete
