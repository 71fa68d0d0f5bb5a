// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "io/files/network/http_client.h"

namespace arete {

/// An address, and how it is requested.
struct NetworkAddress {
  std::string url;
  RetryRules rules;  ///< GDAL_HTTP_MAX_RETRY and GDAL_HTTP_RETRY_DELAY, where they are set
  std::vector<std::pair<std::string, std::string>> options;  ///< of CPLHTTPFetch(): names in capitals
};

/// Reads what stands behind "/vsicurl/", the address itself, or behind "/vsicurl?": options and, as "url=",
/// the address, all percent-encoded. Options that only say how GDAL's own handler asks (use_head, list_dir)
/// mean nothing here.
///
/// Errors: usage: an option that is not known, which may be what makes the server answer; no address.
Result<NetworkAddress> networkAddress(const std::string& name);

}  // namespace arete
