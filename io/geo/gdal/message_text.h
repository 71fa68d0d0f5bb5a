// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// A message of GDAL for people: one line of printable characters without the dot at its end, without
/// addresses of memory ("VSIFReadL(0x55620f8539e0,24)", which differ from run to run), without the "Success"
/// that some drivers append as the reason of a failure, and without what the addresses of files in it may
/// hide (io/files/text/address_text.h). Null is an empty message. O(length).
std::string gdalMessageText(const char* message);

}  // namespace arete
