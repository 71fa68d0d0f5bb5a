// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

namespace arete {

/// Installs signal handlers: the first SIGINT, SIGTERM or SIGHUP sets interruptFlag() and ends a system call
/// that blocks, also one that begins to block within the next second; a second of the same kind ends the
/// program at once. A signal that is already ignored (nohup) stays ignored.
void catchInterrupts();

/// The flag for RunContext::cancel.
const std::atomic<bool>& interruptFlag();

}  // namespace arete
