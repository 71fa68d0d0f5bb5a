// SPDX-License-Identifier: GPL-3.0-or-later
//
// An exception that meets a noexcept function calls std::terminate(), whose handler still knows the
// exception. GDAL reports the lack of memory as a fatal error before it calls abort(). That memory was short
// at all is noted by the handler that operator new calls when it fails.
#include "cli/session/memory_end.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "cli/session/run_log.h"
#include "io/files/temporary_files.h"
#include "io/geo/gdal/unclaimed_messages.h"

namespace arete {
namespace {

std::atomic<bool> gWasShort = false;
std::atomic_flag gMemoryEnds;
std::terminate_handler gTerminateBefore = nullptr;

void noteShortage() {
  gWasShort = true;
  throw std::bad_alloc();
}

[[noreturn]] void onTerminate() {
  if (std::current_exception()) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      endForLackOfMemory();
    } catch (...) {
    }
  }
  // A lock or a thread that cannot be made is an exception of another kind.
  if (gWasShort) endForLackOfMemory();
  if (gTerminateBefore) gTerminateBefore();
  std::abort();
}

void onFatalGdalError(const char* message) {
  if (gWasShort || std::strstr(message, "emory") || std::strstr(message, "alloc")) endForLackOfMemory();
}

}  // namespace

bool isMemoryShort() noexcept {
  return gWasShort;
}

void endForLackOfMemory() noexcept {
  // Several threads may come here at once: one ends them all.
  if (gMemoryEnds.test_and_set())
    for (;;) ::pause();
  constexpr char kSentence[] = "arete: there is not enough memory for this\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kSentence, sizeof kSentence - 1);
  endLogInHandler(static_cast<int>(ExitCode::internal), "there is not enough memory for this");
  removeNotedFiles();
  ::_exit(static_cast<int>(ExitCode::internal));
}

void prepareForLackOfMemory() {
  std::set_new_handler(noteShortage);
  gTerminateBefore = std::set_terminate(onTerminate);
  receiveFatalGdalErrors(onFatalGdalError);
}

int leaveWith(ExitCode code) {
  if (!gWasShort) return static_cast<int>(code);
  std::fflush(stdout);
  std::fflush(stderr);
  removeNotedFiles();
  ::_exit(static_cast<int>(code));
}

}  // namespace arete
