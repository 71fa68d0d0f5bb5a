// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>

#include "io/files/network/http_client.h"
#include "io/geo/network/network_address.h"

namespace arete {

/// Sends requests by GDAL's own client, with its certificates, proxies and options (GDAL_HTTP_*): GDAL links
/// a build of libcurl of its own. A server that stalls for 30 seconds counts as a lost connection. A file
/// that comes as a whole has 2 GiB at most.
std::shared_ptr<HttpClient> gdalHttpClient(NetworkAddress address);

/// What cuts off the requests that this thread waits for, within about a second. May be null.
const std::atomic<bool>* requestCancel();
void setRequestCancel(const std::atomic<bool>* cancel);
bool requestsAreCancelled();

}  // namespace arete
