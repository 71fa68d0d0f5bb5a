// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/notes.h"

#include <fmt/format.h>

#include <charconv>

#include "io/files/text_scan.h"

namespace arete {

namespace {

constexpr std::string_view kAttribute = "attribute", kTextureFile = "texturefile";

/// Takes the first word off a text, and the one blank behind it.
std::string_view takeWord(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && !text::isBlank(text[end])) ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + 1));
  return word;
}

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && text::isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && text::isBlank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<PlyNote> plyNoteOf(std::string_view comment) {
  if (takeWord(comment) != kAttribute) return std::nullopt;
  PlyNote note;
  note.element = takeWord(comment);
  note.property = takeWord(comment);
  std::string_view number = takeWord(comment);
  note.name = comment;
  if (number.ends_with('n')) {
    note.isNormalized = true;
    number.remove_suffix(1);
  }
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), note.components);
  if (error != std::errc{} || end != number.data() + number.size() || note.components == 0 ||
      note.property.empty() || note.name.empty())
    return std::nullopt;
  return note;
}

std::string plyComment(const PlyNote& note) {
  return fmt::format("comment {} {} {} {}{} {}\n", kAttribute, note.element, note.property, note.components,
                     note.isNormalized ? "n" : "", text::onOneLine(note.name));
}

std::optional<std::string> plyTextureFile(std::string_view comment) {
  comment = withoutBlanks(comment);
  if (text::lowered(takeWord(comment)) != kTextureFile) return std::nullopt;
  comment = withoutBlanks(comment);
  if (comment.empty()) return std::nullopt;
  return std::string(comment);
}

std::string plyMaterialName(std::string_view picture) {
  const std::size_t folder = picture.find_last_of("/\\");
  if (folder != std::string_view::npos) picture.remove_prefix(folder + 1);
  const std::size_t dot = picture.find_last_of('.');
  return std::string(dot == std::string_view::npos || dot == 0 ? picture : picture.substr(0, dot));
}

}  // namespace arete
