// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/layer_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>

namespace arete {
namespace {

constexpr double kWidestLine = 50;

/// Colours of layers that state none: apart from each other, also for the colour-blind, and from most ground.
constexpr std::array<Rgb, 6> kColors = {
    {{214, 40, 40}, {0, 90, 181}, {240, 190, 0}, {120, 40, 150}, {230, 97, 0}, {20, 20, 20}}};

tl::unexpected<Error> wrong(std::string message, const std::string& text) {
  return failure(ErrorCode::usage, std::move(message), text);
}

/// Where ",word=" begins in a text at or behind `from`, and where its value does.
struct Key {
  std::size_t begin, value;
};
std::optional<Key> nextKey(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find(',', from); at != text.npos; at = text.find(',', at + 1)) {
    std::size_t end = at + 1;
    while (end < text.size() && std::isalpha(static_cast<unsigned char>(text[end])) != 0) ++end;
    if (end > at + 1 && end < text.size() && text[end] == '=') return Key{at, end + 1};
  }
  return std::nullopt;
}

Result<Rgb> readHexColor(const std::string& text) {
  std::string digits = text.starts_with('#') ? text.substr(1) : text;
  if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  const bool isHex = digits.size() == 6 &&
                     std::ranges::all_of(digits, [](unsigned char c) { return std::isxdigit(c) != 0; });
  if (!isHex) return wrong("must be a colour as in #d62828", "color=" + text);
  const auto channel = [&](std::size_t i) {
    unsigned value = 0;
    std::from_chars(digits.data() + i, digits.data() + i + 2, value, 16);
    return std::uint8_t(value);
  };
  return Rgb{channel(0), channel(2), channel(4)};
}

}  // namespace

Result<FileWithKeys> readFileWithKeys(const std::string& text, const std::vector<std::string_view>& keys) {
  FileWithKeys read;
  std::error_code ignored;
  std::optional<Key> key = nextKey(text, 0);
  if (!key || std::filesystem::exists(text, ignored)) {
    read.file = text;
    return read;
  }
  read.file = text.substr(0, key->begin);
  if (read.file.empty()) return wrong("needs the name of a file first", text);
  while (key) {
    const std::string name = text.substr(key->begin + 1, key->value - key->begin - 2);
    const std::optional<Key> next = nextKey(text, key->value);
    const std::string value = text.substr(key->value, next ? next->begin - key->value : std::string::npos);
    if (std::ranges::find(keys, name) == keys.end())
      return wrong(fmt::format("'{}' is unknown; known are {}", name, fmt::join(keys, ", ")), text);
    if (value.empty()) return wrong(fmt::format("{}= needs a value", name), text);
    if (!read.values.emplace(name, value).second)
      return wrong(fmt::format("{}= is stated twice", name), text);
    key = next;
  }
  return read;
}

std::optional<double> numberIn(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<double> readOpacity(const std::string& text, std::string_view key) {
  const auto value = numberIn(text);
  if (!value || !(*value >= 0 && *value <= 1))
    return wrong("must be a number of 0 to 1", fmt::format("{}={}", key, text));
  return *value;
}

namespace {

Result<LayerArgument> readLayerArgument(const std::string& text, std::size_t number) {
  ARETE_TRY(const FileWithKeys stated,
            readFileWithKeys(text, {"name", "label", "where", "crs", "color", "width", "opacity", "fill",
                                    "height", "title"}));
  LayerArgument layer;
  layer.file = stated.file;
  layer.style.color = kColors[number % kColors.size()];
  const auto value = [&](std::string_view key) {
    const auto found = stated.values.find(key);
    return found == stated.values.end() ? std::string() : found->second;
  };
  layer.read.layer = value("name");
  layer.read.label = value("label");
  layer.read.where = value("where");
  layer.read.crs = value("crs");
  layer.title = value("title");
  if (const std::string color = value("color"); !color.empty()) {
    ARETE_TRY(layer.style.color, readHexColor(color));
  }
  if (const std::string width = value("width"); !width.empty()) {
    const auto pixels = numberIn(width);
    if (!pixels || !(*pixels > 0 && *pixels <= kWidestLine))
      return wrong(fmt::format("must be a number of pixels above 0, at most {}", kWidestLine),
                   "width=" + width);
    layer.style.width = *pixels;
  }
  if (const std::string opacity = value("opacity"); !opacity.empty()) {
    ARETE_TRY(layer.style.opacity, readOpacity(opacity));
  }
  if (const std::string fill = value("fill"); !fill.empty()) {
    ARETE_TRY(layer.fill, readOpacity(fill, "fill"));
  }
  if (const std::string height = value("height"); !height.empty()) {
    if (height != "ground" && height != "own")
      return wrong("must be ground, or own for places that stand at the heights that they state",
                   "height=" + height);
    layer.ground.floats = height == "own";
  }
  return layer;
}

}  // namespace

Result<LayerArgument> LayerArgument::of(const std::string& text, std::size_t number) {
  auto layer = readLayerArgument(text, number);
  if (!layer && layer.error().culprit != text)
    layer.error().culprit = fmt::format("{} of {}", layer.error().culprit, text);
  return layer;
}

}  // namespace arete
