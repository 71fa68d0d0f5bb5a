// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "io/files/network/http_client.h"

namespace arete {

/// Whether a path is of one of GDAL's stores of clouds ("/vsis3/", "/vsigs/", "/vsiaz/" ...).
bool isStorePath(const std::string& path);

/// Reads a file of a store through GDAL, which signs the requests: several ranges by one call of
/// VSIFReadMultiRangeL(). GDAL keeps what it knows of files: before each call, and after it, it is made to
/// forget that, and the length and the time that it then finds are those that the replies state. They say
/// nothing of what GDAL read in between; who reads holds the bytes against checksums. A request that has
/// begun is not cancelled.
std::shared_ptr<HttpClient> storeClient(std::string path);

}  // namespace arete
