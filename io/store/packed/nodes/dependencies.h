// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "io/store/entropy/number_bytes.h"
#include "io/store/packed/nodes/layout.h"

namespace arete::packed {

/// Writes the packets that a packet depends on. The first one of all is left out, since every other packet
/// depends on it; the rest are differences.
inline void writeDependencies(const Packet& packet, NumberWriter& out) {
  const std::span dependsOn = std::span(packet.dependsOn).subspan(packet.dependsOn.empty() ? 0 : 1);
  out.number(dependsOn.size());
  std::uint32_t next = 1;
  for (const std::uint32_t other : dependsOn) {
    out.number(other - next);
    next = other + 1;
  }
}

/// Reads them.
/// @param number of the packet, among all
/// @return false if one of them does not come before the packet, or the bytes end
inline bool readDependencies(std::uint64_t number, NumberReader& in, Packet& packet) {
  constexpr std::uint32_t kMost = MultiTriangulation::kNone - 1;
  if (number > 0) packet.dependsOn.push_back(0);
  std::uint64_t next = 1;
  for (std::uint32_t left = in.number(kMost); left > 0; --left) {
    next += in.number(kMost);
    if (in.isBad() || next >= number) return false;
    packet.dependsOn.push_back(static_cast<std::uint32_t>(next++));
  }
  return true;
}

}  // namespace arete::packed
