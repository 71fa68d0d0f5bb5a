// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file is read in chunks and cut into lines where it lies; the unfinished last line of a chunk moves to
// the front of the next. The first line that holds anything fixes the separator (the first of semicolon,
// comma, tab that occurs in it, else spaces) and the columns. Numbers go through std::from_chars: no locale,
// exact.
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

#include "io/file/text_scan.h"
#include "io/gdal/support.h"

namespace arete {
namespace {

constexpr std::size_t kMostChunkBytes = std::size_t(1) << 22;
constexpr std::size_t kLongestLine = std::size_t(1) << 20;
constexpr std::size_t kQuotedCharacters = 60;
constexpr std::size_t kColumnsNamed = 20, kCharactersOfColumn = 30;
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

/// Where a comment begins, or npos. In quotes '#' is text.
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
  for (const char separator : {';', ',', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return kSpaces;
}

/// Takes the next field off the front of `rest`; false when there is none left.
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

/// The first columns by name, for a message.
std::string columnNames(std::span<const std::string_view> fields) {
  std::string names;
  for (std::size_t i = 0; i < std::min(fields.size(), kColumnsNamed); ++i)
    names += (i > 0 ? ", " : "") + text::printable(fields[i], kCharactersOfColumn);
  if (fields.size() > kColumnsNamed) names += fmt::format(" and {} more", fields.size() - kColumnsNamed);
  return names;
}

std::optional<double> parseNumber(std::string_view field) {
  if (field.starts_with("+-")) return std::nullopt;
  const char* at = field.data();
  const char* const end = at + field.size();
  double value = 0;
  return text::scanNumber(at, end, value) && at == end ? std::optional(value) : std::nullopt;
}

/// Which fields of a line are x, y, z.
struct Columns {
  std::array<std::size_t, 3> at = {0, 1, 2};
};

constexpr std::array<std::string_view, 11> kXNames = {
    "x", "lon", "long", "longitude", "lng", "easting", "east", "e", "x_coord", "xcoord", "point_x"};
constexpr std::array<std::string_view, 9> kYNames = {"y", "lat",     "latitude", "northing", "north",
                                                     "n", "y_coord", "ycoord",   "point_y"};
constexpr std::array<std::string_view, 11> kZNames = {
    "z", "elev", "elevation", "height", "h", "alt", "ele", "altitude", "z_coord", "zcoord", "point_z"};

std::optional<std::size_t> findColumn(std::span<const std::string_view> fields,
                                      std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (text::lowered(fields[i]) == name) return i;
  return std::nullopt;
}

Result<Columns> columnsByName(std::span<const std::string_view> fields, const std::string& zColumn,
                              PointTextColumns kind, std::vector<std::string>& warnings) {
  const auto x = findColumn(fields, kXNames), y = findColumn(fields, kYNames);
  if (kind == PointTextColumns::plan && x && y) return Columns{{*x, *y, *y}};
  auto z = findColumn(fields, kZNames);
  if (!zColumn.empty()) {
    const auto named = std::find(fields.begin(), fields.end(), std::string_view(zColumn));
    const std::string wanted = text::lowered(zColumn);
    z = named != fields.end() ? std::optional(std::size_t(named - fields.begin()))
                              : findColumn(fields, std::array<std::string_view, 1>{wanted});
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

  Status addLine(std::string_view line) {
    ++lineNumber_;
    noteQuotes(line);
    line = line.substr(0, findComment(line));
    if (trimmed(line).empty()) return {};
    if (!started_) {
      started_ = true;
      separator_ = separatorOf(line);
      const std::vector<std::string_view> fields = fieldsOf(line, separator_);
      if (std::none_of(fields.begin(), fields.end(),
                       [](std::string_view f) { return parseNumber(f).has_value(); })) {
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
    Status added = addPoint(line);
    if (!added && quoteLine_ > 0)
      added.error().message += fmt::format(
          "; a quoted text begins on line {} and does not end there: line breaks in quotes are not read",
          quoteLine_);
    return added;
  }

  PointRows takeRows() {
    if (surplusFields_ > 0)
      warnings_.push_back(
          fmt::format("{} fields stand beyond the last column and are left out", surplusFields_));
    return std::move(rows_);
  }
  std::uint64_t lineNumber() const { return lineNumber_; }

 private:
  /// For messages: where a text begins that a line, this one or one before, leaves open or closes.
  void noteQuotes(std::string_view line) {
    if (!isQuoteOpen_) quoteLine_ = 0;
    if (line.find('"') == std::string_view::npos || std::count(line.begin(), line.end(), '"') % 2 == 0)
      return;
    if (!isQuoteOpen_) quoteLine_ = lineNumber_;
    isQuoteOpen_ = !isQuoteOpen_;
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
        const auto value = parseNumber(field);
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

  /// What stands in quotes has its own quotes doubled.
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
  std::uint64_t lineNumber_ = 0, quoteLine_ = 0;
  bool isQuoteOpen_ = false;
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
    return fields.size() >= 3 && std::all_of(fields.begin(), fields.begin() + 3,
                                             [](std::string_view f) { return parseNumber(f).has_value(); });
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
      std::size_t end = text.find('\n');
      if (end == std::string_view::npos) {
        if (more) break;
        end = text.size();
      }
      if (Status added = parser.addLine(text.substr(0, end)); !added) return tl::unexpected(added.error());
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (text.size() > kLongestLine)
      return failure(ErrorCode::invalidData,
                     fmt::format("line {} is longer than {} characters: not a text of points",
                                 parser.lineNumber() + 1, kLongestLine),
                     path);
    buffer.erase(0, buffer.size() - text.size());
  }
  context.report("reading", 1);
  return parser.takeRows();
}

}  // namespace arete
