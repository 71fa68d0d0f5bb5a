// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part from the front of a JSON object never has all its brackets closed. So brackets and quotation marks
// alone tell whether a record is whole, and numbers that only some parsers take (NaN) do not matter.
#include "io/geo/gdal/whole_text.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "io/files/text_scan.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

constexpr std::size_t kChunk = std::size_t(1) << 20;
constexpr char kRecordSeparator = '\x1e';

struct FileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

/// Calls take(character) for each character of a file until it returns false. False if it cannot be opened.
template <class Take>
bool forCharacters(const std::string& path, const Take& take) {
  const std::unique_ptr<VSILFILE, FileCloser> file(VSIFOpenL(servedPath(path).c_str(), "rb"));
  if (!file) return false;
  std::vector<char> chunk(kChunk);
  for (;;) {
    const std::size_t got = VSIFReadL(chunk.data(), 1, chunk.size(), file.get());
    for (std::size_t i = 0; i < got; ++i)
      if (!take(chunk[i])) return true;
    if (got < chunk.size()) return true;
  }
}

/// One record after the other, by its brackets and quotation marks.
class JsonRecords {
 public:
  /// @return False once a record is broken.
  bool take(char c) {
    if (isBroken_) return false;
    if (isFirst_ && !text::isSpace(c)) {
      isSeparated_ = c == kRecordSeparator;
      isFirst_ = false;
    }
    if (c == kRecordSeparator && isSeparated_ && !inString_) {
      end();
    } else if (c == '\n') {
      if (!isSeparated_) end();
      ++line_;
    } else {
      add(c);
    }
    return !isBroken_;
  }
  void end() {
    if (isBroken_ || !hasBegun_) return;
    isBroken_ = depth_ > 0 || inString_;
    if (isBroken_) return;
    hasBegun_ = false;
    isComplete_ = false;
  }

  bool isBroken() const { return isBroken_; }
  std::uint64_t record() const { return record_; }
  std::uint64_t line() const { return recordLine_; }

 private:
  void add(char c) {
    if (!hasBegun_) {
      if (text::isSpace(c) || static_cast<unsigned char>(c) >= 0x80) return;  // a byte order mark
      hasBegun_ = true;
      ++record_;
      recordLine_ = line_;
      isBroken_ = c != '{';
      depth_ = 1;
      return;
    }
    if (inString_) {
      if (isEscaped_)
        isEscaped_ = false;
      else if (c == '\\')
        isEscaped_ = true;
      else if (c == '"')
        inString_ = false;
      return;
    }
    if (isComplete_) {
      isBroken_ = !text::isSpace(c);
      return;
    }
    if (c == '"') inString_ = true;
    if (c == '{' || c == '[') ++depth_;
    if (c == '}' || c == ']') isComplete_ = --depth_ == 0;
  }

  bool isFirst_ = true, isSeparated_ = false, hasBegun_ = false, isComplete_ = false, isBroken_ = false;
  bool inString_ = false, isEscaped_ = false;
  int depth_ = 0;
  std::uint64_t record_ = 0, line_ = 1, recordLine_ = 1;
};

Status checkJsonRecords(const std::string& path) {
  JsonRecords records;
  if (!forCharacters(path, [&](char c) { return records.take(c); })) return {};
  records.end();
  if (!records.isBroken()) return {};
  return failure(
      ErrorCode::corrupt,
      fmt::format("record {}, which begins on line {}, is cut short or damaged: it is not one whole "
                  "JSON object",
                  records.record(), records.line()));
}

Status checkQuotes(const std::string& path) {
  bool inQuotes = false;
  std::uint64_t line = 1, opened = 0;
  forCharacters(path, [&](char c) {
    if (c == '"' && !inQuotes) opened = line;
    if (c == '"') inQuotes = !inQuotes;
    line += c == '\n' ? 1 : 0;
    return true;
  });
  if (!inQuotes) return {};
  return failure(
      ErrorCode::corrupt,
      fmt::format("is cut short or damaged: a quoted text begins on line {} and does not end", opened));
}

void warnOfLastLine(const std::string& path, Warnings& warnings) {
  char last = '\n';
  forCharacters(path, [&](char c) {
    last = c;
    return true;
  });
  if (last != '\n' && last != '\r' && last != '\x1a')
    warnings.push_back({WarningCode::damaged, "its last line has no end: the file may be cut short"});
}

}  // namespace

Status checkWholeText(const std::string& path, std::string_view driver, Warnings& warnings) {
  constexpr std::array<std::string_view, 4> kLines = {"OGR_GMT", "Geoconcept", "VDV", "Interlis 1"};
  std::string name = path;
  if (const std::string prefix = fmt::format("{}:", driver);
      text::lowered(name).starts_with(text::lowered(prefix)))
    name.erase(0, prefix.size());
  if (name.find("/vsistdin") != name.npos) return {};  // it is read once
  if (driver == "GeoJSONSeq") return checkJsonRecords(name);
  if (driver == "CSV") return checkQuotes(name);
  if (std::ranges::find(kLines, driver) != std::end(kLines)) warnOfLastLine(name, warnings);
  return {};
}

}  // namespace arete
