// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text is parsed by std::from_chars, which takes no locale and no trailing characters.
#include "cli/arguments/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "cli/session/output_argument.h"
#include "engine/base/counted.h"
#include "io/files/file_writer.h"
#include "io/files/output_file.h"
#include "io/files/text/length_unit.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/data_unit.h"

namespace arete {
namespace {

constexpr std::string_view kStandardStream = "-";

namespace fs = std::filesystem;

std::optional<double> numberOf(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

/// A number, perhaps with a unit; whether the data's unit is known is seen when the data is read.
std::string toleranceProblem(const std::string& text) {
  std::optional<double> value = numberOf(text);
  if (!value) {
    const Result<StatedLength> length = parseLength(text, "");
    if (!length) return length.error().message;
    if (length->hasUnit()) value = length->number;
  }
  if (!value || std::isnan(*value)) return fmt::format("'{}' is not a number", text);
  if (*value < 0) return fmt::format("an error cannot be below zero, as {} is", text);
  return {};
}

CLI::Validator validator(std::function<std::string(std::string&)> check) {
  return CLI::Validator(std::move(check), "");
}

}  // namespace

CLI::Validator wholeNumber(std::int64_t least, std::int64_t most) {
  return validator([least, most](std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || end != text.data() + text.size())
      return fmt::format("'{}' is not a whole number", text);
    if (error != std::errc{} || value < least || value > most)
      return fmt::format("must be from {} to {}, not {}", least, most, text);
    return {};
  });
}

/// Numbers are checked as text and stay text, so that a message names what was typed. NaN fits no comparison,
/// so each check excludes it explicitly.
CLI::Validator realNumber() {
  return validator([](std::string& text) -> std::string {
    const std::optional<double> value = numberOf(text);
    return value && !std::isnan(*value) ? "" : fmt::format("'{}' is not a number", text);
  });
}

CLI::Validator rawValue() {
  return validator([](std::string& text) -> std::string {
    return numberOf(text) ? "" : fmt::format("'{}' is not a number", text);
  });
}

CLI::Validator finiteAtLeast(double least) {
  return validator([least](std::string& text) -> std::string {
    const std::optional<double> value = numberOf(text);
    if (!value || !std::isfinite(*value)) return fmt::format("'{}' is not a finite number", text);
    return *value >= least ? "" : fmt::format("must be {} or more, not {}", least, text);
  });
}

CLI::Validator finiteAbove(double bound) {
  return validator([bound](std::string& text) -> std::string {
    const std::optional<double> value = numberOf(text);
    if (!value || !std::isfinite(*value)) return fmt::format("'{}' is not a finite number", text);
    return *value > bound ? "" : fmt::format("must be above {}, not {}", bound, text);
  });
}

CLI::Validator finiteBetween(double least, double most) {
  return validator([least, most](std::string& text) -> std::string {
    const std::optional<double> value = numberOf(text);
    if (!value || !std::isfinite(*value)) return fmt::format("'{}' is not a finite number", text);
    return *value >= least && *value <= most
               ? ""
               : fmt::format("must be from {} to {}, not {}", least, most, text);
  });
}

// The words of a closed set are compared as they are; those that stand for numbers in any case of letters.
CLI::Validator oneOf(std::vector<std::string> words) {
  return validator([words = std::move(words)](std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    return fmt::format("'{}' must be one of {}", text, fmt::join(words, ", "));
  });
}

CLI::Validator oneOfNumbered(std::vector<std::pair<std::string, int>> words) {
  return validator([words = std::move(words)](std::string& text) -> std::string {
    std::vector<std::string> known;
    for (const auto& [word, number] : words) {
      if (CLI::detail::to_lower(text) == word) {
        text = std::to_string(number);
        return {};
      }
      known.push_back(word);
    }
    return fmt::format("'{}' must be one of {}", text, fmt::join(known, ", "));
  });
}

/// This takes a tolerance, or a share of the relief in percent. A share must be finite: no part of a relief
/// is infinite.
CLI::Validator shareOrTolerance(bool mayBeInfinite) {
  return validator([mayBeInfinite](std::string& text) -> std::string {
    const bool isShare = text.ends_with('%');
    const std::string number = isShare ? text.substr(0, text.size() - 1) : text;
    if (std::string problem = toleranceProblem(number); !problem.empty()) return problem;
    // A length with a unit is finite.
    return (mayBeInfinite && !isShare) || std::isfinite(numberOf(number).value_or(0))
               ? ""
               : fmt::format("'{}' is not a finite number", text);
  });
}

CLI::Validator tolerances() {
  return validator([](std::string& text) -> std::string {
    for (const std::string& part : splitAtCommas(text)) {
      const std::string number = part.ends_with('%') ? part.substr(0, part.size() - 1) : part;
      if (std::string problem = toleranceProblem(number); !problem.empty()) return problem;
    }
    return {};
  });
}

CLI::Validator lengthAtLeast(double least) {
  return validator([least](std::string& text) -> std::string {
    std::optional<double> value = numberOf(text);
    if (!value) {
      const Result<StatedLength> length = parseLength(text, "");
      if (!length) return length.error().message;
      value = length->number;
    }
    if (!std::isfinite(*value)) return fmt::format("'{}' is not a finite number", text);
    return *value >= least ? "" : fmt::format("must be {} or more, not {}", least, text);
  });
}

Result<double> lengthOf(const std::string& option, const std::string& text,
                        const Georeference& georeference) {
  const std::string culprit = fmt::format("{} {}", option, text);
  ARETE_TRY(const StatedLength length, parseLength(text, culprit));
  return inDataUnit(length, heightUnitOf(georeference), culprit);
}

CLI::Validator groundLength(const std::string& option, std::string& stated, double metres) {
  return validator([option, &stated, metres](std::string& text) -> std::string {
    if (numberOf(text)) return {};  // the checks behind this one refuse nan
    const Result<StatedLength> length = parseLength(text, "");
    if (!length) return length.error().message;
    if (!length->hasUnit()) return {};
    stated = fmt::format("{} {}", option, text);
    text = fmt::format("{}", length->number * length->unitMetres / metres);
    return {};
  });
}

Status checkGroundUnits(const Georeference& georeference, const std::vector<std::string>& stated) {
  for (const std::string& one : stated)
    if (!one.empty() && !(groundUnitOf(georeference).metres > 0))
      return failure(ErrorCode::usage,
                     "has a unit, and the terrain has no CRS: lengths along its ground are in the units of "
                     "its map",
                     one);
  return {};
}

Result<std::vector<double>> parseNumbers(const std::string& option, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : splitAtCommas(text)) {
    const std::optional<double> value = numberOf(part);
    if (!value || std::isnan(*value))
      return failure(ErrorCode::usage, fmt::format("'{}' is not a number", part), option);
    numbers.push_back(*value);
  }
  return numbers;
}

