// SPDX-License-Identifier: GPL-3.0-or-later
//
// rANS [Duda2013]. A state x with low <= x < low * 2^32 represents all symbols encoded so far, the last one
// on top. Encoding a symbol whose share is f of 2^bits and begins at b replaces x by (x / f << bits) + b + x
// % f; decoding inverts this. Before a step that would carry x out of its range, the encoder writes the low
// 32 bits of x; the decoder reads them back after its step. So the encoder goes from the last symbol to the
// first, its words are stored in reverse, and the decoder ends in the state that the encoder began with.
#include "io/packed/rans.h"

#include <algorithm>

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

std::vector<std::byte> ransEncode(std::span<const RansSymbol> symbols, std::span<const RansTable> tables) {
  std::vector<std::uint32_t> words;
  std::uint64_t state = RansDecoder::kLow;
  for (std::size_t i = symbols.size(); i-- > 0;) {
    const RansTable& table = tables[symbols[i].table];
    const std::uint32_t share = table.share(symbols[i].symbol);
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

}  // namespace arete
