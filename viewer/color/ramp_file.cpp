// SPDX-License-Identifier: GPL-3.0-or-later
//
// All formats are lines of a value and a colour, so one reader takes them; only what follows the colour
// differs. A label differs from a number too many in its first letter, or QGIS's header says so. Whatever
// would be read as something else by one of these programs is refused: a wrong colour is not seen to be
// wrong.
#include "viewer/color/ramp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "viewer/color/difference.h"

namespace arete {
namespace {

constexpr std::size_t kMostStops = 1u << 20;

/// GDAL's and GRASS's colours.
struct NamedColor {
  std::string_view name;
  Rgb color;
};
constexpr NamedColor kNamedColors[] = {
    {"white", {255, 255, 255}}, {"black", {0, 0, 0}},      {"red", {255, 0, 0}},
    {"green", {0, 255, 0}},     {"blue", {0, 0, 255}},     {"yellow", {255, 255, 0}},
    {"magenta", {255, 0, 255}}, {"cyan", {0, 255, 255}},   {"aqua", {0, 191, 191}},
    {"grey", {191, 191, 191}},  {"gray", {191, 191, 191}}, {"orange", {255, 127, 0}},
    {"brown", {191, 127, 63}},  {"purple", {127, 0, 255}}, {"violet", {127, 0, 255}},
    {"indigo", {0, 127, 255}}};

bool isSeparator(char c) {
  return text::isBlank(c) || c == ',' || c == ':';
}

std::string_view trimmed(std::string_view t) {
  while (!t.empty() && text::isBlank(t.front())) t.remove_prefix(1);
  while (!t.empty() && text::isBlank(t.back())) t.remove_suffix(1);
  return t;
}

/// A whole token as a number; infinities as "inf" and "-inf".
std::optional<double> numberOf(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || end != token.data() + token.size() || std::isnan(value)) return std::nullopt;
  return value;
}

/// "12,5 255 0 0": the comma may mark decimals, and the rest would be shifted by one.
bool hasDecimalComma(std::string_view line) {
  const std::size_t comma = line.find_first_not_of("+-0123456789");
  if (comma == line.npos || line[comma] != ',') return false;
  const std::size_t end = line.find_first_not_of("0123456789", comma + 1);
  return end != line.npos && end > comma + 1 && text::isBlank(line[end]);
}

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// In QGIS's files a comma ends a word, elsewhere any separator; empty at the end of the line.
  std::string_view next() {
    while (!rest_.empty() && isSeparator(rest_.front())) rest_.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest_.size() && !isSeparator(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  std::string_view peek() const { return Words(*this).next(); }
  /// What is left, behind one separator.
  std::string_view rest() const {
    std::string_view left = rest_;
    while (!left.empty() && text::isBlank(left.front())) left.remove_prefix(1);
    if (!left.empty() && isSeparator(left.front())) left.remove_prefix(1);
    return trimmed(left);
  }

 private:
  std::string_view rest_;
};

class RampParser {
 public:
  explicit RampParser(std::string source) { file_.source = std::move(source); }

  Result<RampFile> parse(std::string_view text) {
    if (const auto first = text.find_first_not_of(" \t\r\n"); first != text.npos && text[first] == '<')
      return failure(ErrorCode::unsupported,
                     "is XML, perhaps a style of QGIS (.qml) or an SLD, which is not read; QGIS exports the "
                     "colour map of a layer as a text",
                     file_.source);
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      ARETE_CHECK(take(trimmed(text.substr(0, end))));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (file_.lines.size() > kMostStops)
        return failure(ErrorCode::corrupt, fmt::format("has more than {} colours", kMostStops), file_.source);
    }
    if (file_.lines.empty())
      return failure(ErrorCode::corrupt, "has no colour: no line states a value and its colour",
                     file_.source);
    return std::move(file_);
  }

 private:
  tl::unexpected<Error> wrong(const std::string& what) const {
    return failure(ErrorCode::corrupt, fmt::format("line {} {}", line_, what), file_.source);
  }

  Status take(std::string_view line) {
    if (line.empty()) return {};
    if (line.starts_with('#') || line.starts_with("//")) {
      if (line.find("QGIS Generated Color Map") != line.npos) isOfQgis_ = true;
      if (line.find("COLOR_MODEL") != line.npos) return gmt();
      return {};
    }
    if (line.find('\0') != line.npos) return wrong("holds bytes that are no text");
    if (text::lowered(line.substr(0, 14)) == "interpolation:") return mode(trimmed(line.substr(14)));
    Words words(line);
    const std::string key = text::lowered(words.next());
    if ((key == "end" || key == "exit") && words.peek().empty()) return {};  // closes rules of GRASS
    RampFile::Line read;
    read.line = line_;
    const bool isNodata = key == "nv" || key == "nodata" || key == "nan", isDefault = key == "default";
    if (!isNodata && !isDefault) {
      read.isPercent = key.ends_with('%');
      const auto value = numberOf(std::string_view(key).substr(0, key.size() - (read.isPercent ? 1 : 0)));
      if (!value)
        return wrong(fmt::format("begins with {}, not with a value, a per cent, nv or default",
                                 text::quotedToken(key)));
      if (hasDecimalComma(line))
        return wrong(
            "has a comma within its first number and blanks between the others; a point marks decimals");
      read.value = *value;
      if (read.isPercent && !(read.value >= 0 && read.value <= 100))
        return wrong(fmt::format("has {}, which is not between 0 and 100 per cent", text::quotedToken(key)));
    }
    ARETE_TRY(read.color, colorOf(words));
    ARETE_TRY(read.label, labelOf(words));
    std::optional<Rgba>& special = isNodata ? file_.nodata : file_.outside;
    if (!isNodata && !isDefault) {
      file_.lines.push_back(std::move(read));
    } else if (special && *special != read.color) {
      return wrong(fmt::format("states another colour for {}", key));
    } else {
      special = read.color;
    }
    return {};
  }

  tl::unexpected<Error> gmt() const {
    return failure(ErrorCode::unsupported,
                   "is a palette of GMT (.cpt), whose lines state two values each; that format is not read",
                   file_.source);
  }

  Status mode(std::string_view name) {
    const std::string lowered = text::lowered(name);
    if (lowered == "interpolated" || lowered == "linear")
      file_.between = ColorsBetween::linear;
    else if (lowered == "discrete")
      file_.between = ColorsBetween::discrete;
    else if (lowered == "exact")
      file_.between = ColorsBetween::exact;
    else
      return wrong(fmt::format("states the interpolation {}, which is not INTERPOLATED, DISCRETE or EXACT",
                               text::quotedToken(name)));
    isOfQgis_ = true;
    return {};
  }

  Result<Rgba> colorOf(Words& words) const {
    const std::string first = text::lowered(words.next());
    if (first.empty()) return wrong("has no colour");
    if (first.starts_with('#')) return hexColor(first);
    if (!numberOf(first)) {
      const auto* named = std::ranges::find(kNamedColors, first, &NamedColor::name);
      if (named == std::end(kNamedColors))
        return wrong(fmt::format("has the colour {}, which has no meaning here", text::quotedToken(first)));
      return Rgba(named->color);
    }
    std::array<std::uint8_t, 4> parts{0, 0, 0, 255};
    std::string word = first;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == 3 && !numberOf(words.peek())) break;  // opacity may be left out
      if (i > 0) word = words.next();
      const auto part = numberOf(word);
      if (!part)
        return wrong(word.empty() ? fmt::format("has {} of the three parts of a colour", i)
                                  : fmt::format("has {} as part of a colour", text::quotedToken(word)));
      if (!(*part >= 0 && *part <= 255 && *part == std::floor(*part)))
        return wrong(fmt::format("has {} as part of a colour, which is not a whole number from 0 to 255",
                                 text::quotedToken(word)));
      parts[i] = static_cast<std::uint8_t>(std::lround(*part));
    }
    return Rgba{parts[0], parts[1], parts[2], parts[3]};
  }

  Result<Rgba> hexColor(std::string_view text) const {
    std::uint32_t bits = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), bits, 16);
    const std::size_t digits = text.size() - 1;
    if (error != std::errc{} || end != text.data() + text.size() || (digits != 6 && digits != 8))
      return wrong(
          fmt::format("has the colour {}, which is not # and 6 or 8 digits", text::quotedToken(text)));
    if (digits == 6) bits = bits << 8 | 0xFF;
    return Rgba{std::uint8_t(bits >> 24), std::uint8_t(bits >> 16), std::uint8_t(bits >> 8),
                std::uint8_t(bits)};
  }

  Result<std::string> labelOf(const Words& words) const {
    const std::string_view label = words.rest();
    if (label.empty() || isOfQgis_) return std::string(label);
    if (label.starts_with('#')) return std::string();
    if (!numberOf(words.peek())) return std::string(label);
    Words more(words);
    std::size_t numbers = 0;
    while (numberOf(more.peek())) more.next(), ++numbers;
    if (numbers == 3) return gmt();
    return wrong("has more numbers than a value, red, green, blue and opacity");
  }

  RampFile file_;
  std::size_t line_ = 0;
  bool isOfQgis_ = false;
};

