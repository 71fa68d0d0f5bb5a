// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace arete {

/// The vertices of a candidate, at most three, or something of each: without memory of its own.
template <class Element>
class SmallVector {
 public:
  SmallVector() = default;
  explicit SmallVector(std::span<const Element> elements) {
    for (const Element& e : elements) push_back(e);
  }
  void push_back(const Element& e) { elements_[size_++] = e; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Element& operator[](std::size_t i) { return elements_[i]; }
  const Element& operator[](std::size_t i) const { return elements_[i]; }
  Element* begin() { return elements_.data(); }
  Element* end() { return elements_.data() + size_; }
  const Element* begin() const { return elements_.data(); }
  const Element* end() const { return elements_.data() + size_; }

 private:
  std::array<Element, 3> elements_{};
  std::size_t size_ = 0;
};

}  // namespace arete
