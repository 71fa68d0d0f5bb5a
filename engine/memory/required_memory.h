// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Call it before an array whose size is a number in a file: the system may grant memory that the machine
/// lacks, and end the program when it is touched.
/// @throw std::bad_alloc where `bytes` are more than the machine's memory.
void requireMemory(std::uint64_t bytes);

}  // namespace arete
