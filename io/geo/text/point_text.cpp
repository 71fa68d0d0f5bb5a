// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file is read in chunks and split into records where it lies; the unfinished last record of a chunk
// moves to the front of the next. A record is a line, or several if a quoted text contains line breaks (RFC
// 4180). The first record with content determines the separator (separator.h) and the columns. Numbers go
// through std::from_chars: exact, and independent of the locale; what is no plain number is looked at more
// closely (cell_number.h).
//
// GDAL's CSV driver is not used: it reads points at 0.2 of this speed (2 million rows with a header,
// processor time), has no comments, and numbers features instead of lines. The rules for columns are shared:
// column_rules.h.
#include "io/geo/text/point_text.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/text/record_scanner.h"
#include "io/files/text/wkt_point.h"
#include "io/files/text_decoder.h"
#include "io/files/text_scan.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"
#include "io/geo/text/cell_number.h"
#include "io/geo/text/column_rules.h"
#include "io/geo/text/separator.h"

namespace arete {
namespace {

constexpr std::size_t kMostChunkBytes = std::size_t(1) << 22;
constexpr std::size_t kLongestRecord = std::size_t(1) << 20;
constexpr std::size_t kQuotedCharacters = 60;
constexpr std::size_t kLinesThatCount = 3;
constexpr std::size_t kColumnsNamed = 20, kCharactersOfColumn = 30;
constexpr std::array kSeparators = {';', ',', '\t', '|'};
/// What spreadsheets write before the first line to state the separator: "sep=;".
constexpr std::string_view kStatedSeparator = "sep=";

struct FileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

std::string quoted(std::string_view text) {
  return fmt::format("'{}'", text::printable(text, kQuotedCharacters));
}

/// The names of the first columns, for a message.
std::string columnNames(std::span<const std::string_view> fields) {
  std::string names;
  for (std::size_t i = 0; i < std::min(fields.size(), kColumnsNamed); ++i)
    names += (i > 0 ? ", " : "") + text::printable(fields[i], kCharactersOfColumn);
  if (fields.size() > kColumnsNamed) names += fmt::format(" and {} more", fields.size() - kColumnsNamed);
  return names;
}

constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();

/// The fields of a record that are x, y, z; or the one that is a point as text, and perhaps z.
struct Columns {
  std::array<std::size_t, 3> at = {0, 1, 2};
  std::size_t wkt = kNoColumn;
};

std::optional<std::size_t> findField(std::span<const std::string_view> fields,
                                     std::span<const std::string_view> names) {
  return findColumn(
      fields.size(), [&](std::size_t i) { return fields[i]; }, names);
}

Result<Columns> columnsByName(std::span<const std::string_view> fields, const std::string& zColumn,
                              PointTextColumns kind, Warnings& warnings) {
  const auto x = findField(fields, ColumnNames::x()), y = findField(fields, ColumnNames::y()),
             wkt = findField(fields, ColumnNames::wkt());
  const bool isPlan = kind != PointTextColumns::spatial;
  if (isPlan && x && y) return Columns{{*x, *y, *y}};
  if (isPlan && wkt) return Columns{{kNoColumn, kNoColumn, kNoColumn}, *wkt};
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
  if (wkt && !(x && y)) return Columns{{kNoColumn, kNoColumn, z.value_or(kNoColumn)}, *wkt};
  if (!x && !y && (!z || zColumn.empty()) && !z && fields.size() >= 3) {
    warnings.push_back(
        {WarningCode::choice, fmt::format("no column is named x, y or z; the first three are taken: {}",
                                          columnNames(fields.first(3)))});
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
  TextParser(const std::string& path, const std::string& zColumn, PointTextColumns kind, Warnings& warnings,
             PointAttributes* attributes)
      : path_(path), zColumn_(zColumn), kind_(kind), warnings_(warnings), attributes_(attributes) {
    if (isPlan()) columns_.at = {0, 1, 1};
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
      ARETE_CHECK(checkQuotes(line));
    }
    line = line.substr(0, findComment(line));
    if (trimmed(line).empty()) return {};
    if (started_) return addPoint(line);
    if (const std::string_view stated = trimmed(line);
        stated.size() == kStatedSeparator.size() + 1 && text::lowered(stated).starts_with(kStatedSeparator)) {
      statedSeparator_ = stated.back();
      return {};
    }
    if (isGap(line)) return {};
    started_ = true;
    separator_ = statedSeparator_.value_or(separatorOf(line));
    // A header of one name of text has no separator, and its texts have blanks.
    if (separator_ == kSpaces && isPointText(trimmed(line))) separator_ = ',';
    const std::vector<std::string_view> fields = fieldsOf(line, separator_);
    if (const auto point = std::ranges::find_if(fields, isWktPoint); point != fields.end()) {
      columns_ = {{kNoColumn, kNoColumn, kNoColumn}, std::size_t(point - fields.begin())};
      nameAttributes(fields, false);
      return addPoint(line);
    }
    if (std::ranges::none_of(fields, isNumber)) {
      auto columns = columnsByName(fields, zColumn_, kind_, warnings_);
      if (!columns) return failure(columns.error().code, columns.error().message, path_);
      columns_ = *columns;
      namedColumns_ = fields.size();
      if (columns_.wkt == kNoColumn) {
        rows_.xName = fields[columns_.at[0]];
        rows_.yName = fields[columns_.at[1]];
      }
      nameAttributes(fields, true);
      return {};
    }
    const std::size_t needed = isPlan() ? 2 : 3;
    if (startsWithLabel(fields, needed)) {
      for (std::size_t& column : columns_.at) ++column;
      warnings_.push_back(
          {WarningCode::choice,
           "has no line of column names; its first column is not a number and is taken for a label"});
    }
    mayCountLines_ = columns_.at[0] == 0 && fields.size() > needed &&
                     std::all_of(fields.begin(), fields.begin() + std::ptrdiff_t(needed) + 1, isNumber);
    nameAttributes(fields, false);
    if (!zColumn_.empty())
      return failure(ErrorCode::usage,
                     fmt::format("has no line of column names in which to find '{}'", zColumn_), path_);
    return addPoint(line);
  }

  PointRows takeRows() {
    if (withoutHeight_ > 0)
      warnings_.push_back(
          {WarningCode::omitted,
           withoutHeight_ == 1
               ? fmt::format("1 point has no height and is left out (on line {})", lineWithoutHeight_)
               : fmt::format("{} points have no height and are left out (the first is on line {})",
                             withoutHeight_, lineWithoutHeight_)});
    if (lineWithComma_ > 0) warnings_.push_back({WarningCode::choice, "its numbers have a decimal comma"});
    if (mayCountLines_ && rows_.positions.size() >= kLinesThatCount)
      warnings_.push_back({WarningCode::choice,
                           "has no line of column names, and its first column, which is taken for x, counts "
                           "the points: if it "
                           "is a "
                           "number of the point, put a line of column names before the first"});
    if (surplusFields_ > 0)
      warnings_.push_back({WarningCode::omitted,
                           counted(surplusFields_, "field stands beyond the last column and is left out",
                                   "fields stand beyond the last column and are left out")});
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

  bool isPlan() const { return kind_ != PointTextColumns::spatial; }

  Status addPoint(std::string_view line) {
    if (namedColumns_ > 0) ARETE_CHECK(checkCommas(line));
    std::array<double, 3> values{};
    std::array<bool, 3> isMissing{};
    const bool hasWkt = columns_.wkt != kNoColumn;
    std::size_t last = hasWkt ? columns_.wkt : 0;
    if (hasWkt) isMissing = {true, true, columns_.at[2] == kNoColumn};
    for (const std::size_t column : columns_.at)
      if (column != kNoColumn) last = std::max(last, column);
    std::string_view rest = line, field;
    for (std::size_t i = 0; i <= last; ++i) {
      if (!nextField(rest, separator_, field))
        return failure(ErrorCode::invalidData,
                       fmt::format("{} holds {} of the {} fields needed", quoted(trimmed(line)), i, last + 1),
                       where());
      if (i == columns_.wkt) ARETE_CHECK(takeWkt(field, values, isMissing));
      for (std::size_t k = 0; k < 3; ++k) {
        if (columns_.at[k] != i) continue;
        const CellNumber number = readCell(field);
        if (number.kind == CellNumber::Kind::missing && kind_ != PointTextColumns::plan) {
          isMissing[k] = true;
          continue;
        }
        if (number.kind == CellNumber::Kind::notANumber)
          return failure(ErrorCode::invalidData, fmt::format("{} {}", quoted(field), whyNotANumber(field)),
                         where());
        if (number.kind == CellNumber::Kind::missing || !std::isfinite(number.value))
          return failure(ErrorCode::invalidData, fmt::format("{} is not a finite number", quoted(field)),
                         where());
        ARETE_CHECK(takeDecimalSign(field, number));
        values[k] = number.value;
      }
    }
    return addValues(line, values, isMissing);
  }

  /// A point as text gives all three that it has; a column of heights comes before its own.
  Status takeWkt(std::string_view field, std::array<double, 3>& values, std::array<bool, 3>& isMissing) {
    if (readCell(field).kind == CellNumber::Kind::missing) return {};
    const std::optional<WktPoint> point = readWktPoint(field);
    if (!point)
      return failure(ErrorCode::invalidData, fmt::format("{} is not a point in WKT", quoted(field)), where());
    if (!point->place) return {};
    if (hasSrid_ && point->srid != rows_.srid)
      return failure(ErrorCode::invalidData,
                     fmt::format("{} is in EPSG:{}, and points before it in EPSG:{}", quoted(field),
                                 point->srid, rows_.srid),
                     where());
    hasSrid_ = true;
    rows_.srid = point->srid;
    isMissing[0] = isMissing[1] = false;
    values[0] = point->place->x;
    values[1] = point->place->y;
    if (!point->z || columns_.at[2] != kNoColumn) return {};
    isMissing[2] = false;
    values[2] = *point->z;
    return {};
  }

  Status addValues(std::string_view line, const std::array<double, 3>& values,
                   const std::array<bool, 3>& isMissing) {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    const bool hasNoPlace = isMissing[0] || isMissing[1];
    if (hasNoPlace && kind_ == PointTextColumns::planRows) {
      ++rows_.withoutPlace;
      rows_.add(isMissing[0] ? kNothing : values[0], isMissing[1] ? kNothing : values[1], kNothing,
                lineNumber_);
      if (attributes_) addAttributes(line);
      return {};
    }
    // A line without any of the three is a gap between the parts of a file.
    if (isMissing[0] && isMissing[1] && isMissing[2] && !isPlan()) return {};
    if (hasNoPlace)
      return failure(ErrorCode::invalidData,
                     fmt::format("{} has no {} that is a finite number", quoted(trimmed(line)),
                                 isMissing[0] ? "x" : "y"),
                     where());
    mayCountLines_ = mayCountLines_ && (rows_.positions.empty() ? values[0] == 0 || values[0] == 1
                                                                : values[0] == rows_.positions.back().x + 1);
    if (isMissing[2] && !isPlan()) {
      if (withoutHeight_++ == 0) lineWithoutHeight_ = lineNumber_;
      return {};
    }
    const bool hasZ = columns_.wkt != kNoColumn && !isMissing[2];
    rows_.add(values[0], values[1], isPlan() && !hasZ ? kNothing : values[2], lineNumber_);
    if (attributes_) addAttributes(line);
    return {};
  }

  static bool isWktPoint(std::string_view field) { return readWktPoint(field).has_value(); }

  /// A name of a column of points as text, or such a point.
  static bool isPointText(std::string_view text) {
    return findField(std::array{text}, ColumnNames::wkt()).has_value() || isWktPoint(text);
  }

  /// Words for missing values and nothing else.
  static bool isGap(std::string_view line) {
    return std::ranges::all_of(fieldsOf(line, separatorOf(line)), [](std::string_view field) {
      return !field.empty() && readCell(field).kind == CellNumber::Kind::missing;
    });
  }

  static bool isNumber(std::string_view field) { return readCell(field).kind == CellNumber::Kind::number; }

  static bool startsWithLabel(std::span<const std::string_view> fields, std::size_t needed) {
    return fields.size() > needed && !isNumber(fields[0]) &&
           std::all_of(fields.begin() + 1, fields.begin() + std::ptrdiff_t(needed) + 1, isNumber);
  }

  /// With commas as separators and as decimal signs, the first line has twice as many fields as columns.
  Status checkCommas(std::string_view line) {
    const std::size_t columns = std::exchange(namedColumns_, 0);
    if (separator_ != ',') return {};
    const std::vector<std::string_view> fields = fieldsOf(line, separator_);
    if (fields.size() != 2 * columns || !std::ranges::all_of(fields, isNumber)) return {};
    return failure(
        ErrorCode::invalidData,
        fmt::format("{} has {} numbers for {} columns: its commas seem to be decimal signs as well as "
                    "separators, so that none is certain",
                    quoted(trimmed(line)), fields.size(), columns),
        where());
  }

  /// A text has decimal points or decimal commas, not both. Where commas separate the fields as well, a
  /// number such as "1,234" may have grouped digits.
  Status takeDecimalSign(std::string_view field, const CellNumber& number) {
    if (number.hasDecimalComma && separator_ == ',' && number.mayBeGrouped)
      return failure(ErrorCode::invalidData,
                     fmt::format("{} may have a decimal comma or grouped digits", quoted(field)), where());
    if (number.hasDecimalComma && lineWithComma_ == 0) lineWithComma_ = lineNumber_;
    if (lineWithPoint_ == 0 && field.find('.') != std::string_view::npos) lineWithPoint_ = lineNumber_;
    if (lineWithComma_ == 0 || lineWithPoint_ == 0) return {};
    return failure(ErrorCode::invalidData,
                   fmt::format("{}: the text has decimal points (line {}) and decimal commas (line {})",
                               quoted(field), lineWithPoint_, lineWithComma_),
                   where());
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
  Warnings& warnings_;
  PointAttributes* attributes_;
  std::size_t fieldCount_ = 0, surplusFields_ = 0;
  PointRows rows_;
  Columns columns_;
  std::size_t namedColumns_ = 0;  // until the first point
  std::optional<char> statedSeparator_;
  std::uint64_t withoutHeight_ = 0, lineWithoutHeight_ = 0, lineWithPoint_ = 0, lineWithComma_ = 0;
  bool hasSrid_ = false;        // a point as text came before
  bool mayCountLines_ = false;  // x is 1, 2, 3, ... and three more numbers follow
  char separator_ = kSpaces;
  bool started_ = false;
  std::uint64_t lineNumber_ = 0, nextLine_ = 1;  // first line of this record, and of the next
};

}  // namespace

bool looksLikePointText(const std::string& path, std::size_t needed) {
  const std::string extension = text::lowerExtension(path);
  if (extension == "csv" || extension == "tsv" || extension == "txt" || extension == "xyz") return true;
  if (findPipeProblem(path)) return false;
  const std::unique_ptr<VSILFILE, FileCloser> file(VSIFOpenL(servedPath(path).c_str(), "rb"));
  if (!file) return false;
  std::array<char, 4096> head;
  const std::string_view bytes(head.data(), VSIFReadL(head.data(), 1, head.size(), file.get()));
  std::string decoded;
  TextDecoder().decode(bytes, decoded);
  std::string_view text = decoded;
  if (text.find('\0') != std::string_view::npos) return false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> fields = fieldsOf(line, separatorOf(line));
    const auto areNumbers = [&](std::size_t from) {
      return fields.size() >= from + needed &&
             std::all_of(fields.begin() + std::ptrdiff_t(from),
                         fields.begin() + std::ptrdiff_t(from + needed),
                         [](std::string_view f) { return readCell(f).kind != CellNumber::Kind::notANumber; });
    };
    return areNumbers(0) || areNumbers(1) ||
           (fields.size() >= 2 && findField(fields, ColumnNames::x()) && findField(fields, ColumnNames::y()));
  }
  return false;
}

Result<PointRows> readPointText(const std::string& path, const std::string& zColumn, Warnings& warnings,
                                const RunContext& context, PointTextColumns columns,
                                PointAttributes* attributes) {
  registerGdal();
  GdalErrors errors;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const std::unique_ptr<VSILFILE, FileCloser> file(VSIFOpenL(servedPath(path).c_str(), "rb"));
  if (!file) return failure(ErrorCode::notFound, "there is no such file", path);
  VSIStatBufL status;
  const double size = VSIStatL(servedPath(path).c_str(), &status) == 0 ? double(status.st_size) : 0;

  // One more than a small file has, so that its end is seen at once.
  const std::size_t chunkBytes = size > 0 && size < kMostChunkBytes ? std::size_t(size) + 1 : kMostChunkBytes;
  TextParser parser(path, zColumn, columns, warnings, attributes);
  TextDecoder decoder;
  std::string buffer, bytes;
  double bytesRead = 0;
  for (bool more = true; more;) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped", path);
    context.report("reading", size > 0 ? std::min(1.0, bytesRead / size) : 0);
    bytes.resize(chunkBytes);
    bytes.resize(VSIFReadL(bytes.data(), 1, chunkBytes, file.get()));
    bytesRead += double(bytes.size());
    more = bytes.size() == chunkBytes;
    decoder.decode(bytes, buffer);
    if (!more) decoder.finish(buffer);
    std::string_view text = buffer;
    while (!text.empty()) {
      std::size_t end = parser.recordEnd(text);
      if (end == std::string_view::npos) {
        if (more) break;
        end = text.size();
      }
      ARETE_CHECK(parser.addRecord(text.substr(0, end)));
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
