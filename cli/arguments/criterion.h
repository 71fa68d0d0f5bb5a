// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/extract/criterion.h"
#include "io/extract/region_argument.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The options that set the resolution of a TIN: everywhere, in a region, around a place or in a camera's
/// view, under a budget or a deadline.
struct CriterionArguments {
  void addTo(CLI::App& command);

  /// Checks what does not depend on the model: options that contradict each other or have no effect. Errors:
  /// usage.
  Status check() const;
  /// The place of the camera in plan coordinates, where the terrain is needed to resolve its height; none
  /// without a camera.
  ///
  /// @param outline the model, or its root.
  /// Errors: usage.
  Result<std::optional<Vec2>> placeAboveGround(const TerrainModel& outline) const;
  /// @param model the root, and the terrain at placeAboveGround(), are enough.
  /// @return one criterion for each tolerance, or the only one.
  /// Precondition: check(). Errors: usage, naming the option; invalidData: no terrain below the camera.
  Result<std::vector<ExtractCriterion>> criteria(const TerrainModel& model) const;

  /// What a surface can be cut by. Errors: usage, naming an option that is stated and is for terrain.
  struct OfSurface {
    std::string maxErrors;  ///< empty: not stated
    std::optional<std::uint32_t> maxTriangles;
    bool isSaturated = false;
    std::string region;        ///< --region; empty: none
    std::string outsideError;  ///< --outside-error; empty: not stated
    std::string camera;        ///< --camera; empty: none
    std::string viewport;      ///< --viewport; empty: not stated
    std::optional<double> pixelError, fieldOfView;
    bool isFitted = false;  ///< --fit rms
  };
  Result<OfSurface> ofSurface() const;

  const std::string& region() const { return region_; }
  RegionText regionText() const { return {region_, distance_, regionCrs_}; }
  bool hasDeadline() const { return deadline_ > 0; }
  /// Whether it states what terrain does not have.
  bool isForSurfaces() const { return fit_ == "rms"; }

 private:
  static constexpr double kUnstated = std::numeric_limits<double>::quiet_NaN();

  Status checkFit() const;
  Status placeCamera(const TerrainModel& model, ExtractCriterion& criterion) const;
  Status placeFocus(const TerrainModel& model, ExtractCriterion& criterion) const;

  std::string maxErrors_;
  std::int64_t maxTriangles_ = -1;  // < 0: not stated
  std::string method_ = "minimal", order_ = "worst";
  std::string region_, regionCrs_;
  double distance_ = 0;
  std::string outsideErrorText_;
  std::string focus_;
  double growth_ = kUnstated;
  std::string camera_, look_, viewport_;
  double fieldOfView_ = kUnstated, pixelError_ = kUnstated;
  bool isLonLat_ = false;
  double deadline_ = 0;  // 0: none
  std::string fit_ = "none";
};

}  // namespace arete
