// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Bytes of memory that the process holds (resident); 0 where the system does not say.
std::uint64_t residentBytes();

/// Bytes of the buffers and textures of the OpenGL context that is current. Names are looked up to the
/// thousandth: drivers give them out from 1 on. For a panel, about once a second.
std::uint64_t deviceBytes();

}  // namespace arete
