// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which formats are here was found by cutting a file of every format that GDAL writes
// (tests/io/geo/dem/cut_files_test.cpp, tests/io/geo/gdal/cut_vectors_test.cpp): these are read as zeros, as
// garbage, or with a message without numbers.
#include "io/geo/gdal/file_length.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string_view>

#include "io/files/text_scan.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

using Head = std::array<unsigned char, 512>;

std::size_t readHead(const std::string& path, Head& head) {
  head.fill(0);
  VSILFILE* file = VSIFOpenL(servedPath(path).c_str(), "rb");
  if (!file) return 0;
  const std::size_t got = VSIFReadL(head.data(), 1, head.size(), file);
  VSIFCloseL(file);
  return got;
}

std::string_view textOf(const Head& head, std::size_t begin, std::size_t count) {
  return {reinterpret_cast<const char*>(head.data()) + begin, count};
}

/// Parses a number in a field of text, after spaces. Empty where the field has no number.
std::optional<std::uint64_t> numberIn(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end != text.data() ? std::optional(value) : std::nullopt;
}

std::uint64_t bigEndian(const Head& head, std::size_t begin, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | head[begin + std::size_t(i)];
  return value;
}

std::uint64_t littleEndian(const Head& head, std::size_t begin, int bytes) {
  std::uint64_t value = 0;
  for (int i = bytes; i-- > 0;) value = value << 8 | head[begin + std::size_t(i)];
  return value;
}

/// A user header label, perhaps after the labels of a tape; one record for each column.
std::optional<std::uint64_t> dtedLength(const Head& head) {
  constexpr std::uint64_t kLabel = 80, kDescriptions = 648 + 2700;
  for (std::size_t begin : {0, 80, 160}) {
    if (textOf(head, begin, 4) != "UHL1") continue;
    const auto columns = numberIn(textOf(head, begin + 47, 4)), rows = numberIn(textOf(head, begin + 51, 4));
    if (!columns || !rows) return std::nullopt;
    return begin + kLabel + kDescriptions + *columns * (12 + 2 * *rows);
  }
  return std::nullopt;
}

/// Cells follow a header of 256 bytes; the lowest bits of their type are the logarithm of their size.
std::optional<std::uint64_t> pcrasterLength(const Head& head) {
  if (textOf(head, 0, 27) != "RUU CROSS SYSTEM MAP FORMAT") return std::nullopt;
  const bool isLittle = littleEndian(head, 46, 4) == 1;
  const auto number = [&](std::size_t begin, int bytes) {
    return isLittle ? littleEndian(head, begin, bytes) : bigEndian(head, begin, bytes);
  };
  return 256 + number(100, 4) * number(104, 4) * (std::uint64_t(1) << (number(66, 2) & 3));
}

/// The header counts blocks of 512 bytes. Tiles are counted in advance, before they are written.
std::optional<std::uint64_t> pcidskLength(const Head& head, bool isTiled) {
  if (textOf(head, 0, 8) != "PCIDSK  " || (textOf(head, 360, 4) == "FILE") != isTiled) return std::nullopt;
  const auto blocks = numberIn(textOf(head, 16, 16));
  return blocks ? std::optional(*blocks * 512) : std::nullopt;
}

/// The count of pages is valid where two counters of changes agree.
std::optional<std::uint64_t> sqliteLength(const Head& head) {
  if (std::memcmp(head.data(), "SQLite format 3", 16) != 0) return std::nullopt;
  const std::uint64_t page = bigEndian(head, 16, 2);
  if (bigEndian(head, 24, 4) != bigEndian(head, 92, 4)) return std::nullopt;
  return (page == 1 ? 65536 : page) * bigEndian(head, 28, 4);
}

/// Elements of a DGN of MicroStation follow one another, each with its length, up to a mark of the end.
std::optional<std::uint64_t> dgnLength(const std::string& path, const Head& head, std::uint64_t there) {
  if ((head[0] != 0x08 && head[0] != 0xC8) || head[1] != 0x09 || head[2] != 0xFE || head[3] != 0x02)
    return std::nullopt;
  VSILFILE* file = VSIFOpenL(servedPath(path).c_str(), "rb");
  if (!file) return std::nullopt;
  std::uint64_t at = 0;
  bool hasEnd = false;
  for (std::array<unsigned char, 4> element{}; at + 2 <= there;
       at += 4 + 2 * (element[2] | element[3] << 8)) {
    element.fill(0);
    VSIFSeekL(file, at, SEEK_SET);
    const std::size_t got = VSIFReadL(element.data(), 1, element.size(), file);
    hasEnd = got >= 2 && element[0] == 0xFF && element[1] == 0xFF;
    if (got < 2 || hasEnd) break;
    if (got < element.size()) {
      at += element.size();
      break;
    }
  }
  VSIFCloseL(file);
  return at + (hasEnd ? 0 : 2);
}

constexpr std::uint64_t kCalsHeader = 2048, kCalsRecord = 128;

/// The records of text at the begin of a CALS file of type 1; empty: another file.
std::string calsHeader(const std::string& path, const Head& head) {
  if (textOf(head, 0, 9) != "srcdocid:") return {};
  VSILFILE* file = VSIFOpenL(servedPath(path).c_str(), "rb");
  if (!file) return {};
  std::string header(kCalsHeader, ' ');
  header.resize(VSIFReadL(header.data(), 1, header.size(), file));
  VSIFCloseL(file);
  return header;
}

