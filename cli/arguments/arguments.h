// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/files/existing_file.h"
#include "io/files/text/grouped.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/dem_reader.h"
#include "terrain/model/source_reading.h"
#include "terrain/model/terrain_model.h"

namespace arete {

// Validators of an option's text. An error is a sentence that follows the option's name. All but rawValue()
// refuse NaN, which CLI::Range and CLI::Number let through.

CLI::Validator wholeNumber(std::int64_t least, std::int64_t most);
CLI::Validator realNumber();
/// A raw value of a file, which may be nan or infinite.
CLI::Validator rawValue();
CLI::Validator finiteAtLeast(double least);
CLI::Validator finiteAbove(double bound);
CLI::Validator finiteBetween(double least, double most);
CLI::Validator oneOf(std::vector<std::string> words);
/// One of some words, in upper or lower case, each of which stands for a value of an enumeration.
CLI::Validator oneOfNumbered(std::vector<std::pair<std::string, int>> words);
template <class Enum>
CLI::Validator oneOf(const std::vector<std::pair<std::string, Enum>>& words) {
  std::vector<std::pair<std::string, int>> numbers;
  for (const auto& [word, value] : words) numbers.emplace_back(word, static_cast<int>(value));
  return oneOfNumbered(std::move(numbers));
}
/// A tolerance, or a share of the whole: "0.5%". "inf" only where it may be infinite.
CLI::Validator shareOrTolerance(bool mayBeInfinite = true);
/// One or more tolerances with commas between, each perhaps with a percent sign.
CLI::Validator tolerances();

/// A finite length, perhaps with a unit.
CLI::Validator lengthAtLeast(double least);
/// The length in the unit of heights. Errors: usage, naming the option.
Result<double> lengthOf(const std::string& option, const std::string& text, const Georeference& georeference);

/// A length along the ground, as a number or with a unit, which becomes a number of metres.
///
/// @param stated gets "OPTION TEXT" where it has a unit, for checkGroundUnits(); must outlive the parser.
/// @param metres in what the option counts in: 1000 for kilometres.
CLI::Validator groundLength(const std::string& option, std::string& stated, double metres = 1);
/// Refuses a length with a unit where lengths along the ground are in the units of a map without a CRS.
///
/// @param stated of groundLength(); those that are empty have none.
/// Errors: usage, naming the option.
Status checkGroundUnits(const Georeference& georeference, const std::vector<std::string>& stated);

/// Parses numbers with commas between. Errors: usage, naming the option and the part that is not a number.
Result<std::vector<double>> parseNumbers(const std::string& option, const std::string& text);

/// Parses two numbers with a separator between, as in 1920x1080. Errors: usage, naming the option.
Result<std::pair<double, double>> twoNumbers(const std::string& option, std::string text, char separator);

/// The transform of typed places, or places of a file, into the DEM's CRS; longitudes are moved by whole
/// turns to the DEM.
///
/// @param lonLat whether the places are longitude and latitude (WGS 84).
/// Errors name --lonlat.
Result<CrsTransform> transformOfPlaces(bool lonLat, const TerrainModel& model);

/// The options of every command that reads a DEM.
struct DemArguments {
  static constexpr const char* kGroup = "Reading the DEM";  ///< of the options in the help

  std::string path;
  SourceReading reading;
  bool staysPoints = false;  ///< a text whose points fill a grid is not made a raster

  void addTo(CLI::App& command);
  /// Adds the argument that names one DEM or the files of one.
  void addFilesTo(CLI::App& command, const std::string& help);
  /// Adds --as points, of commands that have no other kinds.
  void addKindTo(CLI::App& command);
  /// The path and what was named after it.
  std::vector<std::string> files() const;
  /// Reads the DEM and writes its warnings. An error names the option that caused it, if one did.
  Result<DemRead> read(const Session& session) const;
  /// An error of reading, with the option that caused it.
  Error named(Error error) const;
};

/// "-" stands for stdin, which GDAL reads under a name of its own.
std::string inputPath(const std::string& path);

/// The output of a mesh: a file, or "-" for stdout, and the format where the name does not say it.
struct MeshOutput {
  std::string path, format;
  bool isPacked = false, isPaged = false, flipsV = false;
  int positionBits = 0;  ///< 0: as many as usual
  CLI::Option *positionBitsOption = nullptr, *flipOption = nullptr;

  /// Adds --output, the same as an argument, --format, --packed, --position-bits and --flip-v. Call behind
  /// the argument of the input.
  ///
  /// @param help begins the help of --output.
  /// @param more ends it.
  /// @param otherExtensions of what the command writes beside meshes: ".tif".
  void addTo(CLI::App& command, const std::string& help, const std::string& more,
             std::vector<std::string> otherExtensions = {});
  /// MeshPacking::positionBits of a packed glTF; empty: it is not packed.
  std::optional<int> packedBits() const;
  /// Errors: usage: --position-bits without --packed.
  Status checkPacking() const;
  /// @return The path to write to. If that is stdout, the session leaves it to the mesh.
  std::string open(Session& session) const;
};

/// Checks that a file can be written: its folder is writable, and it is neither an input nor another output
/// of the command. Creates nothing. Errors name the option.
Status checkOutput(const std::string& option, const std::string& path, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs = {});

/// The name of one of several outputs: `tag` in place of every {} of the pattern; without any, where there
/// are several, "_tag" before the extension.
std::string outputName(const std::string& pattern, const std::string& tag, bool several);

/// The option --overwrite of a command that may write a GeoPackage.
void addOverwriteTo(CLI::App& command, ExistingFile& existing);

/// "5 m", or "5" where the unit is not known.
std::string withUnit(double value, const std::string& unit);
/// "12.3 m", and "12.3 m (1.5 % of the relief)" where the relief is known.
std::string withReliefShare(double error, const std::string& unit, std::optional<double> relief);

}  // namespace arete
