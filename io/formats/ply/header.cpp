// SPDX-License-Identifier: GPL-3.0-or-later
//
// Line by line, word by word: the first word of a line is its keyword. Unknown keywords are errors, since a
// reader that skips them misses data.
#include "io/formats/ply/header.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "io/files/text_scan.h"

namespace arete {

namespace {

std::optional<PlyType> typeNamed(std::string_view name) {
  struct Name {
    std::string_view name;
    PlyType type;
  };
  static constexpr std::array kNames = {
      Name{"char", PlyType::int8},      Name{"int8", PlyType::int8},       Name{"uchar", PlyType::uint8},
      Name{"uint8", PlyType::uint8},    Name{"short", PlyType::int16},     Name{"int16", PlyType::int16},
      Name{"ushort", PlyType::uint16},  Name{"uint16", PlyType::uint16},   Name{"int", PlyType::int32},
      Name{"int32", PlyType::int32},    Name{"uint", PlyType::uint32},     Name{"uint32", PlyType::uint32},
      Name{"float", PlyType::float32},  Name{"float32", PlyType::float32}, Name{"double", PlyType::float64},
      Name{"float64", PlyType::float64}};
  for (const Name& candidate : kNames)
    if (candidate.name == name) return candidate.type;
  return std::nullopt;
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while (at < line.size()) {
    while (at < line.size() && text::isBlank(line[at])) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !text::isBlank(line[at])) ++at;
    if (at > begin) words.push_back(line.substr(begin, at - begin));
  }
  return words;
}

std::optional<std::uint64_t> countFrom(std::string_view word) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return count;
}

/// Adds the property to the last element. Returns what is wrong with the line; empty if nothing is.
std::string readProperty(const std::vector<std::string_view>& words, std::vector<PlyElement>& elements) {
  if (elements.empty()) return "a property before any element";
  PlyProperty property;
  property.isList = words.size() == 5 && words[1] == "list";
  if (!property.isList && words.size() != 3)
    return "a property that is neither \"type name\" nor \"list type type name\"";
  const auto type = typeNamed(words[property.isList ? 3 : 1]);
  if (!type) return fmt::format("an unknown type {}", text::quotedToken(words[property.isList ? 3 : 1]));
  property.type = *type;
  if (property.isList) {
    const auto countType = typeNamed(words[2]);
    if (!countType || *countType == PlyType::float32 || *countType == PlyType::float64)
      return fmt::format("{}, which cannot be the type of a list's length", text::quotedToken(words[2]));
    property.countType = *countType;
  }
  property.name = words.back();
  elements.back().properties.push_back(std::move(property));
  return {};
}

}  // namespace

Result<PlyHeader> parsePlyHeader(std::string_view file, const std::string& path) {
  if (!file.starts_with("ply") || file.size() < 4 || !text::isSpace(file[3]))
    return failure(ErrorCode::corrupt, "is not a PLY file: it does not begin with a line \"ply\"", path);
  const std::size_t firstEnd = file.find_first_of("\r\n");
  if (firstEnd == std::string_view::npos)
    return failure(ErrorCode::corrupt, "the header ends in its first line", path);
  // The end of the first line decides how all lines of the header end.
  const std::string_view lineEnd =
      file.substr(firstEnd).starts_with("\r\n") ? "\r\n" : file.substr(firstEnd, 1);

  PlyHeader header;
  bool hasFormat = false;
  std::size_t at = firstEnd + lineEnd.size();
  for (std::size_t lineNumber = 2;; ++lineNumber) {
    const std::size_t end = file.find(lineEnd, at);
    if (end == std::string_view::npos)
      return failure(ErrorCode::corrupt, fmt::format("the header has no end_header (line {})", lineNumber),
                     path);
    const std::string_view line = file.substr(at, end - at);
    at = end + lineEnd.size();
    const auto broken = [&](std::string_view what) {
      return failure(ErrorCode::corrupt, fmt::format("line {} of the header has {}", lineNumber, what), path);
    };

    const std::vector<std::string_view> words = wordsOf(line);
    if (words.empty() || words[0] == "obj_info") continue;
    if (words[0] == "comment") {
      // One blank separates the text; further ones belong to it.
      const auto offset = static_cast<std::size_t>(words[0].data() + words[0].size() - line.data());
      std::string_view text = line.substr(offset);
      if (!text.empty()) text.remove_prefix(1);
      header.comments.emplace_back(text);
    } else if (words[0] == "format") {
      if (words.size() != 3 || hasFormat) return broken("an invalid or repeated format");
      if (words[2] != "1.0")
        return failure(ErrorCode::unsupported,
                       fmt::format("PLY version {} is not known", text::quotedToken(words[2])), path);
      hasFormat = true;
      if (words[1] == "ascii")
        header.format = PlyFormat::ascii;
      else if (words[1] == "binary_little_endian")
        header.format = PlyFormat::littleEndian;
      else if (words[1] == "binary_big_endian")
        header.format = PlyFormat::bigEndian;
      else
        return broken(fmt::format("an unknown format {}", text::quotedToken(words[1])));
    } else if (words[0] == "element") {
      const auto count = words.size() == 3 ? countFrom(words[2]) : std::nullopt;
      if (!count) return broken("an element without a name and a count");
      header.elements.push_back({std::string(words[1]), *count, {}});
    } else if (words[0] == "property") {
      if (const std::string what = readProperty(words, header.elements); !what.empty()) return broken(what);
    } else if (words[0] == "end_header") {
      if (!hasFormat) return broken("no format line before it");
      header.dataBegin = at;
      return header;
    } else {
      return broken(fmt::format("an unknown word {}", text::quotedToken(words[0])));
    }
  }
}

}  // namespace arete
