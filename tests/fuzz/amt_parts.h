// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/store/format/layout.h"

namespace arete::fuzz {

/// A chunk of an .amt file.
struct AmtPart {
  AmtChunk entry;
  std::vector<std::uint8_t> bytes;
};

/// An .amt file taken apart, so that a part can be changed and the file be put together again as a writer
/// would.
struct AmtParts {
  AmtHeader header;
  std::vector<AmtPart> parts;
};

/// @return Nothing where the directory makes no sense.
std::optional<AmtParts> takeApart(std::span<const std::uint8_t> file);

/// The file of these parts, with every size, place and checksum right: of chunks, of segments, of packed
/// nodes.
std::vector<std::uint8_t> putTogether(AmtParts& amt);

}  // namespace arete::fuzz
