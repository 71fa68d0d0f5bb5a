// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/geo/crs/longitude_turns.h"
#include "terrain/model/georeference.h"
#include "viewer/camera/flight.h"

namespace arete {

/// A flight as it was read.
struct FlightRead {
  FlightPlan plan;
  Warnings warnings;
};

/// Reads a flight in the format of docs/topics/flights.md for a DEM. Heights in another unit are brought into
/// the DEM's. What is checked here is the file; what its numbers mean together, Flight::create() checks.
///
/// Errors, naming the file and the key frame: those of reading a file; corrupt (no JSON); invalidData (a
/// number that is missing, no number or not finite; a CRS that is not the DEM's or that it cannot be held
/// against).
///
/// @param turns Onto the DEM: key frames that are whole turns away are brought there.
Result<FlightRead> readFlight(const std::filesystem::path& path, const Georeference& dem,
                              const LongitudeTurns& turns = {});

/// The same of a text; `name` stands for the file in errors.
Result<FlightRead> readFlightText(std::string_view text, const std::string& name, const Georeference& dem,
                                  const LongitudeTurns& turns = {});

/// The text that reads back to the same plan, to the bit. The keys' picture sizes are not kept.
std::string flightText(const FlightPlan& plan, const Georeference& dem);

/// Writes it; a file of that name is replaced. Errors: those of FileWriter.
Status writeFlight(const std::filesystem::path& path, const FlightPlan& plan, const Georeference& dem);

}  // namespace arete
