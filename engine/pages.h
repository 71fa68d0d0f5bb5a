// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace arete {

/// Memory from the system, zeros, that comes page by page as it is touched; the heap would keep it when it is
/// no longer used. nullptr when there is none.
void* takeZeroPages(std::size_t bytes);
/// The same, but what is in it may be anything: kept pages first (PageKeeper).
void* takePages(std::size_t bytes);
/// Pages of either kind, `bytes` as they were taken: they are the system's again at once, or kept.
void givePagesBack(void* pages, std::size_t bytes);

/// While there is one, pages given back are kept for those who take some next: a page from the system has to
/// be cleared, and found, at its first touch, which takes about as long as filling it ten times over. When
/// the last one goes, the system gets what is left. Pages are kept by the process, for all of its threads; a
/// program never holds more of them than it has used at once.
class PageKeeper {
 public:
  PageKeeper();
  ~PageKeeper();
  PageKeeper(const PageKeeper&) = delete;
  PageKeeper& operator=(const PageKeeper&) = delete;
};

}  // namespace arete
