// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each object is read by the list of its members: name, where its number goes, whether it may be missing. The
// first problem is reported. Numbers are written with the fewest digits that read back to the
// same double.
#include "viewer/camera/flight_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/file_writer.h"
#include "io/geo/crs/names.h"

namespace arete {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array kMembers = {"crs",      "heightUnitMetres", "speed",           "duration", "ease",
                                 "turnRate", "closed",           "framesPerSecond", "frames",   "comment"};
constexpr std::array kFrameMembers = {"x", "y", "height", "azimuth", "pitch", "fov", "comment"};

template <class Names>
void warnOfStrangers(const json& object, const Names& known, const std::string& where, Warnings& warnings) {
  for (const auto& member : object.items())
    if (std::ranges::find(known, member.key()) == known.end())
      warnings.push_back(
          {WarningCode::omitted, fmt::format("{}knows no \"{}\"; it is passed over", where, member.key())});
}

/// Takes numbers out of an object; keeps the first sentence of what is wrong.
class Numbers {
 public:
  explicit Numbers(const json& object) : object_(object) {}

  /// Nothing where it is missing or wrong.
  std::optional<double> find(const char* name) {
    const auto member = object_.find(name);
    if (member == object_.end()) return std::nullopt;
    // A text of a number too large for a double is no JSON number to the parser; null stands for NaN in some.
    if (!member->is_number()) {
      note(fmt::format("its {} is {}, not a number", name, member->type_name()));
      return std::nullopt;
    }
    const double value = member->get<double>();
    if (!std::isfinite(value)) note(fmt::format("its {} is not finite", name));
    return value;
  }
  void take(const char* name, double& value) {
    if (const auto found = find(name))
      value = *found;
    else
      note(fmt::format("its {} is missing", name));
  }
  void takeIfThere(const char* name, double& value) { value = find(name).value_or(value); }

  const std::string& problem() const { return problem_; }

 private:
  void note(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }

  const json& object_;
  std::string problem_;
};

/// Nothing where the CRS of the file fits the DEM's.
std::optional<std::string> findCrsProblem(const json& object, const Georeference& dem, Warnings& warnings) {
  const auto member = object.find("crs");
  if (member == object.end() || (member->is_string() && member->get<std::string>().empty())) {
    if (!dem.crsWkt.empty())
      warnings.push_back(
          {WarningCode::position, "says no CRS; its coordinates are taken for those of the DEM"});
    return std::nullopt;
  }
  if (!member->is_string()) return "its crs is not a text";
  const auto crs = member->get<std::string>();
  if (crs == dem.crsWkt) return std::nullopt;
  if (dem.crsWkt.empty())
    return fmt::format("is in the CRS {}, and the DEM has none to hold it against", crsName(crs));
  switch (compareCrs(crs, dem.crsWkt)) {
    case CrsAgreement::same:
      return std::nullopt;
    case CrsAgreement::different:
      return fmt::format("is in the CRS {}, the DEM in {}", crsName(crs), crsName(dem.crsWkt));
    case CrsAgreement::unknown:
      break;
  }
  return "its crs is unknown";
}

/// Reads one key frame; a sentence where that fails.
std::optional<std::string> findFrameProblem(const json& object, Camera& key) {
  if (!object.is_object()) return fmt::format("it is {}, not an object", object.type_name());
  Numbers numbers(object);
  numbers.take("x", key.xy.x);
  numbers.take("y", key.xy.y);
  numbers.take("height", key.height);
  numbers.take("azimuth", key.azimuthDegrees);
  numbers.take("pitch", key.pitchDegrees);
  numbers.takeIfThere("fov", key.verticalFieldOfViewDegrees);
  numbers.takeIfThere("parallelHeight", key.parallelHeight);
  if (numbers.problem().empty()) return std::nullopt;
  return numbers.problem();
}

}  // namespace

