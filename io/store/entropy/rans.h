// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace arete {

/// A table of an entropy coder: range asymmetric numeral systems [Duda2013] with static tables and a 64-bit
/// state that is refilled by 32-bit words. A stream may use another table for every symbol; encoder and
/// decoder must use the same.
///
/// A table gives each symbol 0..255 a share of 1024; a symbol costs 10 - log2(share) bits. Shares of a larger
/// sum would save half a percent, but the many tables would not stay in a processor's cache.
class RansTable {
 public:
  static constexpr int kBits = 10;
  static constexpr std::size_t kAlphabet = 256;

  RansTable() = default;
  /// Shares in proportion to how often each symbol occurs; at least 1 for a symbol that occurs.
  static RansTable ofCounts(std::span<const std::uint64_t, kAlphabet> counts);
  /// A table with given shares. @return nothing unless they sum to 2^kBits
  static std::optional<RansTable> ofShares(const std::array<std::uint16_t, kAlphabet>& shares);

  /// Whether no symbol has a share, so that nothing can be coded.
  bool isEmpty() const { return shares_.empty(); }
  std::uint32_t share(unsigned symbol) const { return isEmpty() ? 0u : shares_[symbol]; }
  std::uint32_t begin(unsigned symbol) const { return begins_[symbol]; }

  /// The table as RansDecoder reads it: 1024 bytes, the symbol of each state modulo 1024; then for each
  /// symbol share << 16 | begin. Compact, so that many tables stay in a processor's first cache. Zeros if the
  /// table is empty; a stream that is decoded with it does not end where it should.
  static constexpr std::size_t kEntries = (std::size_t{1} << kBits) / sizeof(std::uint32_t) + kAlphabet;
  void writeEntries(std::uint32_t* entries) const;

 private:
  std::vector<std::uint16_t> shares_, begins_;
};

/// Tables as bytes, one after the other: how many symbols have a share, and for each the symbol less the one
/// after that before and its share less 1, as numbers (number_bytes.h).
std::vector<std::byte> toBytes(std::span<const RansTable> tables);
/// Reads `count` tables; nothing if the bytes are damaged.
std::optional<std::vector<RansTable>> tablesOf(std::span<const std::byte> bytes, std::size_t count);

/// A symbol and the number of its table. Small, because an encoder that derives its tables holds all symbols.
struct RansSymbol {
  std::uint8_t table = 0;
  std::uint8_t symbol = 0;
};

/// Encodes symbols; RansDecoder restores them. The number of bytes is a multiple of four.
/// Precondition: at most 256 tables; every symbol has a share in its table. O(symbols).
std::vector<std::byte> ransEncode(std::span<const RansSymbol> symbols, std::span<const RansTable> tables);

/// Decodes one stream [Duda2013]. Reading beyond its end gives some symbols; isAtEnd() detects it.
class RansDecoder {
 public:
  /// The bytes behind a stream that must be readable; their values do not matter.
  static constexpr std::size_t kReadable = 8;

  RansDecoder() = default;
  /// The stream is bytes[0, size). Precondition: kReadable more bytes are readable.
  RansDecoder(const std::byte* bytes, std::size_t size)
      : at_(bytes), end_(bytes + size / sizeof(Word) * sizeof(Word)) {
    state_ = std::uint64_t{next()} << 32;
    state_ |= next();
  }

  /// @param entries  of the table that the symbol was encoded with (RansTable::writeEntries())
  unsigned decode(const std::uint32_t* entries) {
    constexpr int kBits = RansTable::kBits;
    constexpr std::uint32_t kMask = (1u << kBits) - 1;
    const auto place = static_cast<std::uint32_t>(state_) & kMask;
    const unsigned symbol = reinterpret_cast<const std::uint8_t*>(entries)[place];
    const std::uint32_t entry = entries[(std::size_t{1} << kBits) / sizeof *entries + symbol];
    std::uint64_t state = (entry >> 16) * (state_ >> kBits) + place - (entry & 0xFFFFu);
    // A processor cannot predict whether the state needs a word, so the word is always read and no branch
    // depends on it. States are below 2^63, so the sign of the difference decides.
    Word word;
    std::memcpy(&word, at_, sizeof word);
    const auto due = static_cast<std::uint64_t>(static_cast<std::int64_t>(state - kLow) >> 63);
    state = state << (due & 32) | (word & due);
    at_ += due & sizeof word;
    if (at_ > end_) [[unlikely]]
      at_ = end_ + sizeof word;
    state_ = state;
    return symbol;
  }

  /// Whether the whole stream was read, nothing beyond it, and the state is the encoder's first one: true of
  /// every undamaged stream after its last symbol.
  bool isAtEnd() const { return at_ == end_ && state_ == kLow; }

 private:
  friend std::vector<std::byte> ransEncode(std::span<const RansSymbol>, std::span<const RansTable>);
  using Word = std::uint32_t;
  static constexpr std::uint64_t kLow = std::uint64_t{1} << 31;

  Word next() {
    if (at_ >= end_) {
      at_ = end_ + sizeof(Word);
      return 0;
    }
    Word word;
    std::memcpy(&word, at_, sizeof word);
    at_ += sizeof word;
    return word;
  }

  std::uint64_t state_ = 0;
  const std::byte *at_ = nullptr, *end_ = nullptr;  // at_ is one word beyond end_ if too much was read
};

/// Writes numbers of known width as bits, the lowest bit of the lowest byte first.
class BitWriter {
 public:
  /// Precondition: count <= 64, value below 2^count.
  void write(std::uint64_t value, int count) {
    for (; count > 0; count -= 8) {
      const int now = count < 8 ? count : 8;
      accumulator_ |= (value & ((1u << now) - 1)) << used_;
      used_ += now;
      value >>= now;
      if (used_ >= 8) {
        bytes_.push_back(static_cast<std::byte>(accumulator_ & 0xFF));
        accumulator_ >>= 8;
        used_ -= 8;
      }
    }
  }
  /// The bytes, the last one padded with zeros. Leaves the writer empty.
  std::vector<std::byte> take() {
    if (used_ > 0) bytes_.push_back(static_cast<std::byte>(accumulator_ & 0xFF));
    accumulator_ = 0;
    used_ = 0;
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t accumulator_ = 0;
  int used_ = 0;
};

/// Reads what BitWriter wrote. Beyond the end it reads zeros; isOver() detects it.
class BitReader {
 public:
  BitReader() = default;
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// Precondition: count <= 64.
  std::uint64_t read(int count) {
    if (count > 32) {
      const std::uint64_t low = read(32);
      return low | read(count - 32) << 32;
    }
    std::uint64_t word = 0;
    const std::size_t byte = at_ >> 3;
    if (byte + sizeof word <= bytes_.size()) [[likely]]
      std::memcpy(&word, bytes_.data() + byte, sizeof word);
    else if (byte < bytes_.size())
      std::memcpy(&word, bytes_.data() + byte, bytes_.size() - byte);
    word >>= at_ & 7;
    at_ += static_cast<unsigned>(count);
    return word & ((std::uint64_t{1} << count) - 1);
  }

  bool isOver() const { return at_ > 8 * bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;  // in bits
};

}  // namespace arete
