// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "io/files/network/remote_file.h"

namespace arete {

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

/// The file of an address, or of "?" and options with an address (io/geo/network/network_address.h): the one
/// that this thread's reading keeps, or a new one. A failure is recorded, unless the server lacks the file.
std::shared_ptr<const RemoteFile> remoteFile(const std::string& name);

/// Makes a failure an error of GDAL and of this thread's reading, whatever the driver does about it.
void recordNetworkFailure(const Error& error);

/// Why the file of the network that a path leads to cannot be read. May ask the server, unless the file is an
/// archive and the path goes on in it: then this thread's reading knows, or nothing does.
///
/// @param path As servedPath() returns it.
std::optional<Error> networkProblem(const std::string& path);

/// The first failure of this thread's reading, which is the cause of what came after.
std::optional<Error> firstNetworkFailure();

}  // namespace arete
