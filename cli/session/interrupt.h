// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

namespace arete {

/// From here on the first SIGINT, SIGTERM or SIGHUP sets interruptFlag(), and a second one of the kind ends
/// the program at once. A signal that is ignored already (nohup) stays ignored.
void catchInterrupts();

/// What RunContext::cancel points to.
const std::atomic<bool>& interruptFlag();

}  // namespace arete