Result<FlightRead> readFlightText(std::string_view text, const std::string& name, const Georeference& dem,
                                  const LongitudeTurns& turns) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded())
    return failure(ErrorCode::corrupt, "is not JSON (which knows no NaN), or has a number too large", name);
  const auto refuse = [&](std::string problem) {
    return failure(ErrorCode::invalidData, std::move(problem), name);
  };
  if (!object.is_object()) return refuse("is no flight: a JSON object with frames");
  const auto frames = object.find("frames");
  if (frames == object.end() || !frames->is_array()) return refuse("has no array of key frames, \"frames\"");

  // Members that are not known are named in a warning, as they may be misspelt.
  FlightRead read;
  warnOfStrangers(object, kMembers, "", read.warnings);
  if (auto problem = findCrsProblem(object, dem, read.warnings)) return refuse(std::move(*problem));
  Numbers numbers(object);
  double heightUnit = dem.verticalUnitMetres;
  numbers.takeIfThere("heightUnitMetres", heightUnit);
  read.plan.speed = numbers.find("speed");
  read.plan.duration = numbers.find("duration");
  numbers.takeIfThere("ease", read.plan.easeSeconds);
  numbers.takeIfThere("turnRate", read.plan.turnRate);
  numbers.takeIfThere("framesPerSecond", read.plan.framesPerSecond);
  if (!numbers.problem().empty()) return refuse(numbers.problem());
  if (!(heightUnit > 0)) return refuse("its heightUnitMetres must be above 0");
  if (const auto closed = object.find("closed"); closed != object.end()) {
    if (!closed->is_boolean()) return refuse("its closed is neither true nor false");
    read.plan.isClosed = closed->get<bool>();
  }

  // A longitude is moved by whole turns to where the DEM lies, and a height gets the unit of the DEM. Equal
  // units are not multiplied, so that a flight survives to the bit.
  for (std::size_t i = 0; i < frames->size(); ++i) {
    Camera key;
    if (const auto problem = findFrameProblem((*frames)[i], key))
      return refuse(fmt::format("key frame {}: {}", i + 1, *problem));
    if (heightUnit != dem.verticalUnitMetres) key.height *= heightUnit / dem.verticalUnitMetres;
    warnOfStrangers((*frames)[i], kFrameMembers, fmt::format("key frame {} ", i + 1), read.warnings);
    key.xy = turns(key.xy);
    read.plan.keys.push_back(key);
  }
  return read;
}

Result<FlightRead> readFlight(const std::filesystem::path& path, const Georeference& dem,
                              const LongitudeTurns& turns) {
  ARETE_TRY(const auto bytes, FileBytes::read(path));
  return readFlightText(bytes.view(), path.string(), dem, turns);
}

// Only one of speed and duration is stated, and the text has the same one. The unit of heights is written
// always, so that the file does not depend on the DEM that it is read with.
std::string flightText(const FlightPlan& plan, const Georeference& dem) {
  ordered_json object;
  if (!dem.crsWkt.empty()) object["crs"] = dem.crsWkt;
  object["heightUnitMetres"] = dem.verticalUnitMetres;
  if (plan.speed) object["speed"] = *plan.speed;
  if (plan.duration) object["duration"] = *plan.duration;
  object["ease"] = plan.easeSeconds;
  object["turnRate"] = plan.turnRate;
  object["closed"] = plan.isClosed;
  object["framesPerSecond"] = plan.framesPerSecond;
  object["frames"] = ordered_json::array();
  for (const Camera& key : plan.keys) {
    object["frames"].push_back({{"x", key.xy.x},
                                {"y", key.xy.y},
                                {"height", key.height},
                                {"azimuth", key.azimuthDegrees},
                                {"pitch", key.pitchDegrees},
                                {"fov", key.verticalFieldOfViewDegrees}});
    if (key.parallelHeight > 0) object["frames"].back()["parallelHeight"] = key.parallelHeight;
  }
  return object.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Status writeFlight(const std::filesystem::path& path, const FlightPlan& plan, const Georeference& dem) {
  ARETE_TRY(auto writer, FileWriter::create(path));
  writer.write(flightText(plan, dem));
  return writer.finish();
}

}  // namespace arete
