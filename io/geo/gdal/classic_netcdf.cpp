// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header, big-endian: magic, number of records, list of dimensions, list of attributes, list of
// variables [NetCDF classic format specification, Unidata]. Counts and sizes are 64 bits in CDF-5, offsets in
// CDF-2 and CDF-5. A variable ends at its first byte plus its size; one over the dimension of records ends
// with its part of the last record.
#include <cpl_vsi.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/geo/gdal/file_length.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

constexpr std::uint64_t kMostNumbers = std::uint64_t(1) << 22;  // against endless headers of zeros
constexpr std::uint64_t kStreaming = 0xFFFFFFFFu;

/// Reads big-endian numbers one after the other; after the end of the file it only fails.
class HeaderReader {
 public:
  explicit HeaderReader(const std::string& path) : file_(VSIFOpenL(servedPath(path).c_str(), "rb")) {}
  ~HeaderReader() {
    if (file_) VSIFCloseL(file_);
  }
  HeaderReader(const HeaderReader&) = delete;
  HeaderReader& operator=(const HeaderReader&) = delete;

  bool isGood() const { return file_ && isGood_; }
  std::uint64_t number(int bytes) {
    unsigned char raw[8] = {};
    isGood_ = isGood() && ++numbers_ <= kMostNumbers &&
              VSIFReadL(raw, 1, std::size_t(bytes), file_) == std::size_t(bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | raw[i];
    return isGood_ ? value : 0;
  }
  void skipPadded(std::uint64_t bytes) {
    if (bytes > std::numeric_limits<std::uint32_t>::max()) isGood_ = false;
    if (isGood()) isGood_ = VSIFSeekL(file_, VSIFTellL(file_) + (bytes + 3) / 4 * 4, SEEK_SET) == 0;
  }

 private:
  VSILFILE* file_;
  bool isGood_ = true;
  std::uint64_t numbers_ = 0;
};

std::uint64_t bytesOfType(std::uint64_t type) {
  constexpr std::uint64_t kBytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return type < std::size(kBytes) ? kBytes[type] : 0;
}

struct Variable {
  bool isOfRecords = false;
  std::uint64_t begin = 0;
  double bytes = 0;  ///< of all, or of one record; products may exceed 64 bits
};

class ClassicHeader {
 public:
  explicit ClassicHeader(const std::string& path) : in_(path) {}

  std::optional<std::uint64_t> length() {
    if (in_.number(3) != 0x434446) return std::nullopt;  // CDF
    const std::uint64_t version = in_.number(1);
    if (version != 1 && version != 2 && version != 5) return std::nullopt;
    wide_ = version == 5 ? 8 : 4;
    offset_ = version == 1 ? 4 : 8;
    const std::uint64_t records = in_.number(wide_);
    readDimensions();
    skipAttributes();
    readVariables();
    if (!in_.isGood()) return std::nullopt;

    double end = 0, recordBytes = 0;
    const auto count =
        std::count_if(variables_.begin(), variables_.end(), [](const Variable& v) { return v.isOfRecords; });
    for (const Variable& v : variables_)
      if (v.isOfRecords) recordBytes += count == 1 ? v.bytes : padded(v.bytes);
    for (const Variable& v : variables_) {
      if (v.isOfRecords && (records == 0 || records == kStreaming || records == ~std::uint64_t(0))) continue;
      const double before = v.isOfRecords ? double(records - 1) * recordBytes : 0;
      end = std::max(end, double(v.begin) + before + v.bytes);
    }
    constexpr double kMost = double(std::uint64_t(1) << 62);
    return end < kMost ? std::optional(std::uint64_t(end)) : std::nullopt;
  }

 private:
  static double padded(double bytes) { return double((std::uint64_t(bytes) + 3) / 4 * 4); }

  /// The number of elements of a list; 0 where it is absent.
  std::uint64_t listSize() {
    in_.number(4);  // the tag
    const std::uint64_t count = in_.number(wide_);
    return in_.isGood() ? count : 0;
  }
  void skipName() { in_.skipPadded(in_.number(wide_)); }
  void readDimensions() {
    for (std::uint64_t i = 0, count = listSize(); i < count && in_.isGood(); ++i) {
      skipName();
      dimensions_.push_back(in_.number(wide_));
    }
  }
  void skipAttributes() {
    for (std::uint64_t i = 0, count = listSize(); i < count && in_.isGood(); ++i) {
      skipName();
      const std::uint64_t bytes = bytesOfType(in_.number(4)), values = in_.number(wide_);
      in_.skipPadded(values > std::numeric_limits<std::uint32_t>::max() ? ~std::uint64_t(0) : bytes * values);
    }
  }
  void readVariables() {
    for (std::uint64_t i = 0, count = listSize(); i < count && in_.isGood(); ++i) {
      Variable v;
      skipName();
      v.bytes = 1;
      const std::uint64_t rank = in_.number(wide_);
      for (std::uint64_t d = 0; d < rank && in_.isGood(); ++d) {
        const std::uint64_t id = in_.number(wide_);
        const std::uint64_t size = id < dimensions_.size() ? dimensions_[id] : 1;
        if (d == 0 && size == 0)
          v.isOfRecords = true;
        else
          v.bytes *= double(size);
      }
      skipAttributes();
      v.bytes *= double(bytesOfType(in_.number(4)));
      in_.number(wide_);  // its size, which is wrong where it exceeds 4 GiB
      v.begin = in_.number(offset_);
      variables_.push_back(v);
    }
  }

  HeaderReader in_;
  int wide_ = 4, offset_ = 4;
  std::vector<std::uint64_t> dimensions_;
  std::vector<Variable> variables_;
};

}  // namespace

std::optional<std::uint64_t> classicNetcdfLength(const std::string& path) {
  return ClassicHeader(path).length();
}

}  // namespace arete
