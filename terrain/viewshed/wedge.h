// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "terrain/viewshed/image_plane.h"
#include "terrain/viewshed/wedge_terrain.h"

namespace arete {

/// Sweeps one wedge of directions from the observer outwards, lattice line after lattice line
/// [FranklinRay1994]: fills the cells, and values, of the samples that are in it.
class ViewshedWedgeSweep {
 public:
  /// @param result has the size of the grid; other wedges fill other cells of it at the same time.
  ViewshedWedgeSweep(const ImagePlane& image, const ViewshedWedge& wedge, Viewshed& result);
  /// Returns early when the context is cancelled. Errors: those of the earth.
  Status run(const RunContext& context);
  /// @return samples that an engine answered.
  std::uint64_t rays() const { return rays_; }

 private:
  /// What one kind of evidence says of a sample.
  enum class Verdict : std::uint8_t {
    visible,    ///< nothing of this kind hides it
    hidden,     ///< something of this kind is in the way for sure
    undecided,  ///< it takes an engine's answer
  };
  struct Evidence {
    Verdict skyline, gaps, tips;
  };

  Status classifyLine(int x);
  Status classify(int x, int y);
  Verdict fieldVerdict(const ImageLine& line, std::size_t i, double target) const;
  static Verdict skylineVerdict(double target, const ViewshedHorizon::Bounds& skyline);
  Verdict gapVerdict(const ViewshedNearGaps::Crossing& gap, Verdict skyline) const;
  Verdict tipVerdict(int bin, double u, Verdict skyline) const;
  std::optional<ViewshedCell> combine(const Evidence& evidence) const;
  std::optional<float> valueOf(const ImageLine& line, std::size_t i, const Evidence& evidence,
                               const ViewshedHorizon::Bounds& skyline) const;
  Status askEngine(std::size_t at, int x, int y);
  bool isBeyondField(double x) const;

  const ImagePlane& image_;
  const ViewshedTask& task_;
  const ViewshedWedge& wedge_;
  Viewshed& result_;
  WedgeTerrain terrain_;
  bool hasField_, wantsValue_;
  std::uint64_t rays_ = 0;
};

}  // namespace arete