Result<std::pair<double, double>> twoNumbers(const std::string& option, std::string text, char separator) {
  const std::string culprit = fmt::format("{} {}", option, text);
  std::ranges::replace(text, separator, ',');
  ARETE_TRY(const auto numbers, parseNumbers(option, text));
  if (numbers.size() != 2)
    return failure(ErrorCode::usage, fmt::format("must be two numbers, not {}", numbers.size()), culprit);
  return std::pair(numbers[0], numbers[1]);
}

// The first file is the DEM that messages name; the others are further parts of it.
void DemArguments::addFilesTo(CLI::App& command, const std::string& help) {
  command
      .add_option_function<std::vector<std::string>>(
          "DEM",
          [this](const std::vector<std::string>& names) {
            path = names.front();
            reading.otherFiles.assign(names.begin() + 1, names.end());
          },
          help)
      ->required()
      ->type_name("");
}

std::vector<std::string> DemArguments::files() const {
  std::vector<std::string> all = {path};
  all.insert(all.end(), reading.otherFiles.begin(), reading.otherFiles.end());
  return all;
}

void DemArguments::addKindTo(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--as", [this](const std::string&) { staysPoints = true; },
          "points: a text whose points fill a grid stays points, as in a build with --as points")
      ->check(oneOf({"points"}))
      ->type_name("points")
      ->group(kGroup);
}

