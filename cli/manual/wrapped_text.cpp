// SPDX-License-Identifier: GPL-3.0-or-later
//
// A byte that continues a UTF-8 character fills no column.
#include "cli/manual/wrapped_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <vector>

namespace arete {
namespace {

constexpr std::size_t kUsualColumns = 80, kFewestColumns = 40, kMostColumns = 120;

std::size_t columnsOf(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(" \n");
    if (begin == text.npos) return words;
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

/// As many bytes of a word as fit: to the last punctuation, if that is in the second half of what fits.
/// Precondition: it fills more columns.
std::size_t pieceOf(std::string_view word, std::size_t columns) {
  std::size_t room = 0;
  for (std::size_t filled = 0; room < word.size(); ++room) {
    const bool begins = columnsOf(word.substr(room, 1)) == 1;
    if (begins && filled == columns) break;
    filled += begins ? 1 : 0;
  }
  const std::size_t at = word.substr(0, room).find_last_of(",|[]=/:;.");
  return at != word.npos && at + 1 > room / 2 ? at + 1 : room;
}

std::size_t fromEnvironment() {
  const char* const text = std::getenv("COLUMNS");
  if (text == nullptr) return 0;
  const std::string_view stated = text;
  std::size_t columns = 0;
  const auto [end, error] = std::from_chars(stated.data(), stated.data() + stated.size(), columns);
  return error == std::errc{} && end == stated.data() + stated.size() ? columns : 0;
}

std::size_t fromTerminal() {
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct winsize size {};
    if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  }
  return 0;
}

}  // namespace

std::size_t terminalColumns() {
  std::size_t columns = fromEnvironment();
  if (columns == 0) columns = fromTerminal();
  if (columns == 0) columns = kUsualColumns;
  return std::clamp(columns, kFewestColumns, kMostColumns);
}

std::string wrapped(std::string_view text, std::size_t columns, std::size_t first, std::size_t indent) {
  std::string lines;
  std::size_t filled = first;
  bool isBeginning = true;
  const auto nextLine = [&] {
    lines += '\n';
    lines.append(indent, ' ');
    filled = indent;
    isBeginning = true;
  };
  for (std::string_view word : wordsOf(text)) {
    const std::size_t needed = columnsOf(word) + (isBeginning ? 0 : 1);
    if (filled + needed > columns && !(isBeginning && filled <= indent)) nextLine();
    if (!isBeginning) {
      lines += ' ';
      ++filled;
    }
    while (columnsOf(word) > columns - std::min(filled, columns - 1)) {
      const std::size_t piece = pieceOf(word, columns - std::min(filled, columns - 1));
      lines += word.substr(0, piece);
      word.remove_prefix(piece);
      nextLine();
    }
    lines += word;
    filled += columnsOf(word);
    isBeginning = false;
  }
  return lines + "\n";
}

std::string wrappedCommand(std::string_view line, std::size_t columns) {
  if (columnsOf(line) <= columns) return std::string(line) + "\n";
  const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("   ", indent);
  const std::string_view command = line.substr(indent, gap == line.npos ? gap : gap - indent);
  // Less of the gap may be enough.
  if (gap != line.npos) {
    const std::string closer =
        std::string(line.substr(0, gap)) + "   " + std::string(line.substr(line.find_first_not_of(' ', gap)));
    if (columnsOf(closer) <= columns) return closer + "\n";
  }
  std::string lines(indent, ' ');
  std::size_t filled = indent;
  bool isBeginning = true;
  const std::vector<std::string_view> words = wordsOf(command);
  for (std::size_t i = 0; i < words.size(); ++i) {
    // An option stays with its value, if both fit into a line.
    const bool hasValue = words[i].starts_with('-') && i + 1 < words.size() && !words[i + 1].starts_with('-');
    const auto room = [&](std::size_t last) { return last + 1 < words.size() ? columns - 2 : columns; };
    const std::size_t own = columnsOf(words[i]), both = hasValue ? own + 1 + columnsOf(words[i + 1]) : own;
    const bool keepsValue = indent + 4 + both <= room(i + 1);
    if (!isBeginning && filled + 1 + (keepsValue ? both : own) > room(keepsValue && hasValue ? i + 1 : i)) {
      lines += " \\\n";
      lines.append(indent + 4, ' ');
      filled = indent + 4;
      isBeginning = true;
    }
    if (!isBeginning) lines += ' ';
    lines += words[i];
    filled += own + (isBeginning ? 0 : 1);
    isBeginning = false;
  }
  lines += '\n';
  if (gap == line.npos) return lines;
  lines.append(indent + 4, ' ');
  return lines + "# " + wrapped(line.substr(gap), columns, indent + 6, indent + 6);
}

}  // namespace arete
