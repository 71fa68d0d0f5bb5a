// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace arete::test {

/// Whether the larger test matrix is asked for: ./dev test --full.
inline bool isFull() {
  return std::getenv("ARETE_FULL") != nullptr;
}

}  // namespace arete::test
