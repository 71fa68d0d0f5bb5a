// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "io/store/amt/container.h"

namespace arete {

/// The columns of an open file, in its order: tag, what each has an element for, how a packed file holds it,
/// bytes. Chunks that this program does not know have a tag and bytes.
Json columnsJson(const AmtContainer& file);

}  // namespace arete
