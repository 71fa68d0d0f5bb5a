// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Sends what GDAL and PROJ report outside every GdalErrors scope to a function, as one printable line each,
/// instead of to stderr. For a program; a library leaves this to its host.
///
/// @param tell May be called by several threads at once. Null: the messages are dropped.
void sendUnclaimedGdalMessages(void (*tell)(const char* line));

/// Sends errors after which GDAL ends the process to a function first, wherever they occur. For a program.
void receiveFatalGdalErrors(void (*end)(const char* message));

/// Passes such an error on. For handlers of GDAL's errors.
void reportFatalGdalError(const char* message);

}  // namespace arete
