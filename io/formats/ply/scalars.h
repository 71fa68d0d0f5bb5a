// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include "io/files/text_scan.h"
#include "io/formats/ply/header.h"

namespace arete {

/// Calls visit(T()) with the type of a scalar.
template <class Visit>
decltype(auto) withPlyType(PlyType type, const Visit& visit) {
  switch (type) {
    case PlyType::int8:
      return visit(std::int8_t());
    case PlyType::uint8:
      return visit(std::uint8_t());
    case PlyType::int16:
      return visit(std::int16_t());
    case PlyType::uint16:
      return visit(std::uint16_t());
    case PlyType::int32:
      return visit(std::int32_t());
    case PlyType::uint32:
      return visit(std::uint32_t());
    case PlyType::float32:
      return visit(float());
    default:
      return visit(double());
  }
}

/// The scalars of the data of a PLY, one after the other, in its three encodings. `next` gives a number as a
/// double, which holds all types exactly; `copy` puts it to `to` as a number of its type, to the bit. Both
/// are false at the end of the file, and where there is no number.
template <std::endian kOrder>
struct BinaryPlyScalars {
  static constexpr bool kIsText = false, kSwap = kOrder != std::endian::native;
  const char* at;
  const char* end;
  std::uint64_t misfits = 0;  ///< numbers of a text that their type does not hold

  /// The least number of bytes of a scalar.
  static std::size_t leastSize(PlyType type) { return sizeOf(type); }

  bool next(PlyType type, double& value) {
    return withPlyType(type, [&](auto zero) {
      if (static_cast<std::size_t>(end - at) < sizeof zero) return false;
      value = scalarAt<decltype(zero)>(at);
      at += sizeof zero;
      return true;
    });
  }

  /// Calls take(number) for each of `count` numbers, as long as it is true.
  template <class Take>
  bool each(PlyType type, std::uint64_t count, const Take& take) {
    if (count > static_cast<std::size_t>(end - at) / sizeOf(type)) return false;
    return withPlyType(type, [&](auto zero) {
      for (; count > 0; --count, at += sizeof zero)
        if (!take(scalarAt<decltype(zero)>(at))) return false;
      return true;
    });
  }

  bool copy(PlyType type, std::byte* to) {
    const std::size_t size = sizeOf(type);
    if (static_cast<std::size_t>(end - at) < size) return false;
    std::memcpy(to, at, size);
    if constexpr (kSwap) std::reverse(to, to + size);
    at += size;
    return true;
  }

 private:
  template <class T>
  static double scalarAt(const char* from) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if constexpr (kSwap) std::ranges::reverse(bytes);
    return static_cast<double>(std::bit_cast<T>(bytes));
  }
};

/// The next scalar of an ascii file is the next token. Line breaks count as blanks, since some writers break
/// long records.
struct TextPlyScalars {
  static constexpr bool kIsText = true;
  const char* at;
  const char* end;
  std::uint64_t misfits = 0;

  static std::size_t leastSize(PlyType) { return 2; }  // a digit and a blank before it

  bool next(PlyType, double& value) {
    while (at < end && text::isSpace(*at)) ++at;
    return at < end && text::scanNumber(at, end, value);
  }

  template <class Take>
  bool each(PlyType type, std::uint64_t count, const Take& take) {
    for (double value = 0; count > 0; --count)
      if (!next(type, value) || !take(value)) return false;
    return true;
  }

  bool copy(PlyType type, std::byte* to) {
    if (type == PlyType::float32) {
      float value = 0;
      if (!nextFloat(value)) return false;
      std::memcpy(to, &value, sizeof value);
      return true;
    }
    double value = 0;
    if (!next(type, value)) return false;
    withPlyType(type, [&](auto zero) { put<decltype(zero)>(value, to); });
    return true;
  }

 private:
  /// A float is not read by way of a double, which would round it twice.
  bool nextFloat(float& value) {
    const char* const before = at;
    double rough = 0;
    if (!next(PlyType::float32, rough)) return false;
    const char* from = std::find_if_not(before, at, text::isSpace);
    if (from < at && *from == '+') ++from;
    if (std::from_chars(from, at, value).ec == std::errc::result_out_of_range)
      value = std::strtof(std::string(from, at).c_str(), nullptr);  // rounds to 0 or to infinity
    return true;
  }

  /// A number that the type does not hold becomes the nearest that it holds.
  template <class T>
  void put(double value, std::byte* to) {
    if constexpr (std::is_floating_point_v<T>) {
      const auto number = static_cast<T>(value);
      std::memcpy(to, &number, sizeof number);
      return;
    }
    const double held = std::isnan(value)
                            ? 0
                            : std::clamp(std::round(value), double(std::numeric_limits<T>::min()),
                                         double(std::numeric_limits<T>::max()));
    if (held != value) ++misfits;
    const auto number = static_cast<T>(held);
    std::memcpy(to, &number, sizeof number);
  }
};

}  // namespace arete
