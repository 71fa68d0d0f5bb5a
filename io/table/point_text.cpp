// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file is read in chunks and split into records where it lies; the unfinished last record of a chunk
// moves to the front of the next. A record is a line, or several if a quoted text contains line breaks (RFC
// 4180). The first record with content determines the separator (the first of semicolon, comma, tab that
// occurs in it, else spaces) and the columns. Numbers go through std::from_chars: exact, and independent of
// the locale.
//
// GDAL's CSV driver is not used: it reads points at 0.2 of this speed (2 million rows with a header,
// processor time), has no comments, and numbers features instead of lines. The rules for columns are shared:
// column_rules.h.
#include "io/table/point_text.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "io/file/number_text.h"
#include "io/file/text_scan.h"
#include "io/gdal/support.h"
#include "io/table/column_rules.h"

namespace arete {
namespace {

constexpr std::size_t kMostChunkBytes = std::size_t(1) << 22;
constexpr std::size_t kLongestRecord = std::size_t(1) << 20;
constexpr std::size_t kQuotedCharacters = 60;
constexpr std::size_t kColumnsNamed = 20, kCharactersOfColumn = 30;
constexpr std::array kSeparators = {';', ',', '\t'};
constexpr char kSpaces = ' ';

struct FileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return trimmed(text);
}

/// The start of the comment of a record, or npos. In quotes '#' is text.
std::size_t findComment(std::string_view line) {
  std::size_t at = line.find('#');
  const auto isQuoted = [&] { return std::count(line.begin(), line.begin() + std::ptrdiff_t(at), '"') % 2; };
  while (at != std::string_view::npos && isQuoted()) at = line.find('#', at + 1);
  return at;
}

std::string quoted(std::string_view text) {
  return fmt::format("'{}'", text::printable(text, kQuotedCharacters));
}

char separatorOf(std::string_view line) {
  for (const char separator : kSeparators)
    if (line.find(separator) != std::string_view::npos) return separator;
  return kSpaces;
}

/// Scans a record for the line breaks that its quoted texts contain. A quote opens a text only at the start
/// of a field; elsewhere it is a character.
class QuoteScanner {
 public:
  explicit QuoteScanner(char separator) : separator_(separator) {}

  /// The end of the record at the start of `text`: the first line break outside quotes, or npos.
  std::size_t recordEnd(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (inQuotes_) {
        if (c != '"') continue;
        if (i + 1 < text.size() && text[i + 1] == '"') {
          ++i;
        } else {
          inQuotes_ = false;
          isClosed_ = true;
        }
      } else if (c == '\n' || c == '#') {
        return c == '\n' ? i : text.find('\n', i);
      } else if (c == separator_) {
        atFieldStart_ = true;
        isClosed_ = false;
      } else if (c == '"' && atFieldStart_) {
        inQuotes_ = true;
        atFieldStart_ = false;
      } else if (!isBlank(c)) {
        atFieldStart_ = false;
        hasTextBehindQuotes_ = hasTextBehindQuotes_ || isClosed_;
      }
    }
    return std::string_view::npos;
  }
  bool isInQuotes() const { return inQuotes_; }
  /// A quoted text ends before the end of its field, so its quotes may not be meant as such.
  bool hasTextBehindQuotes() const { return hasTextBehindQuotes_; }

 private:
  char separator_;
  bool inQuotes_ = false, atFieldStart_ = true, isClosed_ = false, hasTextBehindQuotes_ = false;
};

/// Takes the next field off the front of `rest`. False if none is left.
bool nextField(std::string_view& rest, char separator, std::string_view& field) {
  if (separator == kSpaces) {
    rest = trimmed(rest);
    if (rest.empty()) return false;
    std::size_t end = 0;
    while (end < rest.size() && !isBlank(rest[end])) ++end;
    field = unquoted(rest.substr(0, end));
    rest.remove_prefix(end);
    return true;
  }
  if (rest.data() == nullptr) return false;
  std::size_t end = 0;
  bool inQuotes = false;
  for (; end < rest.size() && (inQuotes || rest[end] != separator); ++end)
    if (rest[end] == '"') inQuotes = !inQuotes;
  field = unquoted(rest.substr(0, end));
  rest = end < rest.size() ? rest.substr(end + 1) : std::string_view();
  return true;
}

