// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "io/store/format/layout.h"

namespace arete {

/// Type and size of a chunk.
struct AmtShape {
  AmtTag tag{};
  AmtScalar scalar = AmtScalar::u8;
  std::uint32_t elementBytes = 1;
  std::uint64_t count = 0;
};

}  // namespace arete
