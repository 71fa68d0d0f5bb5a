// SPDX-License-Identifier: GPL-3.0-or-later
//
// The handlers store into a lock-free atomic and call alarm(), which is all that a signal handler may do. A
// system call that begins to block just after the signal would not see it: the alarm comes once a second from
// then on, and ends such a call too.
#include "cli/session/interrupt.h"

#include <unistd.h>

#include <csignal>

namespace arete {
namespace {

std::atomic<bool> gInterrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only use lock-free atomics");

extern "C" void setInterrupted(int) {
  gInterrupted.store(true, std::memory_order_relaxed);
  ::alarm(1);
}

extern "C" void endBlockedCall(int) {
  ::alarm(1);
}

}  // namespace

void catchInterrupts() {
  struct sigaction repeated = {};
  repeated.sa_handler = endBlockedCall;
  sigemptyset(&repeated.sa_mask);
  sigaction(SIGALRM, &repeated, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = setInterrupted;
    sigemptyset(&action.sa_mask);
    // SA_RESETHAND restores the default after the first signal. Without SA_RESTART it ends an open() or
    // read() that blocks, in libraries too.
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

const std::atomic<bool>& interruptFlag() {
  return gInterrupted;
}

}  // namespace arete