/// Adjacent colours that a person can hardly tell apart: all of them where values have classes; in a linear
/// map only across a twentieth of its extent, since a ramp of many colours has neighbours alike, and not
/// where a step begins or ends, which classes in a linear map have ("10 red", "10.001 green").
void warnOfLikeNeighbours(const ColorMap& map, Warnings& warnings) {
  const bool isLinear = map.between() == ColorsBetween::linear;
  const double leastDifference = isLinear ? 1 : 5, extent = map.high() - map.low();
  const auto& stops = map.stops();
  std::size_t alike = 0, first = 0;
  const auto isStep = [&](std::size_t i) {
    return i + 1 < stops.size() && stops[i + 1].value - stops[i].value <= extent / 1000;
  };
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const ColorStop &a = stops[i], &b = stops[i + 1];
    if (a.color.a == 0 || b.color.a == 0 || a.value == b.value) continue;
    if (isLinear && (!std::isfinite(a.value) || !std::isfinite(b.value) || b.value - a.value < extent / 20))
      continue;
    if (isLinear && (isStep(i + 1) || (i > 0 && isStep(i - 1)))) continue;
    if (colorDifference(a.color.opaque(), b.color.opaque()) >= leastDifference) continue;
    if (alike++ == 0) first = i;
  }
  if (alike == 0) return;
  warnings.push_back(
      {WarningCode::display,
       fmt::format("the colours of {:g} and {:g} can hardly be told apart{}", stops[first].value,
                   stops[first + 1].value,
                   alike == 1 ? "" : fmt::format(", and {} more pairs of neighbours", alike - 1))});
}

}  // namespace

