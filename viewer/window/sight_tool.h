// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrain/sight/paths.h"
#include "terrain/sight/profile.h"
#include "viewer/scene/subject.h"

namespace arete {

/// A line of sight between two picks, ready to draw, with its description.
struct SightPicture {
  SightPathAnswer answer;
  std::vector<Vec3> points;         ///< along the line, metric, heights as they are; about a hundred
  std::optional<Vec3> obstruction;  ///< on the line
  std::size_t pointsBefore = 0;     ///< number of points before the obstruction; all without one
  std::vector<std::string> text;    ///< lines of the description
};

/// A piece of the line that has one colour, opaque: green where it is visible, red before what blocks it and
/// dark red behind, grey where the answer is open.
struct SightPiece {
  Vec3 from, to;
  bool isBefore;  ///< the obstruction; all pieces are, without one
  Rgba color;
};
/// The pieces of the line, divided at the obstruction.
std::vector<SightPiece> piecesOf(const SightPicture& picture);

/// Answers lines of sight between picks at full resolution, over the ellipsoid of the DEM's CRS where it has
/// one, with the usual refraction (docs/topics/visibility.md). Keeps references; thread-safe.
class SightTool {
 public:
  /// Preconditions: model and profiles outlive this.
  SightTool(const TerrainModel& model, const Profiles& profiles);

  /// Heights above the terrain in the DEM's vertical unit. Errors: those of answerPath().
  Result<SightPicture> between(const Pick& from, double fromAbove, const Pick& to, double toAbove) const;

  const SightEarth& earth() const { return *earth_; }
  /// "ellipsoid" or "plane".
  const std::string& earthName() const { return earthName_; }

 private:
  const TerrainModel& model_;
  const Profiles& profiles_;
  CameraSpace space_;
  std::unique_ptr<SightEarth> earth_;
  std::unique_ptr<SightEngine> engine_;
  std::string earthName_ = "plane";
};

}  // namespace arete