// Each option replaces what the file says, or says what it leaves open; the defaults leave it to the file.
void DemArguments::addTo(CLI::App& command) {
  const std::string group = kGroup;
  command.add_option("--band", reading.band, "Band of a raster (default: the first)")
      ->check(wholeNumber(1, 65535))
      ->type_name("N")
      ->group(group);
  command.add_option("--layer", reading.layer, "Layer of points, where the file has several")
      ->type_name("NAME")
      ->group(group);
  command.add_option("--z-field", reading.zField, "Field or column that holds the height of a point")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option(
          "--same-place", reading.samePlace,
          "Height of a place where points have different ones: min, max, mean, first (default: error)")
      ->check(oneOf({"error", "min", "max", "mean", "first"}))
      ->type_name("RULE")
      ->group(group);
  command.add_option("--nodata", reading.nodata, "Raw value that means NODATA, instead of the file's")
      ->check(rawValue())
      ->type_name("VALUE")
      ->group(group);
  command
      .add_option("--vertical-unit", reading.verticalUnit,
                  "Unit of the heights, where the file states none or a wrong one (m, ft, us-ft, ...)")
      ->type_name("UNIT")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--positive", [this](const std::string& word) { reading.isDepth = word == "down"; },
          "Direction in which the values count, instead of the file's: up, or down for depths, which are\n"
          "negated; a CRS that points down, and CF's positive: down, say so too")
      ->check(oneOf({"up", "down"}))
      ->type_name("DIRECTION")
      ->group(group);
  command
      .add_option("--crs", reading.crs,
                  "CRS of the coordinates, where the file has none or a wrong one (EPSG:32611, WKT, ...)")
      ->type_name("CRS")
      ->group(group);
}

std::string inputPath(const std::string& path) {
  // Files are opened several times, to see what they are: GDAL keeps what it has read, by default a mebibyte.
  const bool isStdin = path == kStandardStream || path == "/vsistdin/";
  return isStdin ? "/vsistdin?buffer_limit=-1" : path;
}

// The formats are listed from the table of the writers, so that help and check never lag behind it.
void MeshOutput::addTo(CLI::App& command, const std::string& help, const std::string& more,
                       std::vector<std::string> otherExtensions) {
  command
      .add_option("-o,--output", path,
                  fmt::format("{}: {}{}; - is stdout", help, writableMeshExtensions(), more))
      ->type_name("FILE");
  std::vector<std::string> names, extensions;
  for (const MeshFormat& known : meshFormats())
    if (known.write) {
      names.emplace_back(known.extension.substr(1));
      extensions.emplace_back(known.extension);
    }
  extensions.insert(extensions.end(), otherExtensions.begin(), otherExtensions.end());
  addOutputArgument(command, path, std::move(extensions));
  command
      .add_option("--format", format,
                  fmt::format("Format of the output, where its name does not say it, as of a pipe: {}",
                              fmt::join(names, ", ")))
      ->check(oneOf(names))
      ->type_name("NAME");
  command.add_flag("--packed", isPacked,
                   "Write a .glb or .gltf as small as it can be (EXT_meshopt_compression and\n"
                   "KHR_mesh_quantization, which readers must know); convert: or an .amt in its packed form");
  positionBitsOption =
      command
          .add_option(
              "--position-bits", positionBits,
              "In a packed file, round coordinates to a grid of at most 2^N steps along the longest side\n"
              "(a glTF: 8 to 16, default 14; an .amt of a surface: 8 to 24, default: vertices stay to the\n"
              "bit). What that moves is added to every stated error")
          ->check(CLI::Range(8, 24))
          ->type_name("N");
  flipOption = command.add_flag(
      "--flip-v", flipsV,
      "Turn texture coordinates over, v to 1 - v, of a file that counts them from the other\n"
      "side than its format says");
}

