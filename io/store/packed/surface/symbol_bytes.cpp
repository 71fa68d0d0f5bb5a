// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/surface/symbol_bytes.h"

#include <array>

#include "io/store/entropy/number_bytes.h"

namespace arete::packed {

std::vector<std::byte> SymbolWriter::take() {
  std::vector<std::array<std::uint64_t, RansTable::kAlphabet>> counts(tables_);
  for (const RansSymbol& s : symbols_) ++counts[s.table][s.symbol];
  std::vector<RansTable> tables;
  for (const auto& c : counts) tables.push_back(RansTable::ofCounts(c));
  const std::vector<std::byte> tableBytes = toBytes(tables), coded = ransEncode(symbols_, tables),
                               raw = raw_.take();
  NumberWriter out;
  out.number(tableBytes.size());
  out.number(coded.size());
  std::vector<std::byte> bytes = out.take();
  for (const auto& part : {tableBytes, coded, raw}) bytes.insert(bytes.end(), part.begin(), part.end());
  return bytes;
}

std::optional<SymbolReader> SymbolReader::of(std::span<const std::byte> bytes, unsigned tables) {
  NumberReader in(bytes);
  const std::uint64_t tableBytes = in.number(), coded = in.number();
  if (in.isBad() || tableBytes > in.left() || coded > in.left() - tableBytes) return std::nullopt;
  bytes = bytes.last(in.left());
  const auto read = tablesOf(bytes.first(tableBytes), tables);
  if (!read) return std::nullopt;
  SymbolReader reader;
  reader.tables_.resize(tables * RansTable::kEntries);
  for (std::size_t t = 0; t < tables; ++t) (*read)[t].writeEntries(&reader.tables_[t * RansTable::kEntries]);
  reader.bytes_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(tableBytes), bytes.end());
  const std::size_t rawBytes = reader.bytes_.size() - coded;
  reader.bytes_.resize(reader.bytes_.size() + RansDecoder::kReadable);
  reader.symbols_ = RansDecoder(reader.bytes_.data(), coded);
  reader.raw_ = BitReader({reader.bytes_.data() + coded, rawBytes});
  return reader;
}

}  // namespace arete::packed
