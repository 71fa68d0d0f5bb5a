// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Sends what GDAL and PROJ report outside every GdalErrors scope to a function, as one printable line each,
/// instead of to stderr. For a program; a library leaves this to its host.
///
/// @param tell May be called by several threads at once. Null: the messages are dropped.
void sendUnclaimedGdalMessages(void (*tell)(const char* line));

}  // namespace arete
