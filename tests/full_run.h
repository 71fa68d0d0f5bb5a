// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace arete::test {

/// Whether the larger test matrix is asked for: ./dev test --full.
inline bool isFull() {
  return std::getenv("ARETE_FULL") != nullptr;
}

/// Whether everything takes ten times as long, as under sanitizers: what is tried on many samples is tried on
/// fewer.
inline bool isBrief() {
  return std::getenv("ARETE_BRIEF") != nullptr;
}

}  // namespace arete::test
