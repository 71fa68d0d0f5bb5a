// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/repair/joining.h"

#include <algorithm>
#include <numeric>

namespace arete::repair_passes {

Joining::Joining(Draft& draft, Neighbourhood& neighbours)
    : draft_(draft), neighbours_(neighbours), now_(draft.mesh.positions.size()) {
  std::iota(now_.begin(), now_.end(), 0u);
}

std::uint32_t Joining::now(std::uint32_t vertex) {
  while (now_[vertex] != vertex) vertex = now_[vertex] = now_[now_[vertex]];
  return vertex;
}

bool Joining::canJoin(std::uint32_t a, std::uint32_t b) {
  a = now(a);
  b = now(b);
  if (a == b) return true;
  if (!neighbours_.atEdge(a, b).empty()) return false;
  for (const std::uint32_t w : neighbours_.around(a)) {
    const std::size_t there = neighbours_.atEdge(b, w).size();
    if (there > 0 && there + neighbours_.atEdge(a, w).size() > 2) return false;
  }
  return true;
}

void Joining::join(std::uint32_t a, std::uint32_t b) {
  a = now(a);
  b = now(b);
  if (a == b) return;
  const std::uint32_t kept = std::min(a, b), gone = std::max(a, b);
  const std::vector<std::uint32_t> moved = neighbours_.at(gone);
  for (const std::uint32_t t : moved) {
    neighbours_.remove(t);
    std::ranges::replace(draft_.mesh.triangles[t], gone, kept);
    neighbours_.add(t);
  }
  now_[gone] = kept;
  ++draft_.counts.joinedVertices;
}

}  // namespace arete::repair_passes
