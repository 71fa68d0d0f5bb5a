// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

#include "terrain/sight/engine.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

/// @return whether a place is in the range of distances and the horizontal field.
bool isInField(const ViewshedField& field, double distance, double azimuthDegrees);

/// Computes single cells of a viewshed, by an engine's answer for the line. It defines what every method
/// returns.
class ViewshedExact {
 public:
  ViewshedExact(const SightEngine& engine, const SightEarth& earth, double heightUnitMetres,
                const ViewshedObserver& observer, const ViewshedOptions& options)
      : engine_(engine), earth_(earth), unit_(heightUnitMetres), observer_(observer), options_(options) {}

  struct Answer {
    ViewshedCell cell = ViewshedCell::outside;
    float value = std::numeric_limits<float>::quiet_NaN();
  };
  /// A place to which the Earth has no line (over a pole, say) is unknown, and counted.
  /// @param ground the terrain's height there; NaN: the cell is outside.
  /// @return Errors: those of the earth but for such places.
  Result<Answer> at(Vec2 plan, double ground) const;
  /// How many places had no line so far.
  std::uint64_t withoutLine() const { return withoutLine_; }

 private:
  float value(const SightTrack& track, double ground) const;

  const SightEngine& engine_;
  const SightEarth& earth_;
  double unit_;
  const ViewshedObserver& observer_;
  const ViewshedOptions& options_;
  mutable std::atomic<std::uint64_t> withoutLine_ = 0;
};

}  // namespace arete
