// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/formats/common/file.h"

namespace arete {

/// A surface is built of the coordinates that its file has. Where the file has metres and reading made
/// degrees of them (MeshFrame::isLocalMetres), a surface of those would be a wall: the metres are restored,
/// with the rounding that they have in the file, and the CRS, which they are not of, is dropped. O(vertices).
///
/// @return the warning that says so; nothing of any other mesh, which does not change.
/// Errors: of georeferenceOf() and LocalFrame::create().
Result<std::optional<Warning>> returnToLocalMetres(MeshFile& file);

}  // namespace arete
