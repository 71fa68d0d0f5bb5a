// SPDX-License-Identifier: GPL-3.0-or-later
//
// rANS [Duda2013]. A state x with low <= x < low * 2^32 represents all symbols encoded so far, the last one
// on top. Encoding a symbol whose share is f of 2^bits and begins at b replaces x by (x / f << bits) + b + x
// % f; decoding inverts this. Before a step that would carry x out of its range, the encoder writes the low
// 32 bits of x; the decoder reads them back after its step. So the encoder goes from the last symbol to the
// first, its words are stored in reverse, and the decoder ends in the state that the encoder began with.
#include "io/store/entropy/rans.h"

#include <algorithm>

#include "io/store/entropy/number_bytes.h"

namespace arete {

RansTable RansTable::ofCounts(std::span<const std::uint64_t, kAlphabet> counts) {
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  if (total == 0) return {};
  const std::uint64_t size = std::uint64_t{1} << kBits;
  std::array<std::uint16_t, kAlphabet> shares{};
  std::int64_t left = static_cast<std::int64_t>(size);
  for (std::size_t s = 0; s < kAlphabet; ++s) {
    if (counts[s] == 0) continue;
    const double exact =
        static_cast<double>(counts[s]) * static_cast<double>(size) / static_cast<double>(total);
    shares[s] = static_cast<std::uint16_t>(std::max(1.0, exact + 0.5));
    left -= shares[s];
  }
  // The difference that rounding makes is added to the largest shares, where it matters least.
  while (left != 0) {
    const auto largest = std::ranges::max_element(shares);
    const std::int64_t change = left > 0 ? left : -std::min<std::int64_t>(-left, *largest / 2);
    *largest = static_cast<std::uint16_t>(*largest + change);
    left -= change;
  }
  return *ofShares(shares);
}

// Shares come from a file too, so a sum that is not the whole, or overflows on the way, is refused and not
// repaired.
std::optional<RansTable> RansTable::ofShares(const std::array<std::uint16_t, kAlphabet>& shares) {
  RansTable table;
  table.shares_.assign(shares.begin(), shares.end());
  table.begins_.resize(kAlphabet);
  std::uint32_t begin = 0;
  for (std::size_t s = 0; s < kAlphabet; ++s) {
    table.begins_[s] = static_cast<std::uint16_t>(begin);
    begin += shares[s];
    if (begin > 1u << kBits) return std::nullopt;
  }
  if (begin != 1u << kBits) return std::nullopt;
  return table;
}

// A decoder finds a symbol by one look-up: each symbol fills as many bytes as it has share. The shares and
// beginnings follow them, one word for each symbol.
void RansTable::writeEntries(std::uint32_t* entries) const {
  std::fill_n(entries, kEntries, 0);
  if (isEmpty()) return;
  std::vector<std::uint8_t> symbols;
  for (std::uint32_t s = 0; s < kAlphabet; ++s) {
    symbols.insert(symbols.end(), shares_[s], static_cast<std::uint8_t>(s));
    entries[kEntries - kAlphabet + s] = std::uint32_t{shares_[s]} << 16 | begins_[s];
  }
  std::memcpy(entries, symbols.data(), symbols.size());
}

/// The last symbol is encoded first, so that the decoder, which works in the opposite direction, gets the
/// first one first.
std::vector<std::byte> ransEncode(std::span<const RansSymbol> symbols, std::span<const RansTable> tables) {
  std::vector<std::uint32_t> words;
  std::uint64_t state = RansDecoder::kLow;
  for (std::size_t i = symbols.size(); i-- > 0;) {
    const RansTable& table = tables[symbols[i].table];
    const std::uint32_t share = table.share(symbols[i].symbol);
    // The bound is the least state that the step would carry to 2^63: one word at most is written at each
    // step.
    if (state >= std::uint64_t{share} << (63 - RansTable::kBits)) {
      words.push_back(static_cast<std::uint32_t>(state));
      state >>= 32;
    }
    state = ((state / share) << RansTable::kBits) + state % share + table.begin(symbols[i].symbol);
  }
  words.push_back(static_cast<std::uint32_t>(state));
  words.push_back(static_cast<std::uint32_t>(state >> 32));
  std::ranges::reverse(words);
  std::vector<std::byte> bytes(words.size() * sizeof(std::uint32_t));
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

/// Symbols are stored by their distances from each other and shares less one, so that common tables take a
/// byte for each number.
std::vector<std::byte> toBytes(std::span<const RansTable> tables) {
  NumberWriter out;
  for (const RansTable& table : tables) {
    unsigned symbols = 0;
    for (unsigned s = 0; s < RansTable::kAlphabet; ++s) symbols += table.share(s) > 0 ? 1 : 0;
    out.number(symbols);
    if (symbols == 0) continue;
    unsigned next = 0;
    for (unsigned s = 0; s < RansTable::kAlphabet; ++s) {
      if (table.share(s) == 0) continue;
      out.number(s - next);
      out.number(table.share(s) - 1);
      next = s + 1;
    }
  }
  return out.take();
}

/// The bytes come from a file: each symbol must lie in the alphabet, shares must add up, and nothing may
/// follow.
std::optional<std::vector<RansTable>> tablesOf(std::span<const std::byte> bytes, std::size_t count) {
  NumberReader in(bytes);
  std::vector<RansTable> tables(count);
  for (RansTable& table : tables) {
    const std::uint32_t symbols = in.number(RansTable::kAlphabet);
    if (symbols == 0) continue;
    std::array<std::uint16_t, RansTable::kAlphabet> shares{};
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < symbols; ++i) {
      const std::uint32_t s = next + in.number(RansTable::kAlphabet);
      const std::uint32_t share = in.number((1u << RansTable::kBits) - 1) + 1;
      if (in.isBad() || s >= RansTable::kAlphabet) return std::nullopt;
      shares[s] = static_cast<std::uint16_t>(share);
      next = s + 1;
    }
    const auto read = RansTable::ofShares(shares);
    if (!read) return std::nullopt;
    table = *read;
  }
  if (!in.isDone()) return std::nullopt;
  return tables;
}

}  // namespace arete
