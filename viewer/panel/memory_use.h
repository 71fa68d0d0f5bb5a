// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Resident memory of the process in bytes; 0 if the system does not report it.
std::uint64_t residentBytes();

/// Bytes of the buffers and textures of the current OpenGL context. Looks only at the object names 1 to 1000,
/// because drivers number objects from 1. Slow: call about once a second.
std::uint64_t deviceBytes();

}  // namespace arete
