// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/store/entropy/rans.h"

namespace arete::packed {

/// A chunk of one stream of symbols: the bytes of its tables and of its rANS stream, as LEB128, then these,
/// then raw bits. Writer and reader serve the same code, as those of nodes do
/// (io/store/packed/nodes/node_coder.h).

/// All symbols are of one stream.
enum SymbolStream : unsigned { kSymbols };

/// Keeps what a writer codes.
class SymbolRecorder {
 public:
  template <class Actual>
  unsigned code(SymbolStream, unsigned table, const Actual& actual) {
    const auto symbol = static_cast<unsigned>(actual());
    symbols_.push_back({static_cast<std::uint8_t>(table), static_cast<std::uint8_t>(symbol)});
    return symbol;
  }
  std::uint64_t raw(int bits, std::uint64_t actual) {
    raw_.write(actual, bits);
    return actual;
  }
  std::span<const RansSymbol> symbols() const { return symbols_; }

 protected:
  std::vector<RansSymbol> symbols_;
  BitWriter raw_;
};

class SymbolWriter : public SymbolRecorder {
 public:
  explicit SymbolWriter(unsigned tables) : tables_(tables) {}

  std::vector<std::byte> take();

 private:
  unsigned tables_;
};

class SymbolReader {
 public:
  /// @return nothing where the bytes are damaged
  static std::optional<SymbolReader> of(std::span<const std::byte> bytes, unsigned tables);

  template <class Actual>
  unsigned code(SymbolStream, unsigned table, const Actual&) {
    return symbols_.decode(&tables_[table * RansTable::kEntries]);
  }
  std::uint64_t raw(int bits, std::uint64_t) { return raw_.read(bits); }
  bool isAtEnd() const { return symbols_.isAtEnd() && !raw_.isOver(); }

 private:
  std::vector<std::uint32_t> tables_;
  std::vector<std::byte> bytes_;  // a move keeps its address
  RansDecoder symbols_;
  BitReader raw_;
};

}  // namespace arete::packed
