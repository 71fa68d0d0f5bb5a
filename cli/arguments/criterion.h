// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/option_kinds.h"
#include "engine/base/result.h"
#include "io/query/extract/region_argument.h"
#include "io/query/request/criterion.h"
#include "io/query/request/wholes.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A number of triangles, and what was stated of it: "5000", "10%".
struct StatedTriangles {
  std::string text;
  std::uint32_t count = 0;
};
/// Parses the numbers of --max-triangles. Errors: usage, naming the option: a number that is not whole, too
/// large, below one, or stated twice.
/// @param finest what a share is of: the triangles of the finest triangulation.
Result<std::vector<StatedTriangles>> parseTriangleBudgets(const std::string& text, std::uint64_t finest);
/// Whole numbers from 1, or shares, with commas between: texts that parseTriangleBudgets() may take.
CLI::Validator triangleBudgets();

/// The options that set the resolution of a TIN: everywhere, in a region, around a place or in a camera's
/// view, under a budget or a deadline.
struct CriterionArguments {
  void addTo(CLI::App& command, OptionKinds& kinds);

  /// Checks what does not depend on the model: options that contradict each other or have no effect. Errors:
  /// usage.
  Status check() const;
  /// The place of the camera in plan coordinates, where the terrain is needed to resolve its height; none
  /// without a camera.
  ///
  /// @param outline the model, or its root.
  /// Errors: usage.
  Result<std::optional<Vec2>> placeAboveGround(const TerrainModel& outline) const;
  /// A criterion of terrain, and what stands for it in the name of a file: "5", "1%", "5_20000", "2px".
  struct OfTerrain {
    CutRequest criterion;
    std::string tag;
  };
  /// @param model the root, and the terrain at placeAboveGround(), are enough
  /// @param wholes where statesShares()
  /// @return one criterion for each tolerance and each number of triangles.
  /// Precondition: check(). Errors: usage, naming the option; invalidData: no terrain below the camera.
  Result<std::vector<OfTerrain>> criteria(const TerrainModel& model,
                                          const std::optional<Wholes>& wholes) const;

  /// A warning of a focus that looks like longitude and latitude on a map of lengths; empty: none.
  std::string focusHint(const TerrainModel& model) const;

  /// What a surface can be cut by.
  struct OfSurface {
    std::string maxErrors;     ///< empty: not stated
    std::string maxTriangles;  ///< empty: not stated
    std::string region;        ///< --region; empty: none
    std::string outsideError;  ///< --outside-error; empty: not stated
    std::string camera;        ///< --camera; empty: none
    std::string viewport;      ///< --viewport; empty: not stated
    std::optional<double> fieldOfView;
    double parallelHeight = 0;  ///< --parallel-height; 0: perspective
    std::string focus;          ///< --focus; empty: none
    double errorGrowth = 0;
    CutRequest common;  ///< what stands in a request as it is stated
  };
  /// Precondition: no option is stated that is for terrain.
  OfSurface ofSurface() const;

  const std::string& region() const { return region_; }
  RegionText regionText() const { return {region_, stated_.distance, regionCrs_}; }
  bool hasDeadline() const { return stated_.deadlineMilliseconds.has_value(); }
  /// Whether an error or a number of triangles is stated in percent of the whole.
  bool statesShares() const;

 private:
  bool hasBudget() const { return !maxTriangles_.empty(); }
  bool hasOtherOrder() const { return !order_.empty() && order_ != "worst"; }
  /// What does not depend on the model.
  CutRequest common() const;

  static constexpr double kUnstated = std::numeric_limits<double>::quiet_NaN();

  Status checkFit() const;
  std::string tagOf(const CutRequest& criterion, const std::string& errorText,
                    const std::string& budgetText) const;
  Status placeCamera(const TerrainModel& model, CutRequest& criterion) const;
  Status placeFocus(const TerrainModel& model, CutRequest& criterion) const;

  std::string maxErrors_;
  std::string maxTriangles_;
  std::string method_ = "minimal", order_;
  std::string region_, regionCrs_;
  std::string outsideErrorText_;
  std::string distanceWithUnit_;  // as checkGroundUnits() takes it
  std::string focus_;
  double growth_ = kUnstated;
  std::string camera_, look_, viewport_;
  double fieldOfView_ = kUnstated, parallelHeight_ = 0;
  bool isLonLat_ = false;
  CutRequest stated_;  // options that are fields of it write there
  std::string fit_ = "none";
};

}  // namespace arete
