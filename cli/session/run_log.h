// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/session/json.h"
#include "engine/base/result.h"

namespace arete {

/// The log of a run: one JSON object a line, each written as it happens, so that the log of a run that is
/// killed ends at its stage. Lines are appended: a log may hold many runs, of several processes at once; each
/// line names its run. docs/topics/log.md lists the lines.
///
/// Threads may write lines at the same time.
class RunLog {
 public:
  /// Opens or creates a log. A file of another kind is refused, so that nothing is appended to a DEM.
  ///
  /// Errors: unreadable, notFound, usage; the path is the culprit.
  static Result<std::unique_ptr<RunLog>> open(const std::string& path);
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  /// Ends the log of a run that an exception ends.
  ~RunLog();

  /// Writes {"event": event, "run": ..., "time": ..., "seconds": since the start, and the fields}.
  void line(std::string_view event, Json fields);

  /// Takes a report of progress: a stage that begins and one that ends are lines.
  void report(std::string_view stage, double fraction);

  /// Begins to compute the SHA-256 of files on a thread of its own; each becomes a line "input".
  void digestInputs(std::vector<std::string> files);

  /// Waits for the checksums of the inputs (unless the run is `interrupted`; of one that failed for a second
  /// at most), writes the files that the run has made, with their SHA-256, and the last line.
  ///
  /// @param error null, or the object of the error
  /// Errors: unreadable: a line was not written, or the log was replaced meanwhile.
  Status end(int exitCode, const Json& error, const std::atomic<bool>& interrupted);

 private:
  struct Stage {
    std::string name;
    double fraction = 0, seconds = 0, cpuSeconds = 0;
  };

  RunLog(std::string path, int descriptor);
  void write(std::string_view event, const Json& fields);
  void endStage();
  double secondsSoFar() const;
  void waitForDigests(bool hasFailed, const std::atomic<bool>& interrupted);
  void writeOutputs(const std::atomic<bool>& interrupted);

  std::string path_, run_;
  int descriptor_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  // of the lines and the stage
  Stage stage_;       // no name: none is open
  bool hasEnded_ = false, isWhole_ = true;
  std::atomic<bool> stops_ = false, digestsAreDone_ = false;
  std::thread digests_;
};

/// Ends the logs of the process in a signal handler, which calls _exit() then.
void endLogInHandler(int exitCode, const char* sentence) noexcept;

/// What the machine has: processors, memory.
Json machineFacts();

/// {"path", "bytes", "modified"}; the path alone for an address.
Json fileFacts(const std::string& path);

/// A moment in ISO 8601, UTC: "2026-01-31T12:00:00.123Z".
std::string isoTime(const std::timespec& moment);

}  // namespace arete