std::optional<int> MeshOutput::packedBits() const {
  constexpr int kUsualBits = 14;
  if (!isPacked) return {};
  return positionBits == 0 ? kUsualBits : positionBits;
}

Status MeshOutput::checkPacking() const {
  if (positionBits != 0 && !isPacked)
    return failure(ErrorCode::usage, "is the grid of a packed file; add --packed",
                   fmt::format("--position-bits {}", positionBits));
  return {};
}

std::string MeshOutput::open(Session& session) const {
  if (path != kStandardStream) return path;
  session.leaveStdout();
  return std::string(kStandardOutput);
}

Result<CrsTransform> transformOfPlaces(bool lonLat, const TerrainModel& model) {
  Result<CrsTransform> toDem = lonLat ? CrsTransform::fromLonLat(model.georeference) : CrsTransform();
  if (!toDem && toDem.error().culprit.empty()) toDem.error().culprit = "--lonlat";
  if (toDem) toDem->setTurns(LongitudeTurns(model));
  return toDem;
}

Result<DemRead> DemArguments::read(const Session& session) const {
  Result<DemRead> dem = (staysPoints ? readDemAsItIs : readDem)(inputPath(path), reading, session.context());
  if (dem && path == kStandardStream) std::visit([&](auto& field) { field.source = path; }, dem->heightfield);
  if (!dem) return tl::unexpected(named(std::move(dem.error())));
  session.warn(dem->warnings, path);
  return dem;
}

Error DemArguments::named(Error error) const {
  if (!reading.crs.empty() && error.culprit == reading.crs)
    error.culprit = fmt::format("--crs {}", reading.crs);
  else if (!reading.verticalUnit.empty() && error.culprit == reading.verticalUnit)
    error.culprit = fmt::format("--vertical-unit {}", reading.verticalUnit);
  return error;
}

/// An output that is an input, or another output under a second name or link, is found before any work
/// begins; so is a folder that cannot be written to.
Status checkOutput(const std::string& option, const std::string& path, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  const std::string culprit = fmt::format("{} {}", option, path);
  if (path == kStandardOutput) return {};
  if (path == kStandardStream)
    return failure(ErrorCode::usage, "this output cannot go to stdout: it needs the name of a file", culprit);
  const auto isSame = [&](const std::string& other) {
    std::error_code ignored;
    return path == other || fs::equivalent(path, other, ignored);
  };
  if (std::ranges::any_of(inputs, isSame))
    return failure(ErrorCode::usage, "is an input; writing would destroy it", culprit);
  if (std::ranges::any_of(outputs, isSame))
    return failure(ErrorCode::usage, "is written by this command already, as another output", culprit);
  const Result<OutputFile> file = OutputFile::create(path);
  if (!file) return failure(file.error().code, file.error().message, culprit);
  return {};
}

void addOverwriteTo(CLI::App& command, ExistingFile& existing) {
  command.add_flag_callback(
      "--overwrite", [&existing] { existing = ExistingFile::isReplaced; },
      "Replace a GeoPackage that exists as a whole (default: its other layers are kept)");
}

std::string outputName(const std::string& pattern, const std::string& tag, bool several) {
  constexpr std::string_view kPlaceholder = "{}";
  if (pattern.find(kPlaceholder) != std::string::npos) {
    std::string name = pattern;
    for (std::size_t at = 0; (at = name.find(kPlaceholder, at)) != std::string::npos; at += tag.size())
      name.replace(at, kPlaceholder.size(), tag);
    return name;
  }
  if (!several || pattern.empty()) return pattern;
  const std::filesystem::path path = pattern;
  return (path.parent_path() / fmt::format("{}_{}{}", path.stem().string(), tag, path.extension().string()))
      .string();
}

std::string withUnit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.6g}", value) : fmt::format("{:.6g} {}", value, unit);
}

std::string withReliefShare(double error, const std::string& unit, std::optional<double> relief) {
  const std::string text = withUnit(error, unit);
  return relief && *relief > 0 && std::isfinite(error)
             ? fmt::format("{} ({:.4g} % of the relief)", text, 100 * error / *relief)
             : text;
}

}  // namespace arete
