// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Which tolerance the next frame is drawn with: the one that is wanted, unless frames take too long or have
/// too many triangles; then as much coarser as needed, and finer again, slowly, as there is room.
class ToleranceControl {
 public:
  struct Wanted {
    double pixels = 1;
    std::uint32_t maxTriangles = 0;  ///< 0 = any number
    double frameMilliseconds = 0;    ///< 0 = any time
    double coarsestPixels = 64;
  };
  struct Seen {
    double milliseconds = 0;      ///< of the last frame
    std::uint32_t triangles = 0;  ///< that its cut asked for
    double pixels = 1;            ///< that it was asked with
  };

  /// Of the next frame. Triangles fall about as the tolerance grows; one step changes it by a fifth for time,
  /// and as far as needed for a budget.
  double next(const Wanted& wanted, const Seen& seen);

 private:
  double pixels_ = 0;
};

}  // namespace arete