bool RampFile::usesPercent() const {
  return std::ranges::any_of(lines, &Line::isPercent);
}

Result<ColorMap> RampFile::map(double low, double high, std::optional<ColorsBetween> stated,
                               Warnings& warnings) const {
  struct Placed {
    float value;
    const Line* line;
  };
  std::vector<Placed> placed;
  for (const Line& line : lines)
    placed.push_back({float(line.isPercent ? low + (high - low) * line.value / 100 : line.value), &line});
  std::ranges::stable_sort(placed, {}, &Placed::value);
  const ColorsBetween between = stated.value_or(this->between);
  std::vector<ColorStop> stops;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const auto& [value, line] = placed[i];
    if (i > 0 && placed[i - 1].value == value) {
      const Line& before = *placed[i - 1].line;
      if (before.color == line->color) continue;
      const auto named =
          fmt::format("lines {} and {} state different colours for {:g}", before.line, line->line, value);
      if (between != ColorsBetween::linear) return failure(ErrorCode::invalidData, named, source);
      warnings.push_back({WarningCode::display,
                          fmt::format("{}: the first one holds below it, the second one from it on", named)});
    }
    stops.push_back({double(value), line->color, line->label});
  }
  ColorMapOptions options;
  options.between = between;
  options.outside = outside;
  if (nodata) options.nodata = *nodata;
  ARETE_TRY(ColorMap map, ColorMap::make(std::move(stops), options));
  warnOfLikeNeighbours(map, warnings);
  return map;
}

Result<RampFile> parseRamp(std::string_view text, const std::string& source) try {
  return RampParser(source).parse(text);
} catch (...) {
  return caughtFailure();
}

Result<RampFile> readRampFile(const std::string& path) {
  ARETE_TRY(const FileBytes bytes, FileBytes::readText(path));
  return parseRamp(bytes.view(), path);
}

}  // namespace arete