std::vector<std::string_view> fieldsOf(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::string_view field; nextField(line, separator, field);) fields.push_back(field);
  return fields;
}

/// The names of the first columns, for a message.
std::string columnNames(std::span<const std::string_view> fields) {
  std::string names;
  for (std::size_t i = 0; i < std::min(fields.size(), kColumnsNamed); ++i)
    names += (i > 0 ? ", " : "") + text::printable(fields[i], kCharactersOfColumn);
  if (fields.size() > kColumnsNamed) names += fmt::format(" and {} more", fields.size() - kColumnsNamed);
  return names;
}

/// The fields of a record that are x, y, z.
struct Columns {
  std::array<std::size_t, 3> at = {0, 1, 2};
};

std::optional<std::size_t> findField(std::span<const std::string_view> fields,
                                     std::span<const std::string_view> names) {
  return findColumn(
      fields.size(), [&](std::size_t i) { return fields[i]; }, names);
}

Result<Columns> columnsByName(std::span<const std::string_view> fields, const std::string& zColumn,
                              PointTextColumns kind, std::vector<std::string>& warnings) {
  const auto x = findField(fields, ColumnNames::x()), y = findField(fields, ColumnNames::y());
  if (kind == PointTextColumns::plan && x && y) return Columns{{*x, *y, *y}};
  auto z = findField(fields, ColumnNames::z());
  if (!zColumn.empty()) {
    const auto named = std::find(fields.begin(), fields.end(), std::string_view(zColumn));
    const std::string lowered = text::lowered(zColumn);
    z = named != fields.end() ? std::optional(std::size_t(named - fields.begin()))
                              : findField(fields, std::array<std::string_view, 1>{lowered});
    if (!z)
      return failure(ErrorCode::usage,
                     fmt::format("has no column '{}'; its columns: {}", zColumn, columnNames(fields)));
  }
  if (x && y && z) return Columns{{*x, *y, *z}};
  if (!x && !y && (!z || zColumn.empty()) && !z && fields.size() >= 3) {
    warnings.push_back(fmt::format("no column is named x, y or z; the first three are taken: {}",
                                   columnNames(fields.first(3))));
    return Columns{};
  }
  return failure(ErrorCode::invalidData,
                 fmt::format("has no column for {} by any of the usual names{}; its columns: {}",
                             !x   ? "x"
                             : !y ? "y"
                                  : "the height",
                             x && y ? " (`zField` names one)" : "", columnNames(fields)));
}

class TextParser {
 public:
  TextParser(const std::string& path, const std::string& zColumn, PointTextColumns kind,
             std::vector<std::string>& warnings, PointAttributes* attributes)
      : path_(path), zColumn_(zColumn), kind_(kind), warnings_(warnings), attributes_(attributes) {
    if (kind == PointTextColumns::plan) columns_.at = {0, 1, 1};
  }

  /// The end of the record at the start of `text`: the '\n' behind it, or npos.
  std::size_t recordEnd(std::string_view text) const {
    const std::size_t lineEnd = text.find('\n');
    const std::string_view line = text.substr(0, lineEnd);
    if (line.find('"') == std::string_view::npos) return lineEnd;
    if (started_) return separator_ == kSpaces ? lineEnd : QuoteScanner(separator_).recordEnd(text);
    // The first record: its separator may come behind a line break in quotes.
    for (const char separator : kSeparators) {
      const std::size_t end = QuoteScanner(separator).recordEnd(text);
      if (text.substr(0, end).find(separator) != std::string_view::npos) return end;
    }
    return lineEnd;
  }

