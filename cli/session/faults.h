// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Installs signal handlers and repairs the standard descriptors.
///
/// * A file that is read through a mapping and truncated or overwritten meanwhile causes SIGBUS or SIGSEGV:
/// then the
///   run ends with a sentence and the exit code of a file that cannot be read.
/// * A library that uses what it could not allocate causes SIGSEGV, one that gives up SIGABRT: then the run
/// ends
///   as prepareForLackOfMemory() says. Any other such signal is a bug, and ends the program as it would
///   without this.
/// * SIGXFSZ (ulimit -f) is ignored, so that the write fails.
/// * Descriptors 0 to 2 that are closed are opened, so that no file of the run gets their numbers. Writing to
/// a
///   stdout that was closed still fails.
void prepareForFaults();

}  // namespace arete
