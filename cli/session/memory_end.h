// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/exit_code.h"

namespace arete {

/// Prepares the process for allocations that fail where no exception can leave: in a destructor, or within
/// GDAL. Such a run ends with a sentence, without its temporary files, and with ExitCode::internal.
void prepareForLackOfMemory();

/// Whether an allocation of C++ has failed.
bool isMemoryShort() noexcept;

/// Ends the process as prepareForLackOfMemory() says. Both may be called by a signal handler.
[[noreturn]] void endForLackOfMemory() noexcept;

/// Ends the process. After an allocation has failed nothing else of it runs: libraries that lack what they
/// allocate crash when they tidy up at exit.
///
/// @return The code for main() to return, where memory was never short.
int leaveWith(ExitCode code);

}  // namespace arete