  Status addRecord(std::string_view line) {
    lineNumber_ = nextLine_;
    ++nextLine_;
    if (line.find('\n') != std::string_view::npos) {
      nextLine_ += std::uint64_t(std::count(line.begin(), line.end(), '\n'));
      if (Status ok = checkQuotes(line); !ok) return ok;
    }
    line = line.substr(0, findComment(line));
    if (trimmed(line).empty()) return {};
    if (!started_) {
      started_ = true;
      separator_ = separatorOf(line);
      const std::vector<std::string_view> fields = fieldsOf(line, separator_);
      if (std::none_of(fields.begin(), fields.end(),
                       [](std::string_view f) { return text::parseNumber(f).has_value(); })) {
        auto columns = columnsByName(fields, zColumn_, kind_, warnings_);
        if (!columns) return failure(columns.error().code, columns.error().message, path_);
        columns_ = *columns;
        nameAttributes(fields, true);
        return {};
      }
      nameAttributes(fields, false);
      if (!zColumn_.empty())
        return failure(ErrorCode::usage,
                       fmt::format("has no line of column names in which to find '{}'", zColumn_), path_);
    }
    return addPoint(line);
  }

  PointRows takeRows() {
    if (surplusFields_ > 0)
      warnings_.push_back(
          fmt::format("{} fields stand beyond the last column and are left out", surplusFields_));
    return std::move(rows_);
  }
  /// Of the next record, counted from 1.
  std::uint64_t nextLine() const { return nextLine_; }

 private:
  /// A stray quote must not join lines that are records of their own.
  Status checkQuotes(std::string_view record) const {
    QuoteScanner scanner(started_ ? separator_ : separatorOf(record));
    scanner.recordEnd(record);
    if (scanner.isInQuotes())
      return failure(ErrorCode::invalidData, "a quoted text begins here and does not end", where());
    if (scanner.hasTextBehindQuotes())
      return failure(ErrorCode::invalidData,
                     "a quoted text of several lines begins here and has more text behind its closing quote",
                     where());
    return {};
  }

  Status addPoint(std::string_view line) {
    const std::size_t last = *std::max_element(columns_.at.begin(), columns_.at.end());
    std::array<double, 3> values{};
    std::string_view rest = line, field;
    for (std::size_t i = 0; i <= last; ++i) {
      if (!nextField(rest, separator_, field))
        return failure(ErrorCode::invalidData,
                       fmt::format("{} holds {} of the {} fields needed", quoted(trimmed(line)), i, last + 1),
                       where());
      for (std::size_t k = 0; k < 3; ++k) {
        if (columns_.at[k] != i) continue;
        const auto value = text::parseNumber(field);
        if (!value)
          return failure(ErrorCode::invalidData, fmt::format("{} is not a number", quoted(field)), where());
        if (!std::isfinite(*value))
          return failure(ErrorCode::invalidData, fmt::format("{} is not a finite number", quoted(field)),
                         where());
        values[k] = *value;
      }
    }
    rows_.add(values[0], values[1], values[2], lineNumber_);
    if (attributes_) addAttributes(line);
    return {};
  }

  bool isAttribute(std::size_t field) const {
    return std::find(columns_.at.begin(), columns_.at.end(), field) == columns_.at.end();
  }

