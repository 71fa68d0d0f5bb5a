// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// A value of nlohmann's that is destroyed without an allocation. Its own destructor lists what is in it, and
/// ends the process where there is no memory for the list, which must not happen to a host such as Python.
template <class Json>
class JsonTree {
 public:
  explicit JsonTree(Json value) : value_(static_cast<Json&&>(value)) {}
  ~JsonTree() { empty(value_, kDeepest); }
  JsonTree(const JsonTree&) = delete;
  JsonTree& operator=(const JsonTree&) = delete;

  Json& operator*() { return value_; }
  const Json& operator*() const { return value_; }

 private:
  static constexpr int kDeepest =
      200;  ///< what is deeper is left to its own destructor, for the stack's sake

  /// A value without elements has nothing to list.
  static void empty(Json& value, int levels) noexcept {
    if (!value.is_structured()) return;
    if (levels > 0)
      for (Json& element : value) empty(element, levels - 1);
    value.clear();
  }

  Json value_;
};

}  // namespace arete
