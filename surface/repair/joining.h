// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/repair/draft.h"
#include "surface/repair/neighbourhood.h"

namespace arete::repair_passes {

/// Makes one vertex of two at one position.
class Joining {
 public:
  /// Both outlive it. @param neighbours of the draft's mesh
  Joining(Draft& draft, Neighbourhood& neighbours);

  /// The vertex that one has become.
  std::uint32_t now(std::uint32_t vertex);
  /// Whether two vertices can become one, or are one: no triangle has both, and no edge gets more than the
  /// two sides that lie on it.
  bool canJoin(std::uint32_t a, std::uint32_t b);
  /// The higher one becomes the lower one. Precondition: canJoin().
  void join(std::uint32_t a, std::uint32_t b);

 private:
  Draft& draft_;
  Neighbourhood& neighbours_;
  std::vector<std::uint32_t> now_;  // by vertex: itself, or one that it was joined with
};

}  // namespace arete::repair_passes
