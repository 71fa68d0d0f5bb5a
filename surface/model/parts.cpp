// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/parts.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <string>

#include "surface/model/labels.h"

namespace arete {
namespace {

/// Divides parts by what each triangle has.
class Parts {
 public:
  explicit Parts(std::size_t triangles) : partOf_(triangles, 0) {}

  /// @param bytesOf what a triangle has, of the same length for all
  template <class BytesOf>
  void divideBy(const BytesOf& bytesOf) {
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> numbers;
    auto last = numbers.end();
    for (std::uint32_t t = 0; t < partOf_.size(); ++t) {
      const std::span<const std::byte> bytes = bytesOf(t);
      // Neighbours in a file are mostly of the same part.
      if (last == numbers.end() || last->first.first != partOf_[t] ||
          last->first.second.size() != bytes.size() ||
          std::memcmp(last->first.second.data(), bytes.data(), bytes.size()) != 0)
        last = numbers
                   .try_emplace(
                       {partOf_[t], std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())},
                       static_cast<std::uint32_t>(numbers.size()))
                   .first;
      partOf_[t] = last->second;
    }
    count_ = numbers.size();
  }

  std::vector<std::uint32_t> take() && {
    if (count_ < 2) partOf_.clear();
    return std::move(partOf_);
  }

 private:
  std::vector<std::uint32_t> partOf_;
  std::size_t count_ = 0;
};

bool mayHaveParts(const MeshAttributes& attributes) {
  return !attributes.objectOf.empty() || !attributes.materialOf.empty() ||
         std::ranges::any_of(attributes.triangleAttributes, isLabel);
}

}  // namespace

std::vector<std::uint32_t> partsOf(const MeshAttributes& attributes, std::span<const std::uint32_t> faceOf) {
  if (!mayHaveParts(attributes)) return {};
  Parts parts(faceOf.size());
  for (const auto* const numbers : {&attributes.objectOf, &attributes.materialOf})
    if (!numbers->empty())
      parts.divideBy(
          [&](std::uint32_t t) { return std::as_bytes(std::span(*numbers).subspan(faceOf[t], 1)); });
  for (const Attribute& attribute : attributes.triangleAttributes)
    if (isLabel(attribute)) parts.divideBy([&](std::uint32_t t) { return attribute.element(faceOf[t]); });
  return std::move(parts).take();
}

std::vector<std::uint32_t> partsOf(const MeshAttributes& attributes, std::size_t triangles) {
  if (!mayHaveParts(attributes)) return {};
  std::vector<std::uint32_t> all(triangles);
  std::iota(all.begin(), all.end(), 0u);
  return partsOf(attributes, all);
}

}  // namespace arete
