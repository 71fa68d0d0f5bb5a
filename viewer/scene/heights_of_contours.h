// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "engine/base/result.h"
#include "viewer/scene/layer.h"

namespace arete {

/// Writes the heights of contours beside their lines, of the lines of an interval.
using WriteHeights = std::function<Result<Layer::Drawn>(double interval)>;

/// Keeps the layer "heights of contours" in step with the layer "contours": there with it, hidden with it,
/// and of its interval.
class HeightsOfContours {
 public:
  /// @param write  empty: there are none
  explicit HeightsOfContours(WriteHeights write) : write_(std::move(write)) {}

  /// @param isChanging  the interval is being changed by hand: heights of another one are taken away, and new
  /// ones wait.
  /// Errors: those of writing.
  Status follow(Layers& layers, bool isChanging = false);

 private:
  WriteHeights write_;
  double interval_ = 0;  // that the heights are of; 0: there are none
};

}  // namespace arete
