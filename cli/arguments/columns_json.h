// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"

namespace arete {

/// The columns of an open file, in its order: tag, what each has an element for, how a packed file holds it,
/// bytes. Chunks that this program does not know have a tag and bytes. Errors: corrupt: the metadata, or a
/// column of another size than it says.
Result<Json> columnsJson(const AmtContainer& file);

}  // namespace arete
