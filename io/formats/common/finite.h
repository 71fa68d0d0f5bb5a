// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "io/formats/common/file.h"

namespace arete {

/// The first vertex that a face uses and whose coordinates are not finite; of a mesh without faces, of all
/// vertices. Missing if there is none. O(size).
std::optional<std::uint32_t> firstUnusable(const TriangleMesh& mesh);

/// Leaves out the vertices of a mesh that no face uses and whose coordinates are not finite, as scanners
/// write where they saw nothing, and warns of them with their number. A mesh without faces stays as it is.
/// O(size).
void leaveOutUnusedNumbers(MeshFile& file);

}  // namespace arete
