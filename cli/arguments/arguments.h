// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/crs/transform.h"
#include "io/dem/dem_reader.h"
#include "terrain/model/source_reading.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Checks of an option's text; what is wrong is said in a sentence behind the option's name. None takes NaN.
CLI::Validator wholeNumber(std::int64_t least, std::int64_t most);
CLI::Validator realNumber();
CLI::Validator finiteAtLeast(double least);
CLI::Validator finiteAbove(double bound);
CLI::Validator finiteBetween(double least, double most);
CLI::Validator oneOf(std::vector<std::string> words);
/// One of some words, upper and lower case alike, each of which stands for a value of an enumeration.
CLI::Validator oneOfNumbered(std::vector<std::pair<std::string, int>> words);
template <class Enum>
CLI::Validator oneOf(const std::vector<std::pair<std::string, Enum>>& words) {
  std::vector<std::pair<std::string, int>> numbers;
  for (const auto& [word, value] : words) numbers.emplace_back(word, static_cast<int>(value));
  return oneOfNumbered(std::move(numbers));
}
/// An error in the unit of the heights: 0 or more, "inf" allowed.
CLI::Validator tolerance();
/// One or more tolerances with commas between.
CLI::Validator tolerances();

/// The numbers of a text with commas between. Errors: usage, naming the option and what is no number.
Result<std::vector<double>> parseNumbers(const std::string& option, const std::string& text);

/// Two numbers and what stands between them, as in 1920x1080. Errors: usage, naming the option.
Result<std::pair<double, double>> twoNumbers(const std::string& option, std::string text, char separator);

/// Brings places that are typed, or read from a file, into the DEM's CRS, and whole turns of longitude to
/// where it is. Errors name --lonlat.
Result<CrsTransform> transformOfPlaces(bool lonLat, const TerrainModel& model);

/// How to read a DEM; the options of all commands that do.
struct DemArguments {
  std::string path;
  SourceReading reading;

  void addTo(CLI::App& command);
  /// readDem(), its warnings said; an error names the option where one is to blame.
  Result<DemRead> read(const Session& session) const;
};

/// That a file can be written under that name: it has a folder that can be written to, is none of the inputs
/// and none of what the command writes beside it. Errors name the option. Nothing is created.
Status checkOutput(const std::string& option, const std::string& path, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs = {});

/// 769671 as "769 671".
std::string grouped(std::uint64_t count);
/// "5 m", or "5" where the unit is not known.
std::string withUnit(double value, const std::string& unit);
/// "140.3 MB".
std::string byteCount(std::uint64_t bytes);

}  // namespace arete
