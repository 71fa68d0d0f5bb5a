// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/chunked_array.h"

namespace arete {

/// The errors of several attributes for many triangles, zero until set. Without attributes no memory.
class AttributeErrorArray {
 public:
  explicit AttributeErrorArray(std::size_t perTriangle) : perTriangle_(perTriangle) {}

  std::size_t perTriangle() const { return perTriangle_; }

  void reserve(std::size_t size) { errors_.reserve(size * perTriangle_); }
  /// New elements are undefined.
  void resize(std::size_t size) { errors_.resize(size * perTriangle_); }
  float get(std::size_t i, std::size_t attribute) const { return errors_[i * perTriangle_ + attribute]; }
  void set(std::size_t i, std::size_t attribute, float error) {
    errors_[i * perTriangle_ + attribute] = error;
  }
  /// Copies all errors of a triangle.
  void copy(std::size_t from, const AttributeErrorArray& of, std::size_t to) {
    for (std::size_t a = 0; a < perTriangle_; ++a) set(to, a, of.get(from, a));
  }

 private:
  std::size_t perTriangle_;
  ChunkedArray<float> errors_;
};

}  // namespace arete
