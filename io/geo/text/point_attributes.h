// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace arete {

/// The attributes of points or lines: named columns of values, stored as texts in one array of characters.
class PointAttributes {
 public:
  /// Values of dates and times are in ISO 8601, those of `boolean` are 0 and 1, of `bytes` in hexadecimal
  /// digits.
  enum class Kind {
    text,
    integer,  ///< of 64 bits
    integer32,
    integer16,
    real,
    real32,
    boolean,
    date,
    time,
    dateTime,
    bytes,
    json,
  };
  struct Column {
    std::string name;
    Kind kind = Kind::text;
  };
  std::vector<Column> columns;

  /// Appends the next value, row by row. An empty value is missing.
  void add(std::string_view value) {
    text_ += value;
    end_.push_back(text_.size());
  }
  std::string_view at(std::size_t row, std::size_t column) const {
    const std::size_t i = row * columns.size() + column;
    const std::size_t begin = i == 0 ? 0 : end_[i - 1];
    return std::string_view(text_).substr(begin, end_[i] - begin);
  }
  std::size_t rows() const { return columns.empty() ? 0 : end_.size() / columns.size(); }

  /// Makes each column whose values are all numbers a column of numbers. "007" is text. O(values).
  void findKinds();

 private:
  std::string text_;
  std::vector<std::size_t> end_;
};

}  // namespace arete
