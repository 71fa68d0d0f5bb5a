// SPDX-License-Identifier: GPL-3.0-or-later
//
// The handler calls only what a signal handler may: stat(), write(), unlink(), _exit(), pause().
//
// Parts of GDAL and of what it uses do not look whether an allocation has failed, and use the null pointer,
// or call abort(). The system leaves ENOMEM in errno, which nothing that succeeds resets: that tells such a
// fault from a bug.
#include "cli/session/faults.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "cli/session/exit_code.h"
#include "cli/session/memory_end.h"
#include "cli/session/run_log.h"
#include "io/files/temporary_files.h"
#include "io/files/watched_files.h"

namespace arete {
namespace {

struct sigaction gBusBefore, gSegvBefore, gAbortBefore;
std::atomic_flag gIsEnding;

void writeError(const char* text, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(STDERR_FILENO, text, size);
    if (written <= 0) return;
    text += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// Whether a fault is the use of a member or an element of what could not be allocated, or the end that a
/// library chose instead.
bool isLackOfMemory(int signal, const siginfo_t* about, int error) {
  if (error != ENOMEM && !isMemoryShort()) return false;
  if (signal == SIGABRT) return about->si_pid == ::getpid();
  constexpr std::uintptr_t kFirstPages = 65536;
  return signal == SIGSEGV && about->si_code > 0 &&
         reinterpret_cast<std::uintptr_t>(about->si_addr) < kFirstPages;
}

extern "C" void onFault(int signal, siginfo_t* about, void*) {
  const int error = errno;
  if (const char* const name = signal == SIGABRT ? nullptr : changedInputFile()) {
    // Several threads may meet the change at once: one tells of it and ends them all.
    if (gIsEnding.test_and_set())
      for (;;) ::pause();
    constexpr char kBefore[] = "arete: ", kAfter[] = ": was changed while it was read\n";
    writeError(kBefore, sizeof kBefore - 1);
    for (const char* c = name; *c; ++c) {  // a name may hold what drives a terminal
      const char shown = static_cast<unsigned char>(*c) < 32 || *c == 127 ? '?' : *c;
      writeError(&shown, 1);
    }
    writeError(kAfter, sizeof kAfter - 1);
    endLogInHandler(static_cast<int>(ExitCode::file), "an input was changed while it was read");
    removeNotedFiles();
    ::_exit(static_cast<int>(ExitCode::file));
  }
  if (isLackOfMemory(signal, about, error)) endForLackOfMemory();
  endLogInHandler(128 + signal, "a fault, which is a bug");
  removeNotedFiles();
  // The instruction runs again on return, and meets what was there before this; abort() raises its signal
  // again.
  ::sigaction(signal,
              signal == SIGBUS    ? &gBusBefore
              : signal == SIGABRT ? &gAbortBefore
                                  : &gSegvBefore,
              nullptr);
}

void openClosed(int descriptor, int flags) {
  if (::fcntl(descriptor, F_GETFD) >= 0) return;
  // The lowest free number is this one, because those below are open.
  ::open("/dev/null", flags);
}

}  // namespace

void prepareForFaults() {
  openClosed(STDIN_FILENO, O_RDONLY);
  openClosed(STDOUT_FILENO, O_RDONLY);  // not for writing: an answer that cannot be written is an error
  openClosed(STDERR_FILENO, O_WRONLY);
  struct sigaction action = {};
  action.sa_sigaction = onFault;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGBUS, &action, &gBusBefore);
  ::sigaction(SIGSEGV, &action, &gSegvBefore);
  ::sigaction(SIGABRT, &action, &gAbortBefore);
  ::signal(SIGXFSZ, SIG_IGN);
  watchInputFiles();
}

}  // namespace arete
