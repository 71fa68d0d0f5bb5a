// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"

namespace arete {

/// Joins a soup, a mesh of which every triangle has corners of its own, as weld() does
/// (surface/repair/weld.h): where positions are equal, within an object. Attributes of corners that differ
/// stay apart. Any other mesh stays as it is. file.joinedVertices counts what was joined, and file.vertexOf
/// says which vertex of the file each one is. Triangles keep their order. Errors: those of weld(). O(n log
/// n).
Status joinSoup(MeshFile& file, const RunContext& context = {});

}  // namespace arete
