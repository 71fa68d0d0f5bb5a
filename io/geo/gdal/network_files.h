// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// Replaces GDAL's handler of "/vsicurl/" by one that never gives fewer bytes than were asked for, or bytes
/// of another version of the file, without an error. Called by registerGdal().
///
/// Each answer is held against the length, the ETag and the date of the first one. Answers 429, 500, 502, 503
/// and 504, lost connections and answers cut short are tried again: GDAL_HTTP_MAX_RETRY times (default 4),
/// after as many seconds as the server states (at most 30), or GDAL_HTTP_RETRY_DELAY (default 0.25), twice
/// as many each time. A server that stalls for 30 seconds counts as a lost connection. Files are read in
/// pieces; a server that knows no ranges sends a file as a whole, of at most 2 GiB.
void installNetworkFiles();

/// @return True for a path that installNetworkFiles() serves, also within another one
/// ("/vsizip//vsicurl/...").
bool isNetworkPath(const std::string& path);

/// @return "/vsicurl/http..." for an address, any other path as it is.
std::string networkPathOf(const std::string& path);

/// GDAL's driver of netCDF waits for pages of a file of the network that never come when the connection is
/// lost. So such a file is copied into memory as a whole.
///
/// @return The path for GDAL to open; `path` itself for other files, and where the copy fails, which is an
/// error of GDAL. removeNetworkCopy() takes the description of the dataset, after it is closed.
std::string pathWithoutNetcdf(const std::string& path);
void removeNetworkCopy(const std::string& description);

/// Why the file of a network path cannot be read; empty if it can. May ask the server.
std::string networkProblem(const std::string& path);

/// The reading of one source, which may consist of several files. On this thread, while the object lives,
/// what has been read of a file of the network is kept, failures are recorded, and requests end within about
/// a second after `cancel` becomes true. An object within the life of another one shares what that one keeps.
class NetworkReading {
 public:
  /// @param cancel May be null.
  explicit NetworkReading(const std::atomic<bool>* cancel);
  ~NetworkReading();
  NetworkReading(const NetworkReading&) = delete;
  NetworkReading& operator=(const NetworkReading&) = delete;

  /// Asks the servers once more for the lengths and versions of all files that were read.
  ///
  /// Errors: unreadable: a request failed, or a file is not the one that was opened. interrupted.
  Status finish();

  struct State;

 private:
  std::shared_ptr<State> state_;
  const std::atomic<bool>* cancelBefore_;
  bool isInner_;
};

}  // namespace arete
