// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace arete {

/// An entropy coder with static tables: range asymmetric numeral systems (Duda, "Asymmetric numeral systems",
/// arXiv:1311.2540), a 64-bit state that takes in 32-bit words: rarely, so that a processor foresees mostly
/// that it will not. A stream may use another table for every symbol; coder and decoder must agree on which.
///
/// A table gives each symbol 0..255 a share of 1024; a symbol costs 10 - log2(share) bits. Larger tables
/// would cost half a percent less and would not stay in a processor's cache, of which they are many.
class RansTable {
 public:
  static constexpr int kBits = 10;
  static constexpr std::size_t kAlphabet = 256;

  RansTable() = default;
  /// Shares in proportion to how often each symbol occurs, none of those that do occur being zero.
  static RansTable ofCounts(std::span<const std::uint64_t, kAlphabet> counts);
  /// Nothing unless the shares sum to 2^kBits.
  static std::optional<RansTable> ofShares(const std::array<std::uint16_t, kAlphabet>& shares);

  /// No symbol has a share: nothing can be coded.
  bool isEmpty() const { return shares_.empty(); }
  std::uint32_t share(unsigned symbol) const { return isEmpty() ? 0u : shares_[symbol]; }
  std::uint32_t begin(unsigned symbol) const { return begins_[symbol]; }

  /// What RansDecoder wants to know: the symbol at each place, a byte each, then of each symbol its share <<
  /// 16 and where it begins. Small, so that many tables stay in a processor's first cache. Zeros where the
  /// table is empty: what is decoded then does not end where it should.
  static constexpr std::size_t kEntries = (std::size_t{1} << kBits) / sizeof(std::uint32_t) + kAlphabet;
  void writeEntries(std::uint32_t* entries) const;

 private:
  std::vector<std::uint16_t> shares_, begins_;
};

/// Small, as a coder that makes its tables of what it codes holds all symbols first.
struct RansSymbol {
  std::uint8_t table = 0;
  std::uint8_t symbol = 0;
};

/// The bytes that RansDecoder turns back into these symbols; a multiple of four of them.
/// Precondition: at most 256 tables; every symbol has a share in its own.
std::vector<std::byte> ransEncode(std::span<const RansSymbol> symbols, std::span<const RansTable> tables);

/// Decodes one stream. Reading beyond its end gives some symbols and is noticed by isAtEnd().
class RansDecoder {
 public:
  /// What must be readable behind a stream, whatever it holds.
  static constexpr std::size_t kReadable = 8;

  RansDecoder() = default;
  /// The stream is bytes[0, size); kReadable bytes more are there.
  RansDecoder(const std::byte* bytes, std::size_t size)
      : at_(bytes), end_(bytes + size / sizeof(Word) * sizeof(Word)) {
    state_ = std::uint64_t{next()} << 32;
    state_ |= next();
  }

  /// `entries`: of the table the symbol was coded with.
  unsigned decode(const std::uint32_t* entries) {
    constexpr int kBits = RansTable::kBits;
    constexpr std::uint32_t kMask = (1u << kBits) - 1;
    const auto place = static_cast<std::uint32_t>(state_) & kMask;
    const unsigned symbol = reinterpret_cast<const std::uint8_t*>(entries)[place];
    const std::uint32_t entry = entries[(std::size_t{1} << kBits) / sizeof *entries + symbol];
    std::uint64_t state = (entry >> 16) * (state_ >> kBits) + place - (entry & 0xFFFFu);
    // Whether a word is due cannot be foreseen, so it is read in any case, and no branch depends on it.
    // States are below 2^63, so the sign of the difference tells.
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

  /// All was read, nothing beyond, and the coder's first state is back: what is so of every undamaged stream
  /// after its last symbol.
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
  const std::byte *at_ = nullptr, *end_ = nullptr;  // one word beyond the end: too much was read
};

/// Numbers of known width, without a model.
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
  /// All that was written, the last byte filled up with zeros. Leaves the writer empty.
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

/// Reads what BitWriter wrote. Beyond the end there are zeros, and isOver() notices.
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
