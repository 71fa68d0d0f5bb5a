// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "io/store/entropy/number_bytes.h"
#include "io/store/entropy/rans.h"
#include "io/store/packed/surface/symbol_bytes.h"
#include "surface/model/surface_model.h"

namespace arete::packed {

/// The values of faces and wedges, in the order of the file: of their attributes, and for faces the
/// numbers of object, group, material and of the file's face, as far as there are.

/// The lists of numbers by face.
inline auto faceListsOf(auto& attributes) {
  return std::array{&attributes.objectOf, &attributes.groupOf, &attributes.materialOf, &attributes.faceOf};
}
inline std::size_t faceValueBytes(const MeshAttributes& a) {
  std::size_t bytes = 0;
  for (const Attribute& attribute : a.triangleAttributes) bytes += attribute.elementBytes();
  for (const auto* list : faceListsOf(a)) bytes += list->empty() ? 0 : sizeof(std::uint32_t);
  return bytes;
}
inline std::size_t wedgeValueBytes(const MeshAttributes& a) {
  std::size_t bytes = 0;
  for (const Attribute& attribute : a.wedgeAttributes) bytes += attribute.elementBytes();
  return bytes;
}
inline void addFaceValues(const MeshAttributes& a, std::uint32_t face, std::vector<std::byte>& to) {
  const auto add = [&](std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); };
  for (const Attribute& attribute : a.triangleAttributes) add(attribute.element(face));
  for (const auto* list : faceListsOf(a))
    if (!list->empty()) add(std::as_bytes(std::span(&(*list)[face], 1)));
}
inline void addWedgeValues(const MeshAttributes& a, std::uint32_t wedge, std::vector<std::byte>& to) {
  for (const Attribute& attribute : a.wedgeAttributes) {
    const auto bytes = attribute.element(wedge);
    to.insert(to.end(), bytes.begin(), bytes.end());
  }
}
/// Precondition: the lists and attributes have that row; `values` has faceValueBytes().
inline void setFaceValues(MeshAttributes& a, std::size_t row, std::span<const std::byte> values) {
  const auto take = [&](std::byte* to, std::size_t bytes) {
    std::memcpy(to, values.data(), bytes);
    values = values.subspan(bytes);
  };
  for (Attribute& attribute : a.triangleAttributes)
    take(attribute.values.data() + row * attribute.elementBytes(), attribute.elementBytes());
  for (auto* list : faceListsOf(a))
    if (!list->empty()) take(reinterpret_cast<std::byte*>(list->data() + row), sizeof(std::uint32_t));
}
inline void setWedgeValues(MeshAttributes& a, std::size_t row, std::span<const std::byte> values) {
  for (Attribute& attribute : a.wedgeAttributes) {
    std::memcpy(attribute.values.data() + row * attribute.elementBytes(), values.data(),
                attribute.elementBytes());
    values = values.subspan(attribute.elementBytes());
  }
}

/// Collects what a segment carries. The bytes of a segment: the number of the next new wedge; how many bytes
/// the symbols take, and the raw bits; then these, and the values.
class CarriedWriterIo : public SymbolRecorder {
 public:
  CarriedWriterIo(const MeshAttributes& attributes, std::uint32_t nextWedge)
      : attributes_(attributes), firstWedge_(nextWedge), nextWedge_(nextWedge) {}

  void bytes(std::span<std::byte> values) { values_.insert(values_.end(), values.begin(), values.end()); }
  void face(std::uint32_t number) { addFaceValues(attributes_, number, values_); }
  void wedge(std::uint32_t number) { addWedgeValues(attributes_, number, values_); }
  std::uint32_t nextWedge() const { return nextWedge_; }
  std::uint32_t takeNextWedge() { return nextWedge_++; }

  std::vector<std::byte> encoded(std::span<const RansTable> tables) {
    const std::vector<std::byte> coded = ransEncode(symbols_, tables), raw = raw_.take();
    NumberWriter out;
    out.number(firstWedge_);
    out.number(coded.size());
    out.number(raw.size());
    std::vector<std::byte> bytes = out.take();
    for (const auto& part : {coded, raw, values_}) bytes.insert(bytes.end(), part.begin(), part.end());
    return bytes;
  }

 private:
  const MeshAttributes& attributes_;
  std::uint32_t firstWedge_, nextWedge_;
  std::vector<std::byte> values_;
};

/// Faces or wedges that segments have made known, with their values.
struct Declared {
  std::size_t valueBytes = 0;  ///< of each
  std::vector<std::uint32_t> numbers = {};
  std::vector<std::byte> values = {};
};

class CarriedReaderIo {
 public:
  /// @return nothing where the bytes are damaged
  static std::optional<CarriedReaderIo> of(std::span<const std::byte> bytes,
                                           std::span<const std::uint32_t> tables, Declared& faces,
                                           Declared& wedges) {
    NumberReader in(bytes);
    const std::uint64_t first = in.number(), coded = in.number(), raw = in.number();
    if (in.isBad() || first > MeshAttributes::kNone || coded > in.left() || raw > in.left() - coded)
      return std::nullopt;
    CarriedReaderIo io(faces, wedges);
    io.tables_ = tables;
    io.nextWedge_ = static_cast<std::uint32_t>(first);
    const auto rest = bytes.last(in.left());
    io.bytes_.assign(rest.begin(), rest.end());
    io.bytes_.resize(rest.size() + RansDecoder::kReadable);
    io.symbols_ = RansDecoder(io.bytes_.data(), coded);
    io.raw_ = BitReader({io.bytes_.data() + coded, raw});
    io.values_ = {io.bytes_.data() + coded + raw, rest.size() - coded - raw};
    return io;
  }

  template <class Actual>
  unsigned code(SymbolStream, unsigned table, const Actual&) {
    return symbols_.decode(&tables_[table * RansTable::kEntries]);
  }
  std::uint64_t raw(int bits, std::uint64_t) { return raw_.read(bits); }
  void bytes(std::span<std::byte> values) {
    const std::size_t there = std::min(values.size(), values_.size());
    if (there > 0) std::memcpy(values.data(), values_.data(), there);
    isShort_ = isShort_ || there < values.size();
    values_ = values_.subspan(there);
  }
  void face(std::uint32_t number) { declare(faces_, number); }
  void wedge(std::uint32_t number) { declare(wedges_, number); }
  std::uint32_t nextWedge() const { return nextWedge_; }
  std::uint32_t takeNextWedge() { return nextWedge_++; }

  /// Whether values were missing.
  bool isShort() const { return isShort_ || raw_.isOver(); }
  bool isAtEnd() const { return symbols_.isAtEnd() && values_.empty() && !isShort(); }

 private:
  CarriedReaderIo(Declared& faces, Declared& wedges) : faces_(faces), wedges_(wedges) {}

  void declare(Declared& to, std::uint32_t number) {
    if (to.valueBytes == 0) return;
    to.numbers.push_back(number);
    const std::size_t at = to.values.size();
    to.values.resize(at + to.valueBytes);
    bytes(std::span(to.values).subspan(at));
  }

  Declared &faces_, &wedges_;
  std::span<const std::uint32_t> tables_;
  std::vector<std::byte> bytes_;  // a move keeps its address
  RansDecoder symbols_;
  BitReader raw_;
  std::span<const std::byte> values_;
  std::uint32_t nextWedge_ = 0;
  bool isShort_ = false;
};

}  // namespace arete::packed
