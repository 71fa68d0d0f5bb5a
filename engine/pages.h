// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace arete {

/// Memory from the system, zeros, that comes page by page as it is touched and is the system's again the
/// moment it is given back; the heap would keep it. nullptr when there is none.
void* takePages(std::size_t bytes);
/// `bytes` as they were taken.
void givePagesBack(void* pages, std::size_t bytes);

}  // namespace arete
