// SPDX-License-Identifier: GPL-3.0-or-later
//
// Code units of UTF-16 become code points, and these UTF-8. Files without a byte order mark are recognised by
// their first characters, which in every text that Arete reads are of ASCII, so that one of two bytes is 0.
#include "io/files/text_decoder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace arete {

namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::size_t kProbe = 64;  ///< bytes that decide where there is no mark
constexpr std::uint32_t kReplacement = 0xFFFD;

/// True for UTF-16 in that byte order, judged by the zeros: one in most characters, none elsewhere.
bool hasZerosAt(std::string_view text, std::size_t parity) {
  const std::size_t count = std::min(text.size(), kProbe) / 2 * 2;
  std::array<std::size_t, 2> zeros = {0, 0};
  for (std::size_t i = 0; i < count; ++i) zeros[i % 2] += text[i] == '\0' ? 1 : 0;
  return count >= 4 && zeros[1 - parity] == 0 && 4 * zeros[parity] > count;
}

bool isLittleEndian(std::string_view text) {
  return text.starts_with("\xFF\xFE") || hasZerosAt(text, 1);
}
bool isBigEndian(std::string_view text) {
  return text.starts_with("\xFE\xFF") || hasZerosAt(text, 0);
}
bool endsLinesInReturns(std::string_view text) {
  return text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos;
}

void appendUtf8(std::uint32_t point, std::string& to) {
  const auto byte = [&](std::uint32_t value) { to += static_cast<char>(value); };
  if (point < 0x80) {
    byte(point);
  } else if (point < 0x800) {
    byte(0xC0 | (point >> 6));
    byte(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    byte(0xE0 | (point >> 12));
    byte(0x80 | ((point >> 6) & 0x3F));
    byte(0x80 | (point & 0x3F));
  } else {
    byte(0xF0 | (point >> 18));
    byte(0x80 | ((point >> 12) & 0x3F));
    byte(0x80 | ((point >> 6) & 0x3F));
    byte(0x80 | (point & 0x3F));
  }
}

}  // namespace

bool TextDecoder::isNeededFor(std::string_view first) {
  return first.starts_with(kUtf8Mark) || isLittleEndian(first) || isBigEndian(first) ||
         endsLinesInReturns(first);
}

void TextDecoder::decode(std::string_view bytes, std::string& to) {
  const bool isFirst = !std::exchange(hasBegun_, true);
  if (isFirst) {
    if (isLittleEndian(bytes)) encoding_ = Encoding::utf16LittleEndian;
    if (isBigEndian(bytes)) encoding_ = Encoding::utf16BigEndian;
    if (encoding_ != Encoding::utf8 && (bytes.front() == '\xFF' || bytes.front() == '\xFE'))
      bytes.remove_prefix(2);
    if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
  }
  const std::size_t before = to.size();
  if (encoding_ == Encoding::utf8)
    to += bytes;
  else
    decodeUtf16(bytes, to);
  if (isFirst) linesEndInReturns_ = endsLinesInReturns(std::string_view(to).substr(before));
  if (linesEndInReturns_) std::replace(to.begin() + std::ptrdiff_t(before), to.end(), '\r', '\n');
}

void TextDecoder::decodeUtf16(std::string_view bytes, std::string& to) {
  const auto take = [&](char first, char second) {
    const bool isLittle = encoding_ == Encoding::utf16LittleEndian;
    const auto high = static_cast<unsigned char>(isLittle ? second : first),
               low = static_cast<unsigned char>(isLittle ? first : second);
    const std::uint32_t unit = (std::uint32_t{high} << 8) | low;
    const bool isHigh = unit >= 0xD800 && unit < 0xDC00, isLow = unit >= 0xDC00 && unit < 0xE000;
    const std::uint32_t waiting = std::exchange(highSurrogate_, 0U);
    if (waiting != 0 && isLow) {
      appendUtf8(0x10000 + ((waiting - 0xD800) << 10) + (unit - 0xDC00), to);
      return;
    }
    if (waiting != 0) appendUtf8(kReplacement, to);
    if (isHigh)
      highSurrogate_ = unit;
    else
      appendUtf8(isLow ? kReplacement : unit, to);
  };
  if (!waiting_.empty() && !bytes.empty()) {
    take(waiting_.front(), bytes.front());
    waiting_.clear();
    bytes.remove_prefix(1);
  }
  for (; bytes.size() >= 2; bytes.remove_prefix(2)) take(bytes[0], bytes[1]);
  waiting_ = bytes;
}

void TextDecoder::finish(std::string& to) {
  if (!waiting_.empty() || highSurrogate_ != 0) appendUtf8(kReplacement, to);
  waiting_.clear();
  highSurrogate_ = 0;
}

}  // namespace arete
