// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/zero_block.h"

#include "engine/pages.h"

namespace arete::packed {

bool ZeroBlock::take(std::size_t bytes) {
  memory_ = {};
  memory_ = {static_cast<std::byte*>(takeZeroPages(bytes)), Free{bytes}};
  return memory_ != nullptr;
}

void ZeroBlock::Free::operator()(std::byte* memory) const {
  giveZeroPagesBack(memory, bytes);
}

}  // namespace arete::packed