/// Behind its header a CALS file has rows of code (Group 4) whose number of bytes is not stated, each of one
/// bit at least: GDAL reads a picture without any as 0.
std::optional<std::uint64_t> calsLength(const std::string& path, const Head& head) {
  const std::string header = calsHeader(path, head);
  constexpr std::string_view kSize = "rpelcnt: ";
  for (std::size_t at = 0; at + kCalsRecord <= header.size(); at += kCalsRecord) {
    const std::string_view record = std::string_view(header).substr(at, kCalsRecord);
    const std::size_t comma = record.find(',');
    if (!record.starts_with(kSize) || comma == record.npos) continue;
    const auto rows = numberIn(record.substr(comma + 1));
    if (rows) return kCalsHeader + (*rows + 7) / 8;
  }
  return std::nullopt;
}

/// Whether the code of a CALS file ends with its mark, twice 000000000001, before bits of 0 that fill a byte
/// or a record.
bool hasCalsEnd(const std::string& path, std::uint64_t length) {
  std::array<unsigned char, 4 * kCalsRecord> tail{};
  const std::uint64_t count = std::min<std::uint64_t>(tail.size(), length - std::min(length, kCalsHeader));
  VSILFILE* file = VSIFOpenL(servedPath(path).c_str(), "rb");
  if (!file) return true;
  VSIFSeekL(file, length - count, SEEK_SET);
  std::size_t got = VSIFReadL(tail.data(), 1, count, file);
  VSIFCloseL(file);
  while (got > 0 && tail[got - 1] == 0) --got;
  if (got < 3) return false;
  // The last bits that are there, the lowest bit being the last 1.
  std::uint32_t bits = 0;
  for (std::size_t i = got - std::min<std::size_t>(got, 4); i < got; ++i) bits = bits << 8 | tail[i];
  while ((bits & 1) == 0) bits >>= 1;
  return (bits & 0xFFFFFF) == 0x001001;
}

bool isNamedAsTile(const std::string& path) {
  const std::string name = text::lowered(CPLGetFilename(path.c_str()));
  const auto digits = [&](std::size_t begin, std::size_t count) {
    return std::all_of(name.begin() + std::ptrdiff_t(begin), name.begin() + std::ptrdiff_t(begin + count),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  return name.size() == 11 && name.ends_with(".hgt") && (name[0] == 'n' || name[0] == 's') && digits(1, 2) &&
         (name[3] == 'e' || name[3] == 'w') && digits(4, 3);
}

/// A tile of SRTM has no header: its length is its resolution.
Status checkTile(const std::string& path, std::uint64_t length) {
  constexpr std::uint64_t kOneSecond = 2ull * 3601 * 3601, kThreeSeconds = 2ull * 1201 * 1201;
  if (!isNamedAsTile(path) || length == 0) return {};
  const GdalErrors quiet;
  GDALDriverH driver = GDALIdentifyDriverEx(servedPath(path).c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (driver && !isTextDriver(driver)) return {};
  return failure(
      ErrorCode::unreadable,
      fmt::format(
          "is cut short or no tile of heights: it has {} bytes; a tile of 1 second has {}, of 3 seconds {}",
          length, kOneSecond, kThreeSeconds));
}

}  // namespace

std::optional<std::uint64_t> fileLength(const std::string& path) {
  VSIStatBufL status;
  if (VSIStatL(servedPath(path).c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return std::nullopt;
  return std::uint64_t(status.st_size);
}

Status checkLength(std::uint64_t wanted, std::uint64_t there, const std::string& what) {
  if (there >= wanted) return {};
  return failure(ErrorCode::unreadable,
                 fmt::format("is cut short: {} states {} bytes and {} are there", what, wanted, there));
}

Status checkLengthByContent(const std::string& path) {
  const GdalErrors quiet;
  Head head;
  if (readHead(path, head) == 0) return {};
  const auto there = fileLength(path);
  if (!there) return {};
  for (const auto& wanted : {dtedLength(head), pcrasterLength(head), pcidskLength(head, false),
                             sqliteLength(head), dgnLength(path, head, *there), calsLength(path, head)})
    if (wanted) return checkLength(*wanted, *there, "its header");
  if (textOf(head, 0, 3) == "CDF" && (head[3] == 1 || head[3] == 2 || head[3] == 5)) {
    if (const auto wanted = classicNetcdfLength(path)) return checkLength(*wanted, *there, "its header");
    return failure(
        ErrorCode::unreadable,
        fmt::format("is cut short or damaged: its header does not end within the {} bytes that are there",
                    *there));
  }
  return checkTile(path, *there);
}

void warnOfLength(const std::string& path, Warnings& warnings) {
  const GdalErrors quiet;
  Head head;
  if (readHead(path, head) == 0) return;
  const auto wanted = pcidskLength(head, true), there = fileLength(path);
  if (there && !calsHeader(path, head).empty() && !hasCalsEnd(path, *there))
    warnings.push_back(
        {WarningCode::damaged,
         "its picture does not end with the mark of its end (EOFB): it may have been cut off"});
  if (wanted && there && *wanted > *there)
    warnings.push_back(
        {WarningCode::damaged, fmt::format("its header counts {} bytes and {} are there: tiles that were not "
                                           "written, or have been cut off, "
                                           "are heights of 0",
                                           *wanted, *there)});
}

}  // namespace arete
