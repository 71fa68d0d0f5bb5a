// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/files/curl/curl_client.h"
#include "io/geo/network/network_address.h"

namespace arete {

/// How libcurl requests an address, which is as GDAL would: the options of the address, and GDAL's own
/// (GDAL_HTTP_*, CURL_CA_BUNDLE, SSL_CERT_FILE), set in GDAL or in the environment.
CurlOptions curlOptionsOf(const NetworkAddress& address);

}  // namespace arete
