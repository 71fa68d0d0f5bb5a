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
/// arXiv:1311.2540), a 32-bit state that takes in 16-bit words. A stream may use another table for every
/// symbol; coder and decoder must agree on which.
///
/// A table gives each symbol 0..255 a share of 2^bits; a symbol costs bits - log2(share) bits.
class RansTable {
 public:
  static constexpr int kMaxBits = 12;
  static constexpr std::size_t kAlphabet = 256;

  RansTable() = default;
  /// Shares in proportion to how often each symbol occurs, none of those that do occur being zero.
  static RansTable ofCounts(std::span<const std::uint64_t, kAlphabet> counts);
  /// Nothing unless the shares sum to 2^bits, bits <= kMaxBits.
  static std::optional<RansTable> ofShares(int bits, const std::array<std::uint16_t, kAlphabet>& shares);

  /// No symbol has a share: nothing can be coded.
  bool isEmpty() const { return shares_.empty(); }
  int bits() const { return bits_; }
  std::uint32_t share(unsigned symbol) const { return isEmpty() ? 0u : shares_[symbol]; }
  std::uint32_t begin(unsigned symbol) const { return begins_[symbol]; }

  /// 2^bits entries for RansDecoder: symbol, place within the symbol's share << 8, share - 1 << 20.
  std::vector<std::uint32_t> decodingEntries() const;

 private:
  int bits_ = 0;
  std::vector<std::uint16_t> shares_, begins_;
};

struct RansSymbol {
  std::uint16_t table = 0;
  std::uint8_t symbol = 0;
};

/// The bytes that RansDecoder turns back into these symbols; an even number of them.
/// Precondition: every symbol has a share in its table.
std::vector<std::byte> ransEncode(std::span<const RansSymbol> symbols, std::span<const RansTable> tables);

/// Decodes one stream. Reading beyond its end gives some symbols and is noticed by isAtEnd().
class RansDecoder {
 public:
  RansDecoder() = default;
  explicit RansDecoder(std::span<const std::byte> bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size() / 2 * 2) {
    state_ = next() << 16;
    state_ |= next();
  }

  /// `entries`: 2^bits, of the table the symbol was coded with.
  unsigned decode(const std::uint32_t* entries, int bits) {
    const std::uint32_t entry = entries[state_ & ((1u << bits) - 1)];
    state_ = ((entry >> 20) + 1) * (state_ >> bits) + ((entry >> 8) & 0xFFFu);
    if (state_ < kLow) state_ = (state_ << 16) | next();
    return entry & 0xFFu;
  }

  /// All was read, nothing beyond, and the coder's first state is back: what is so of every undamaged stream
  /// after its last symbol.
  bool isAtEnd() const { return at_ == end_ && state_ == kLow && !isOver_; }

 private:
  friend std::vector<std::byte> ransEncode(std::span<const RansSymbol>, std::span<const RansTable>);
  static constexpr std::uint32_t kLow = 1u << 16;

  std::uint32_t next() {
    if (at_ == end_) {
      isOver_ = true;
      return 0;
    }
    std::uint16_t word;
    std::memcpy(&word, at_, sizeof word);
    at_ += sizeof word;
    return word;
  }

  std::uint32_t state_ = 0;
  bool isOver_ = false;
  const std::byte *at_ = nullptr, *end_ = nullptr;
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
    if (byte + sizeof word <= bytes_.size())
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
