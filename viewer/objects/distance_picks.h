// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "viewer/scene/layer.h"
#include "viewer/scene/subject.h"

namespace arete {

/// "stored error 0.0123 m", of a drawn triangle.
std::string storedErrorText(double error, const std::string& unit);

/// Places of surfaces that were clicked, and the straight line between two of them, which is a layer.
class DistancePicks {
 public:
  /// The layer's name.
  static constexpr const char* kLayer = "distance";

  /// Precondition: the layers outlive this.
  explicit DistancePicks(Layers& layers) : layers_(layers) {}

  /// The next place; a third begins anew.
  void add(const Pick& pick);
  void clear();

  const std::vector<Pick>& picks() const { return picks_; }
  /// From the first to the second, in the coordinates of the file if both are of one object, else of the
  /// scene. Precondition: two picks.
  Vec3 way() const;
  /// All of it, a line each: "A 1.5,2,3 material brick", "distance 4.2 m, dx 1, dy 2, dz 3", in the fewest
  /// digits that read back to the same numbers.
  std::string text(const std::string& unit) const;

 private:
  Layers& layers_;
  std::vector<Pick> picks_;  // none, one or two
};

}  // namespace arete
