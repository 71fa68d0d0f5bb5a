// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/store/packed/nodes/layout.h"

namespace arete::packed {

/// The bytes in front of the streams of a page's segment: its runs, and how long the streams are, and of a
/// surface what its nodes carry.
std::vector<std::byte> segmentHeader(const Segment& segment, std::span<const Run> runs, bool isOfSurface);

/// Reads the headers of the segments of a page: fills in its runs and the streams of its segments.
///
/// @param nodes of all pages; the segments are loaded (Segment::begin(), Segment::bytes())
/// @return false if the page is damaged: another number of nodes than its directory says, or more than its bytes can
/// hold
bool readHeaders(std::span<const std::byte> nodes, bool isOfSurface, Packet& page);

}  // namespace arete::packed