  void nameAttributes(std::span<const std::string_view> fields, bool areNames) {
    if (!attributes_) return;
    fieldCount_ = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!isAttribute(i)) continue;
      std::string name(areNames ? fields[i] : std::string_view());
      if (name.empty()) name = fmt::format("field_{}", i + 1);
      attributes_->columns.push_back({std::move(name)});
    }
  }

  void addAttributes(std::string_view line) {
    std::string_view rest = line, field;
    for (std::size_t i = 0; i < fieldCount_; ++i) {
      if (!nextField(rest, separator_, field)) field = {};
      if (isAttribute(i)) attributes_->add(withSingleQuotes(field));
    }
    while (nextField(rest, separator_, field)) surplusFields_ += !field.empty();
  }

  /// A quoted text has its own quotes doubled.
  static std::string withSingleQuotes(std::string_view field) {
    std::string text;
    for (std::size_t i = 0; i < field.size(); ++i) {
      text += field[i];
      if (field[i] == '"' && i + 1 < field.size() && field[i + 1] == '"') ++i;
    }
    return text;
  }

  std::string where() const { return fmt::format("{}:{}", path_, lineNumber_); }

  const std::string& path_;
  const std::string& zColumn_;
  PointTextColumns kind_;
  std::vector<std::string>& warnings_;
  PointAttributes* attributes_;
  std::size_t fieldCount_ = 0, surplusFields_ = 0;
  PointRows rows_;
  Columns columns_;
  char separator_ = kSpaces;
  bool started_ = false;
  std::uint64_t lineNumber_ = 0, nextLine_ = 1;  // first line of this record, and of the next
};

}  // namespace

bool looksLikePointText(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  if (extension == "csv" || extension == "tsv" || extension == "txt" || extension == "xyz") return true;
  const std::unique_ptr<VSILFILE, FileCloser> file(VSIFOpenL(path.c_str(), "rb"));
  if (!file) return false;
  std::array<char, 4096> head;
  std::string_view text(head.data(), VSIFReadL(head.data(), 1, head.size(), file.get()));
  if (text.find('\0') != std::string_view::npos) return false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> fields = fieldsOf(line, separatorOf(line));
    return fields.size() >= 3 && std::all_of(fields.begin(), fields.begin() + 3, [](std::string_view f) {
             return text::parseNumber(f).has_value();
           });
  }
  return false;
}

Result<PointRows> readPointText(const std::string& path, const std::string& zColumn,
                                std::vector<std::string>& warnings, const RunContext& context,
                                PointTextColumns columns, PointAttributes* attributes) {
  registerGdal();
  GdalErrors errors;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const std::unique_ptr<VSILFILE, FileCloser> file(VSIFOpenL(path.c_str(), "rb"));
  if (!file) return failure(ErrorCode::notFound, "there is no such file", path);
  VSIStatBufL status;
  const double size = VSIStatL(path.c_str(), &status) == 0 ? double(status.st_size) : 0;

  // One more than a small file has, so that its end is seen at once.
  const std::size_t chunkBytes = size > 0 && size < kMostChunkBytes ? std::size_t(size) + 1 : kMostChunkBytes;
  TextParser parser(path, zColumn, columns, warnings, attributes);
  std::string buffer;
  double bytesRead = 0;
  for (bool first = true, more = true; more; first = false) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped", path);
    context.report("reading", size > 0 ? std::min(1.0, bytesRead / size) : 0);
    const std::size_t kept = buffer.size();
    buffer.resize(kept + chunkBytes);
    const std::size_t got = VSIFReadL(buffer.data() + kept, 1, chunkBytes, file.get());
    buffer.resize(kept + got);
    bytesRead += double(got);
    more = got == chunkBytes;
    std::string_view text = buffer;
    if (first && text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    while (!text.empty()) {
      std::size_t end = parser.recordEnd(text);
      if (end == std::string_view::npos) {
        if (more) break;
        end = text.size();
      }
      if (Status added = parser.addRecord(text.substr(0, end)); !added) return tl::unexpected(added.error());
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (text.size() > kLongestRecord)
      return failure(
          ErrorCode::invalidData,
          fmt::format("line {}, or a quoted text that begins there, is longer than {} characters: not a "
                      "text of points",
                      parser.nextLine(), kLongestRecord),
          path);
    buffer.erase(0, buffer.size() - text.size());
  }
  context.report("reading", 1);
  return parser.takeRows();
}

}  // namespace arete
