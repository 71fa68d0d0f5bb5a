// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// The text of a CRS in a file may be an address (a GeoJSON CRS of type "link"), and GDAL fetches it when the
/// file is opened or read. While such an object lives, a request for a CRS on this thread fails without a
/// connection. Other requests (pieces of files, answers of services) go on. Objects nest.
class NoCrsAddresses {
 public:
  NoCrsAddresses();
  ~NoCrsAddresses();
  NoCrsAddresses(const NoCrsAddresses&) = delete;
  NoCrsAddresses& operator=(const NoCrsAddresses&) = delete;
};

/// Lets the CRS that a person stated be fetched on this thread, also within a NoCrsAddresses.
class StatedCrsAddress {
 public:
  StatedCrsAddress();
  ~StatedCrsAddress();
  StatedCrsAddress(const StatedCrsAddress&) = delete;
  StatedCrsAddress& operator=(const StatedCrsAddress&) = delete;
};

}  // namespace arete
