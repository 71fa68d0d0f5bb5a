// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"

namespace arete {

/// A frequency in MHz, above 0.
CLI::Validator megahertz();

/// The options that los, profile and viewshed share.
struct SightArguments {
  std::string earth;  ///< "ellipsoid", "plane" or empty: the ellipsoid where the DEM's CRS has one
  double refraction = kUsualRefraction;
  bool statesRefraction = false;  ///< false: the default
  NodataSight nodata = NodataSight::unknown;
  bool lonLat = false;

  CLI::Option* nodataOption = nullptr;

  bool statesNodata() const { return nodataOption != nullptr && nodataOption->count() > 0; }
  void addEarthTo(CLI::App& command);
  void addNodataTo(CLI::App& command);
  void addLonLatTo(CLI::App& command);

  /// The shape of the Earth that the options choose. Errors name the option.
  Result<std::unique_ptr<SightEarth>> makeEarth(const TerrainModel& model, Session& session) const;
  /// Its name for the answer: "ellipsoid" or "plane".
  std::string earthName(const TerrainModel& model) const;
  /// The refraction for the answer; null over a plane, which has none.
  Json refractionJson(const TerrainModel& model) const;
};

}  // namespace arete
